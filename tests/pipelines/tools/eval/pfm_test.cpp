// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/pfm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "expect_error.hpp"
#include "support.hpp"

namespace mtstereo::eval::pfm_test {
namespace {

using testing::float_bytes;
using testing::TemporaryFolder;
using testing::write_file;

// Two columns and three rows; the file starts with the last row.
const std::vector<float> kStored{5, 6, 3, 4, 1, 2};

void expect_counts_up(const cv::Mat& map) {
  ASSERT_EQ(map.type(), CV_32FC1);
  ASSERT_EQ(map.size(), cv::Size(2, 3));
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 2; ++x) {
      EXPECT_EQ(map.at<float>(y, x), static_cast<float>(1 + 2 * y + x)) << "at " << x << "," << y;
    }
  }
}

class Pfm : public ::testing::Test {
 protected:
  cv::Mat read(const std::string& bytes) {
    write_file(file_, bytes);
    return read_pfm(file_);
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "map.pfm";
};

TEST_F(Pfm, ReadsLittleEndianBottomRowFirst) {
  expect_counts_up(read("Pf\n2 3\n-1.0\n" + float_bytes(kStored, false)));
}

TEST_F(Pfm, ReadsBigEndian) {
  expect_counts_up(read("Pf\n2 3\n1.0\n" + float_bytes(kStored, true)));
}

TEST_F(Pfm, ReadsHeaderLinesThatEndInWhiteSpace) {
  expect_counts_up(read("Pf \n2 3 \t\n-1.0 \n" + float_bytes(kStored, false)));
}

TEST_F(Pfm, ReadsHeaderWithCarriageReturns) {
  expect_counts_up(read("Pf\r\n2 3\r\n-1\r\n" + float_bytes(kStored, false)));
}

TEST_F(Pfm, ReadsHeaderWithComments) {
  expect_counts_up(
      read("Pf # map\n# made by hand\n2 3\n-1.0 # scale\n" + float_bytes(kStored, false)));
}

TEST_F(Pfm, ReadsHeaderWithSizeOnTwoLinesOrOne) {
  expect_counts_up(read("Pf\n2\n3\n-1.0\n" + float_bytes(kStored, false)));
  expect_counts_up(read("Pf 2 3\n-1.0\n" + float_bytes(kStored, false)));
}

TEST_F(Pfm, IgnoresTheMagnitudeOfTheScale) {
  expect_counts_up(read("Pf\n2 3\n-0.003922\n" + float_bytes(kStored, false)));
}

TEST_F(Pfm, ReadsValuesThatLookLikeHeaderText) {
  // 0x0a0a0a0a: every byte of the value is a line feed.
  const cv::Mat map = read("Pf\n1 1\n-1.0\n\n\n\n\n");
  EXPECT_EQ(map.size(), cv::Size(1, 1));
}

TEST_F(Pfm, KeepsInfinityAndNan) {
  const float inf = std::numeric_limits<float>::infinity();
  const cv::Mat map = read("Pf\n3 1\n-1\n" + float_bytes({inf, std::nanf(""), -inf}, false));
  EXPECT_EQ(map.at<float>(0, 0), inf);
  EXPECT_TRUE(std::isnan(map.at<float>(0, 1)));
  EXPECT_EQ(map.at<float>(0, 2), -inf);
}

TEST_F(Pfm, ReadsWhatItWrote) {
  const cv::Mat map = (cv::Mat_<float>(2, 3) << 1, 2, 3, 4, 5, INFINITY);
  write_pfm(folder_ / "below/new/map.pfm", map);
  const cv::Mat again = read_pfm(folder_ / "below/new/map.pfm");
  ASSERT_EQ(again.size(), map.size());
  EXPECT_EQ(cv::countNonZero(again != map), 0);
}

TEST_F(Pfm, RejectsMissingFile) {
  EXPECT_INPUT_ERROR(read_pfm(folder_ / "none.pfm"), "none.pfm: no such file");
}

TEST_F(Pfm, RejectsFolder) { EXPECT_INPUT_ERROR(read_pfm(folder_.path()), "is not a file"); }

TEST_F(Pfm, RejectsTruncatedFileAndNamesBothSizes) {
  const std::string bytes = "Pf\n2 3\n-1.0\n" + float_bytes(kStored, false);
  EXPECT_INPUT_ERROR(read(bytes.substr(0, bytes.size() - 1)),
                     "map.pfm: ends too early: 2x3 values need 24 bytes, 23 are there");
}

TEST_F(Pfm, RejectsFileOfAnotherType) {
  EXPECT_INPUT_ERROR(read("P5\n2 3\n255\nabcdef"), "is not a PFM file");
  EXPECT_INPUT_ERROR(read(""), "is not a PFM file");
  EXPECT_INPUT_ERROR(read("Pfx\n2 3\n-1\n" + float_bytes(kStored, false)), "the PFM header");
}

TEST_F(Pfm, RejectsThreeChannels) {
  EXPECT_INPUT_ERROR(read("PF\n1 1\n-1.0\n" + float_bytes({1, 2, 3}, false)), "three channels");
}

TEST_F(Pfm, RejectsIncompleteHeader) {
  EXPECT_INPUT_ERROR(read("Pf\n2 3"), "header is incomplete");
  EXPECT_INPUT_ERROR(read("Pf\n" + std::string(10000, ' ')), "header is incomplete");
}

TEST_F(Pfm, RejectsInvalidSizes) {
  for (const char* size : {"0 3", "-2 3", "2 x", "2.5 3", "2 99999999999", "20000 1"}) {
    EXPECT_INPUT_ERROR(read(std::string("Pf\n") + size + "\n-1.0\n"), "in the PFM header is '");
  }
}

TEST_F(Pfm, RejectsInvalidScale) {
  for (const char* scale : {"0", "abc", "nan", "-inf", "1.0x"}) {
    EXPECT_INPUT_ERROR(read(std::string("Pf\n2 3\n") + scale + "\n" + float_bytes(kStored, false)),
                       "the scale in the PFM header");
  }
}

}  // namespace
}  // namespace mtstereo::eval::pfm_test
