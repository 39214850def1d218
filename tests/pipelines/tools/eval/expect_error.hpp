// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/outputs/user_error.hpp"

/// Expects an UserError whose message contains the text.
#define EXPECT_INPUT_ERROR(statement, text)                               \
  do {                                                                    \
    try {                                                                 \
      (void)(statement);                                                  \
      ADD_FAILURE() << #statement << " did not fail";                     \
    } catch (const ::mtstereo::UserError& error) {                        \
      EXPECT_THAT(std::string(error.what()), ::testing::HasSubstr(text)); \
    }                                                                     \
  } while (false)
