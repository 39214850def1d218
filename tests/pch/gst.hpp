// SPDX-License-Identifier: LGPL-2.1-or-later
// Precompiled for the tests of the elements.
#include <gst/app/gstappsink.h>
#include <gst/app/gstappsrc.h>
#include <gst/check/gstharness.h>
#include <gst/gst.h>
#include <gst/video/video.h>
#include <gtest/gtest.h>
