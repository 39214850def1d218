// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gmock/gmock.h>

#include "lib/outputs/user_error.hpp"

/// Expects an UserError whose message contains the text.
#define EXPECT_INPUT_ERROR(statement, text) \
  EXPECT_THAT([&] { (void)(statement); },   \
              ::testing::ThrowsMessage<::mtstereo::UserError>(::testing::HasSubstr(text)))
