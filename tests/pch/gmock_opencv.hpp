// SPDX-License-Identifier: LGPL-2.1-or-later
// Precompiled for the tests of mtstereo-eval.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
