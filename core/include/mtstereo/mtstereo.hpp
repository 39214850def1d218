// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

/// Everything of the library: include this one.
#include "mtstereo/image.hpp"
#include "mtstereo/matcher.hpp"
#include "mtstereo/parameters.hpp"
#include "mtstereo/result.hpp"
