// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/own_plugin.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace mtstereo::run::own_plugin_test {
namespace {

TEST(OwnPlugin, FollowsThePathOfTheUser) {
  EXPECT_EQ("/own", plugin_path_with("", "/own"));
  EXPECT_EQ("/users:/own", plugin_path_with("/users", "/own"));
}

TEST(OwnPlugin, IsNotAddedAgain) {
  EXPECT_EQ("/own", plugin_path_with("/own", "/own"));
  EXPECT_EQ("/a:/own:/b", plugin_path_with("/a:/own:/b", "/own"));
  EXPECT_EQ("/own/deeper:/own", plugin_path_with("/own/deeper", "/own"));
  EXPECT_EQ("/my/own:/own", plugin_path_with("/my/own", "/own"));
}

TEST(OwnPlugin, IsThatOfAnInstallationOnly) {
  EXPECT_TRUE(own_plugin_folder("/nowhere/bin/mtstereo-run").empty());
  EXPECT_TRUE(own_plugin_folder(std::filesystem::read_symlink("/proc/self/exe")).empty());
}

}  // namespace
}  // namespace mtstereo::run::own_plugin_test
