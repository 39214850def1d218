// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <string>

namespace mtstereo::plugin {

/// How players turn the frames that arrive on a pad, as its tags state it, such as "rotate-180";
/// empty if they do not. Decoders leave the frames as they are stored.
std::string turning_on(GstPad* pad);

/// Why frames that players turn are refused, for a message that names their source.
std::string turning_problem(const std::string& turning);

}  // namespace mtstereo::plugin
