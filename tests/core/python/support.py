# SPDX-License-Identifier: LGPL-2.1-or-later
"""Views with known disparities, and the maps that the library gives for them."""
import os
import pathlib
import subprocess
import tempfile

import numpy as np


def views(width, height, shift=4, seed=1):
    """A pair with texture of several sizes, half of it at the disparity `shift` and half at twice that."""
    random = np.random.default_rng(seed)
    scene = sum(np.kron(random.integers(0, 64, (height // size + 1, (width + 2 * shift) // size + 1)),
                        np.ones((size, size)))[:height, :width + 2 * shift] for size in (1, 2, 5, 9))
    scene = scene.astype(np.uint8)
    left = np.ascontiguousarray(scene[:, :width])
    right = scene[:, shift:shift + width].copy()
    right[height // 2:] = scene[height // 2:, 2 * shift:2 * shift + width]
    return left, right


def library_maps(pairs, **parameters):
    """The library's disparity (float32, NaN = unknown) and confidence of each pair, by a C++ program."""
    height, width = pairs[0][0].shape
    with tempfile.TemporaryDirectory(prefix="mtstereo-") as folder:
        folder = pathlib.Path(folder)
        (folder / "views").write_bytes(b"".join(view.tobytes() for pair in pairs for view in pair))
        settings = [f"{name.replace('_', '-')}={str(value).lower()}" for name, value in parameters.items()]
        done = subprocess.run([os.environ["LIBRARY_MAPS"], folder / "views", folder / "maps", str(width), str(height),
                               str(len(pairs)), *settings], capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        pixels = width * height
        maps = np.frombuffer((folder / "maps").read_bytes(), np.uint8).reshape(len(pairs), 5 * pixels)
    offset = int(done.stdout)
    for one in maps:
        values = one[:4 * pixels].view(np.int32).reshape(height, width)
        disparity = np.where(values == 0, np.float32(np.nan), (values / 256 + offset).astype(np.float32))
        yield disparity, one[4 * pixels:].reshape(height, width)
