// SPDX-License-Identifier: LGPL-2.1-or-later
// Precompiled for the tests of the core.
#include <gtest/gtest.h>
