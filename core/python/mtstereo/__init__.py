# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stereo depth on NumPy arrays: disparity and confidence of rectified pairs of images.

    import cv2, mtstereo
    matcher = mtstereo.Matcher(mode="semi-dense", max_disparity=128)
    left, right = (cv2.imread(file, cv2.IMREAD_GRAYSCALE) for file in ("left.png", "right.png"))
    disparity, confidence = matcher(left, right)  # float32 px, NaN = unknown; uint8

help(mtstereo.Matcher) describes all parameters. mtstereo.gst reads the maps of the GStreamer element.

The module works in the main interpreter of a process, in any of its threads. A Matcher is not used in another process
than the one that made it, and cannot be copied or pickled.
"""
from . import _mtstereo

_mtstereo.require_main_interpreter()

from ._mtstereo import (Alignment, Calibration, Camera, Cloud, Matcher, MatchResult,  # noqa: E402
                        PairFindings, ParameterInfo, Rectification, Rectifier, RowField, ViewCorrection, __version__,
                        cloud, depth, parameter_table, rectification_remarks, rectify)

__all__ = ["Alignment", "Calibration", "Camera", "Cloud", "Matcher", "MatchResult", "PairFindings", "ParameterInfo",
           "Rectification", "Rectifier", "RowField", "ViewCorrection", "__version__", "cloud", "depth",
           "parameter_table", "rectification_remarks", "rectify"]

for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__  # where users find it
del _name
