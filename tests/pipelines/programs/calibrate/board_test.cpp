// SPDX-License-Identifier: LGPL-2.1-or-later

// Boards: their description, their pages, and that the corners of what is drawn are found where
// they are.

#include "programs/calibrate/board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lib/outputs/user_error.hpp"
#include "programs/calibrate/detection.hpp"
#include "programs/calibrate/page.hpp"

namespace mtstereo::calibrate::board_test {
namespace {

using ::testing::HasSubstr;

BoardOptions checkerboard() {
  BoardOptions options;
  options.kind = BoardKind::kCheckerboard;
  return options;
}

// The largest distance of the corners from where the board has them [px].
double largest_error(const Corners& corners, const BoardOptions& board, double scale,
                     double offset) {
  const auto points = corner_points(board);
  double largest = 0;
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    const Eigen::Vector3d& point = points[static_cast<std::size_t>(corners.ids[i])];
    // Edges between pixels are half a pixel before the pixel's center.
    const cv::Point2d expected(point.x() * scale + offset - 0.5, point.y() * scale + offset - 0.5);
    largest = std::max(largest, cv::norm(cv::Point2d(corners.pixels[i]) - expected));
  }
  return largest;
}

TEST(Board, AllCornersOfADrawnCharucoBoardAreFoundWhereTheyAre) {
  for (const char* dictionary : {"4x4_100", "5x5_100", "6x6_250"}) {
    BoardOptions board;
    board.dictionary = dictionary;
    const cv::Mat image = board_image(board, 64);
    const Corners corners = BoardFinder(board).find(image);
    EXPECT_EQ(corners.ids.size(), 40U) << dictionary;
    EXPECT_LT(largest_error(corners, board, 64 / board.square, 64), 0.1) << dictionary;
  }
}

TEST(Board, EvenAndOddBoardsHaveTheirCornersInTheSameOrder) {
  for (const auto& [columns, rows] : {std::pair(8, 5), {5, 8}, {7, 5}, {6, 6}, {3, 4}}) {
    BoardOptions board;
    board.columns = columns;
    board.rows = rows;
    const Corners corners = BoardFinder(board).find(board_image(board, 64));
    EXPECT_EQ(corners.ids.size(), static_cast<std::size_t>((columns - 1) * (rows - 1)));
    EXPECT_LT(largest_error(corners, board, 64 / board.square, 64), 0.1) << columns << "x" << rows;
  }
}

TEST(Board, AllCornersOfADrawnCheckerboardAreFound) {
  const BoardOptions board = checkerboard();
  Corners corners = BoardFinder(board).find(board_image(board, 48));
  ASSERT_EQ(corners.ids.size(), 40U);
  if (corners.pixels.front().x > corners.pixels.back().x) {
    std::reverse(corners.pixels.begin(), corners.pixels.end());
  }
  EXPECT_LT(largest_error(corners, board, 48 / board.square, 48), 0.1);
}

TEST(Board, InvalidBoardsAreRefusedByName) {
  BoardOptions board;
  EXPECT_EQ(check(board), "");
  board.square = 28;
  EXPECT_THAT(check(board), HasSubstr("28000 mm; the unit is mm"));
  board = {};
  board.columns = 2;
  EXPECT_THAT(check(board), HasSubstr("2x6 squares"));
  board = {};
  board.columns = 30;
  board.rows = 20;
  EXPECT_THAT(check(board), HasSubstr("300 markers, but the dictionary 4x4_100 only 100"));
  board = {};
  board.marker = 0.028;
  EXPECT_THAT(check(board), HasSubstr("do not fit"));
  board = {};
  board.dictionary = "9x9";
  EXPECT_THAT(check(board), HasSubstr("no dictionary '9x9'"));
  board = checkerboard();
  board.rows = board.columns;
  EXPECT_THAT(check(board), HasSubstr("different numbers"));
}

TEST(Detection, APartOfACharucoBoardIsEnough) {
  const BoardOptions board;
  const cv::Mat image = board_image(board, 64);
  const Corners corners = BoardFinder(board).find(image.colRange(0, image.cols / 2).clone());
  EXPECT_GT(corners.ids.size(), 12U);
  EXPECT_LT(corners.ids.size(), 40U);
  EXPECT_LT(largest_error(corners, board, 64 / board.square, 64), 0.1);
}

TEST(Detection, ImagesWithoutABoardGiveNoCorners) {
  for (const BoardOptions& board : {BoardOptions(), checkerboard()}) {
    const BoardFinder finder(board);
    EXPECT_TRUE(finder.find(cv::Mat(480, 640, CV_8UC1, cv::Scalar(128))).ids.empty());
    EXPECT_TRUE(finder.find(cv::Mat(2, 3, CV_8UC1, cv::Scalar(128))).ids.empty());
    EXPECT_TRUE(finder.find(cv::Mat()).ids.empty());
    cv::Mat noise(240, 320, CV_8UC1);
    cv::randu(noise, 0, 256);
    EXPECT_TRUE(finder.find(noise).ids.empty());
  }
}

TEST(Detection, AnotherBoardsMarkersAreCountedButGiveNoCorners) {
  BoardOptions other;
  other.dictionary = "5x5_100";
  const Corners none = BoardFinder(other).find(board_image(BoardOptions(), 64));
  EXPECT_TRUE(none.ids.empty());
  EXPECT_EQ(none.markers, 0);
}

TEST(Detection, CornersOfATurnedBoardAreNumberedAlike) {
  const BoardOptions board = checkerboard();
  const cv::Mat image = board_image(board, 48);
  const CornerPair pair = BoardFinder(board).find(image, image);
  ASSERT_TRUE(pair.usable());
  Corners turned = pair.right;
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  match_numbers(pair.left, turned);
  for (std::size_t i = 0; i < turned.pixels.size(); ++i) {
    EXPECT_EQ(turned.pixels[i], pair.left.pixels[i]);
  }
}

TEST(Page, ThePdfHasTheBoardInTrueSize) {
  const BoardOptions board;
  const Page page = make_page(board, "A4");
  EXPECT_EQ(page.width, 297);
  EXPECT_EQ(page.height, 210);
  const std::string pdf = pdf_of(page);
  EXPECT_TRUE(pdf.starts_with("%PDF-1.4\n"));
  EXPECT_TRUE(pdf.ends_with("%%EOF\n"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 841.8898 595.2756]"));
  EXPECT_THAT(pdf, HasSubstr("/PrintScaling /None"));
  // A square of 28 mm is 79.3701 points wide.
  EXPECT_THAT(pdf, HasSubstr(" 79.3701 79.3701 re\n"));
  // The line of 100 mm.
  EXPECT_THAT(pdf, HasSubstr(" 283.4646 0.5669 re\n"));
  EXPECT_THAT(pdf, HasSubstr("squares of 28 mm"));
  // The table of objects points to them.
  for (int i = 1; i <= 5; ++i) {
    const std::string object = std::to_string(i) + " 0 obj\n";
    const std::size_t line = pdf.find("xref\n0 6\n") + 9 + 20 * static_cast<std::size_t>(i);
    EXPECT_EQ(pdf.substr(std::stoul(pdf.substr(line, 10)), object.size()), object);
  }
}

TEST(Page, ThePngStatesItsResolutionAndShowsTheBoard) {
  const BoardOptions board;
  const std::string png = png_of(make_page(board, "A4"), 8);
  EXPECT_EQ(png.substr(37, 4), "pHYs");
  EXPECT_EQ(png.substr(41, 9), std::string("\0\0\x1f\x40\0\0\x1f\x40\x01", 9)) << "8000 per m";
  const cv::Mat image =
      cv::imdecode(std::vector<std::uint8_t>(png.begin(), png.end()), cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(image.size(), cv::Size(297 * 8, 210 * 8));
  cv::Mat half;
  cv::resize(image, half, {}, 0.5, 0.5, cv::INTER_AREA);
  const Corners corners = BoardFinder(board).find(half);
  ASSERT_EQ(corners.ids.size(), 40U);
  EXPECT_NEAR(cv::norm(corners.pixels[0] - corners.pixels[7]), 7 * 28 * 4, 0.2);
}

TEST(Page, ABoardThatDoesNotFitIsRefused) {
  BoardOptions board;
  board.square = 0.04;
  EXPECT_THROW(make_page(board, "A4"), UserError);
  EXPECT_EQ(make_page(board, "A3").width, 420);
  const Page fit = make_page(board, "fit");
  EXPECT_NEAR(fit.width, 372, 1e-9);
  EXPECT_THROW(write_page(fit, "/nonexistent/board.pdf"), mtstereo::UserError);
  EXPECT_THROW(write_page(fit, "board.bmp"), UserError);
}

}  // namespace
}  // namespace mtstereo::calibrate::board_test
