#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Python module finds the right disparities, 8 px, of noise, and reports wrong arguments."""
import mtstereo
import numpy as np

noise = np.random.default_rng(1).integers(0, 256, (240, 328), np.uint8)
result = mtstereo.Matcher(max_disparity=32)(noise[:, :320], noise[:, 8:])
found = np.count_nonzero(np.abs(result.disparity - 8) < 1 / 32)
print(f"{found} of {result.disparity.size} pixels are at 8 px")
assert found > 0.9 * result.disparity.size

try:
    mtstereo.Matcher(max_disparity=0)
except ValueError as error:
    print(error)
else:
    raise AssertionError("max_disparity=0 is accepted")
