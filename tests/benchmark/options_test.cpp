// SPDX-License-Identifier: LGPL-2.1-or-later
#include "options.hpp"

#include <gtest/gtest.h>

namespace mtstereo::bench::options_test {
namespace {

TEST(ProcessorName, IsTheModelNameOfTheFirstProcessor) {
  EXPECT_EQ("Some CPU @ 2.0 GHz", processor_name("processor\t: 0\nmodel\t\t: 2\n"
                                                 "model name\t: Some CPU @ 2.0 GHz \n\n"
                                                 "processor\t: 1\nmodel name\t: Other\n"));
}

TEST(ProcessorName, IsThatOfTheBoardIfProcessorsHaveNone) {
  EXPECT_EQ("Board 4 Model B", processor_name("processor\t: 0\nCPU part\t: 0xd08\n\n"
                                              "Hardware\t: Chip\nModel\t\t: Board 4 Model B\n"));
  EXPECT_EQ("Chip", processor_name("Hardware\t: Chip"));
}

TEST(ProcessorName, IsUnknownWithoutAnyEntry) {
  for (const char* text : {"", "model name", "model name :", "model name\t: \t\n", ": x\n",
                           "modelname : x", "model name x : y"}) {
    EXPECT_EQ("unknown", processor_name(text)) << text;
  }
}

}  // namespace
}  // namespace mtstereo::bench::options_test
