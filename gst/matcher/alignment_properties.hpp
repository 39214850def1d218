// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <glib-object.h>

#include "matcher/engine/alignment.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo::plugin {

/// The ids of the properties on alignment.
enum AlignmentProperty : guint {
  kAlignment = 50,
  kAlignmentInterval,
  kAlignmentField,
  kSharpness,
  kLeftBlur,
  kRightBlur,
};

/// Installs the properties on alignment.
void install_alignment_properties(GObjectClass* object_class) noexcept;

/// True if the id is an AlignmentProperty.
bool is_alignment_property(guint id);

/// Sets a property. Fails if the text of a field is invalid; the settings are unchanged then.
Status set_alignment_from_value(AlignmentSettings& settings, guint id, const GValue& value);

/// Copies the effective value to the value of a property. `known` is the field that was found, if
/// there is one.
void alignment_to_value(const AlignmentSettings& settings, Preset preset,
                        const std::optional<RowField>& known, guint id, GValue& value);

}  // namespace mtstereo::plugin
