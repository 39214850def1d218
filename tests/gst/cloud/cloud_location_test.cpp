// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/cloud_location.hpp"

#include <gtest/gtest.h>

namespace mtstereo::plugin::cloud_location_test {
namespace {

CloudLocation parsed(const std::string& pattern) {
  const Result<CloudLocation> location = CloudLocation::parse(pattern, std::nullopt);
  EXPECT_TRUE(location.ok()) << pattern;
  return location.ok() ? *location : CloudLocation();
}

TEST(CloudLocation, HasTheNumberAsPrintfWritesIt) {
  EXPECT_EQ(parsed("a-%05d.ply").path(42), "a-00042.ply");
  EXPECT_EQ(parsed("a-%d.ply").path(42), "a-42.ply");
  EXPECT_EQ(parsed("a-%3d.ply").path(42), "a- 42.ply");
  EXPECT_EQ(parsed("a-%02d.ply").path(12345), "a-12345.ply");
  EXPECT_EQ(parsed("%d/cloud.pcd").path(7), "7/cloud.pcd");
  EXPECT_EQ(parsed("100%%-%d.ply").path(7), "100%-7.ply");
  EXPECT_EQ(parsed("a-%020d.ply").path(18446744073709551615U), "a-18446744073709551615.ply");
}

TEST(CloudLocation, MayHaveNoNumber) {
  EXPECT_EQ(parsed("cloud.ply").path(42), "cloud.ply");
  EXPECT_FALSE(parsed("100%%.ply").numbered());
  EXPECT_TRUE(parsed("%d.ply").numbered());
}

TEST(CloudLocation, TakesTheFormatFromTheExtension) {
  EXPECT_EQ(parsed("a.ply").format(), CloudFormat::kPly);
  EXPECT_EQ(parsed("a.b.PCD").format(), CloudFormat::kPcd);
  EXPECT_EQ(parsed("a.ply/%d.pcd").format(), CloudFormat::kPcd);
  const auto set = CloudLocation::parse("a.ply", CloudFormat::kPcd);
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->format(), CloudFormat::kPcd);
}

TEST(CloudLocation, RefusesOtherPatterns) {
  for (const char* pattern :
       {"", "%s.ply", "%n.ply", "%5x.ply", "%d%d.ply", "%-5d.ply", "%.ply", "a.ply%", "%21d.ply",
        "%99999999999999999999d.ply", "%ld.ply", "%d", "cloud", "cloud.txt", "a.ply/cloud"}) {
    EXPECT_FALSE(CloudLocation::parse(pattern, std::nullopt).ok()) << pattern;
  }
}

TEST(CloudLocation, IsAlwaysUtf8InMessages) {
  EXPECT_EQ(utf8_path("/tmp/Größe \\x/a.ply"), "/tmp/Größe \\x/a.ply");
  EXPECT_EQ(utf8_path("/tmp/\xff\\ß\xc3.ply"), "/tmp/\\xff\\x5cß\\xc3.ply");
  EXPECT_EQ(utf8_path("\xe2\x82"), "\\xe2\\x82");
}

}  // namespace
}  // namespace mtstereo::plugin::cloud_location_test
