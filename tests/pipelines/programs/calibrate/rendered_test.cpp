// SPDX-License-Identifier: LGPL-2.1-or-later

// Calibrations of rendered cameras, whose truth is known, from images with noise.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "programs/calibrate/calibrating.hpp"
#include "programs/calibrate/detection.hpp"
#include "programs/calibrate/quality.hpp"
#include "tools/render/board.hpp"
#include "tools/render/raw.hpp"

namespace mtstereo::calibrate::rendered_test {
namespace {

constexpr int kScale = 64;  // pixels of the board's image per square
constexpr int kPoses = 20;

render::ImageTexture image_of(const BoardOptions& board) {
  const cv::Mat gray = board_image(board, kScale);
  return {gray.cols, gray.rows,
          std::vector<std::uint8_t>(gray.begin<std::uint8_t>(), gray.end<std::uint8_t>()),
          kScale / board.square};
}

// The views of a board in front of a rendered pair of cameras.
class Film {
 public:
  Film(const char* rig, const BoardOptions& board, double visible)
      : calibration_(render::built_in_rig(rig, settings())), coverage_(board, size(), size()) {
    const auto image = std::make_shared<const render::ImageTexture>(image_of(board));
    const render::RawRig cameras(calibration_);
    render::BoardPoses poses;
    poses.count = kPoses;
    poses.visible = visible;
    const render::Scene scene = render::make_board(
        image, render::choose_poses(poses, image->width(), image->height(), cameras), {}, 1);
    const BoardFinder finder(board);
    for (int i = 0; i < kPoses; ++i) {
      const render::RawFrame frame = render::render_raw(scene, i, settings(), cameras);
      const CornerPair corners = finder.find(frame.left, frame.right);
      if (!corners.usable()) continue;
      views_.push_back(finder.view_of(corners));
      coverage_.add(corners);
    }
  }

  static render::Settings settings() {
    render::Settings settings;
    settings.width = size().width;
    settings.height = size().height;
    settings.focal = 0.85 * settings.width;
    settings.baseline = 0.12;
    settings.noise = 2;
    settings.blur = 0.6;
    settings.samples = 1;  // the image of the board has exact means
    return settings;
  }
  static cv::Size size() { return {640, 480}; }

  const std::vector<BoardView>& views() const { return views_; }
  const Coverage& coverage() const { return coverage_; }

  void expect_close(const Calibrated& found, double focal, double baseline) const {
    const auto expect = [](const char* what, double value, double truth, double limit) {
      std::printf("%s: %.4f, truth %.4f, %.3f %%\n", what, value, truth, 100 * (value / truth - 1));
      EXPECT_LT(std::abs(value / truth - 1), limit) << what;
    };
    const Rig& rig = found.solution.rig;
    expect("left fx", rig.left.values[0], calibration_.left.focal_x, focal);
    expect("left fy", rig.left.values[1], calibration_.left.focal_y, focal);
    expect("right fx", rig.right.values[0], calibration_.right.focal_x, focal);
    expect("right fy", rig.right.values[1], calibration_.right.focal_y, focal);
    expect("baseline", rig.baseline(), calibration_.baseline(), baseline);
    std::printf("principal points: %.2f %.2f, truth %.2f %.2f; %.2f %.2f, truth %.2f %.2f\n",
                rig.left.values[2], rig.left.values[3], calibration_.left.center_x,
                calibration_.left.center_y, rig.right.values[2], rig.right.values[3],
                calibration_.right.center_x, calibration_.right.center_y);
    ASSERT_TRUE(found.held_out);
    std::printf("rows: median %.3f, 95 %% %.3f px; reprojection %.3f px; %zu views, %zu removed\n",
                quantile(found.held_out->fit.rows, 0.5), quantile(found.held_out->fit.rows, 0.95),
                found.solution.result.rms, found.solution.views.size(),
                found.solution.removed.size());
  }

 private:
  StereoCalibration calibration_;
  std::vector<BoardView> views_;
  Coverage coverage_;
};

TEST(Rendered, PosesGiveTheCamerasAndTheirRows) {
  const Film film("wide", BoardOptions(), 0.8);
  EXPECT_GE(film.views().size(), 18U);
  const Calibrated found = calibrate(Model::kPlumbBob, Film::size(), Film::size(), film.views());
  film.expect_close(found, 0.002, 0.005);
  EXPECT_LE(quantile(found.held_out->fit.rows, 0.5), 0.2);
  EXPECT_FALSE(found.swapped);
  const Quality quality = judge(found, film.coverage(), std::nullopt);
  EXPECT_EQ(quality.grade, Grade::kGood);
  for (const Warning& each : quality.warnings) ADD_FAILURE() << each.name << ": " << each.text;
}

TEST(Rendered, FisheyesOf120DegreesAreRecognized) {
  const Film film("fisheye", BoardOptions(), 0.8);
  EXPECT_GE(film.views().size(), 18U);
  const Calibrated found = calibrate(std::nullopt, Film::size(), Film::size(), film.views());
  EXPECT_EQ(found.model, Model::kFisheye);
  EXPECT_EQ(found.trials.size(), 3U);
  film.expect_close(found, 0.002, 0.005);
  EXPECT_LE(quantile(found.held_out->fit.rows, 0.5), 0.4);
}

}  // namespace
}  // namespace mtstereo::calibrate::rendered_test
