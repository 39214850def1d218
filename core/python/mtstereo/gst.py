# SPDX-License-Identifier: LGPL-2.1-or-later
"""The maps of the GStreamer element mtstereo as arrays, for samples of an appsink.

Needs GStreamer's Python bindings (Debian: python3-gi, gir1.2-gst-plugins-base-1.0).
"""
from typing import NamedTuple, Optional

import gi
import numpy as np

gi.require_version("Gst", "1.0")
gi.require_version("GstVideo", "1.0")
from gi.repository import Gst, GstVideo  # noqa: E402

__all__ = ["Maps", "image", "maps"]

_DTYPES = {"GRAY8": np.dtype(np.uint8), "GRAY16_LE": np.dtype("<u2"), "GRAY16_BE": np.dtype(">u2")}


class Maps(NamedTuple):
    """Disparity [px], float32, NaN = unknown, and confidence, uint8, 0 = unknown (None if the map has none), both of
    shape (height, width). They belong to the caller."""
    disparity: np.ndarray
    confidence: Optional[np.ndarray]


def image(sample):
    """A gray image of a sample as an array of shape (height, width), uint8 or uint16; a copy.

    ValueError: the sample is None or has no such image.
    """
    caps = sample.get_caps() if sample else None
    dtype = _DTYPES.get(caps.get_structure(0).get_value("format")) if caps else None
    if dtype is None:
        raise ValueError(f"this is no sample of gray video, but one of {caps.to_string() if caps else 'no caps'}: pass "
                         "those of mtstereo, or convert to video/x-raw,format=GRAY8 upstream")
    info = GstVideo.VideoInfo.new_from_caps(caps)
    buffer = sample.get_buffer()
    meta = GstVideo.buffer_get_video_meta(buffer)
    stride, offset = (meta.stride[0], meta.offset[0]) if meta else (info.stride[0], info.offset[0])
    data = buffer.extract_dup(0, buffer.get_size())
    rows = np.ndarray((info.height, info.width), dtype, data, offset, (stride, dtype.itemsize))
    return rows.astype(dtype.newbyteorder("="))


def maps(sample):
    """The Maps of a sample of mtstereo: GstApp.AppSink.try_pull_sample() or the like.

    ValueError: the sample has no disparity map of mtstereo.
    """
    values = image(sample)
    caps = sample.get_caps().get_structure(0)
    scale = caps.get_value("disparity-scale")
    if values.dtype != np.uint16 or not scale:
        raise ValueError(f"this is no disparity map, but {caps.to_string()}: link the appsink with mtstereo itself")
    disparity = values.astype(np.float32) / np.float32(scale) + np.float32(caps.get_value("disparity-offset") or 0)
    disparity[values == 0] = np.nan
    meta = sample.get_buffer().get_custom_meta("MtStereoConfidenceMeta")
    confidence = meta.get_structure().get_value("confidence") if meta else None
    return Maps(disparity, image(confidence) if isinstance(confidence, Gst.Sample) else None)
