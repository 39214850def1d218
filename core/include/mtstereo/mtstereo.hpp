// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

/// @mainpage
/// The library finds the disparity of the left image of a rectified pair: by MTStereo 2.0, which
/// matches the Max-trees of the scan-lines, or, as the default does, along paths through the costs
/// of all pixels. mtstereo::Matcher does that, mtstereo::Parameters configures it, and
/// mtstereo::parameter_table() describes every parameter. mtstereo::AlignmentTracker finds what is
/// wrong with the rows and the sharpness of the views. Include <mtstereo/mtstereo.hpp>, and compile
/// with -std=c++20 or later and the flags of `pkg-config --cflags --libs mtstereo`.
///
/// A complete program, which matches two images:
/// @include match_pair.cpp

/// @namespace mtstereo
/// The whole library.

#include "mtstereo/alignment.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/matcher.hpp"
#include "mtstereo/parameters.hpp"
#include "mtstereo/result.hpp"
