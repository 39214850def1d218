// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/matching/json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lib/outputs/user_error.hpp"
#include "mtstereo/parameters.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::json_test {
namespace {

namespace fs = std::filesystem;
using testing::bytes_of;
using testing::TemporaryFolder;
using testing::write_text;

Work example() {
  Work work;
  work.recording.name = "street \"1\"";
  work.recording.kind = "two video files";
  work.recording.left.video = "/a/left.mp4";
  work.recording.right.images = {"/b/0.png", "/b/1.png", "/b/2.png", "/b/3.png", "/b/4.png"};
  work.recording.right.unused_bits = 4;
  work.recording.right.times = {5, 1000, 2000, 3001, 4000};
  work.recording.calibration = "/a/calibration.yml";
  work.recording.rectified = false;
  work.recording.shape = {.alpha = 0.3, .width = 600, .height = 400};
  work.recording.frame_rate = 29.97;
  work.recording.max_disparity = 128;
  work.recording.remarks = {"a remark"};
  work.left = {{0, 1000, 2000, 3000, 4000}, 640,  480,     1000, "H.264",
               "the file is truncated",     true, 123'456, {}};
  work.right = {work.recording.right.times, 640, 480, 1000, "PNG", "", false, 0, {}};
  work.clocks = ClockEstimate{{-7.0125, 3e-4}, false, 12.5, 0.001, 2e-5, true, "apart"};
  work.pairs = {{{0, 1}, {1, 2}, {3, 3}, {4, 4}}, 1, 1};
  work.options.products = {Product::kDepth, Product::kCloud};
  work.options.format = MapFormat::kPfm;
  work.options.parameters = {{"mode", "dense"}, {"max-disparity", "96"}};
  work.options.threads = 3;
  work.options.near = 0.5;
  work.options.far = 40;
  work.period = 33'333'333;
  work.geometry.emplace();
  work.geometry->views.width = 600;
  work.geometry->views.height = 400;
  work.geometry->views.focal_length = 500.25;
  work.geometry->views.baseline = 0.12;
  work.geometry->views.left_center_x = 300.5;
  work.geometry->views.right_center_x = 310.5;
  work.geometry->views.center_y = 200;
  work.geometry->format = "OpenCV";
  work.correction = {{"alignment", "hold"}, {"alignment-field", "1,0,0,0,0"}};
  work.remarks = {"another one"};
  return work;
}

PieceReport example_report() {
  PieceReport report;
  report.frames = {{0, {0, 1}, 0.5, 12.25, 3}, {1, {1, 2}, 0.625, 13, 3.5}, {3, {4, 4}, 0, 0, 4}};
  report.files = {"depth/000000.pfm", "depth/000001.pfm"};
  report.damage = "frame 3 of the left view";
  return report;
}

void expect_equal(const std::optional<ClockEstimate>& a, const std::optional<ClockEstimate>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  constexpr double kRounding = 1e-12;
  EXPECT_EQ(a->relation.offset, b->relation.offset);
  EXPECT_NEAR(a->relation.drift, b->relation.drift, kRounding);
  EXPECT_EQ(a->given, b->given);
  EXPECT_EQ(a->time, b->time);
  EXPECT_EQ(a->uncertainty, b->uncertainty);
  ASSERT_EQ(a->drift_uncertainty.has_value(), b->drift_uncertainty.has_value());
  EXPECT_NEAR(a->drift_uncertainty.value_or(0), b->drift_uncertainty.value_or(0), kRounding);
  EXPECT_EQ(a->confirmed, b->confirmed);
  EXPECT_EQ(a->explanation, b->explanation);
}

TEST(WorkJson, HasTheClocks) {
  const TemporaryFolder folder;
  Work work = example();
  ClockEstimate by_hand;
  by_hand.relation = {0.4, 1e-4};
  by_hand.given = true;
  ClockEstimate undecided = *work.clocks;
  undecided.drift_uncertainty.reset();
  for (const std::optional<ClockEstimate>& clocks :
       {work.clocks, std::optional(by_hand), std::optional(undecided),
        std::optional<ClockEstimate>()}) {
    work.clocks = clocks;
    write_work(work, folder / "work.json");
    expect_equal(read_work(folder / "work.json").clocks, clocks);
  }
}

TEST(WorkJson, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  const Work work = example();
  write_work(work, folder / "work.json");
  const Work read = read_work(folder / "work.json");
  EXPECT_EQ(fingerprint(read), fingerprint(work));
  EXPECT_EQ(read.recording.name, work.recording.name);
  EXPECT_EQ(read.recording.right.images, work.recording.right.images);
  EXPECT_EQ(read.right.times, work.right.times);
  EXPECT_EQ(read.left.damage, work.left.damage);
  EXPECT_EQ(read.pairs.pairs, work.pairs.pairs);
  EXPECT_EQ(read.pairs.dropped_left, 1);
  EXPECT_EQ(read.options.products, work.options.products);
  EXPECT_EQ(read.options.format, work.options.format);
  EXPECT_EQ(read.options.parameters, work.options.parameters);
  EXPECT_EQ(read.options.threads, 3);
  EXPECT_EQ(read.options.near, 0.5);
  EXPECT_EQ(read.options.far, 40);
  EXPECT_EQ(read.correction, work.correction);
  EXPECT_EQ(read.geometry, work.geometry);
  EXPECT_EQ(read.remarks, work.remarks);
  write_work(read, folder / "again.json");
  EXPECT_EQ(bytes_of(folder / "again.json"), bytes_of(folder / "work.json"));
}

TEST(WorkJson, FingerprintIsThatOfTheResults) {
  Work work = example();
  const std::string first = fingerprint(work);
  work.remarks.clear();
  work.options.threads = 1;
  EXPECT_EQ(fingerprint(work), first);
  work.options.parameters[0].second = "sparse";
  EXPECT_NE(fingerprint(work), first);
}

TEST(WorkJson, WithoutAGeometryIsReadAsItWasWritten) {
  const TemporaryFolder folder;
  Work work = example();
  work.geometry.reset();
  write_work(work, folder / "work.json");
  EXPECT_FALSE(read_work(folder / "work.json").geometry);
  EXPECT_NE(fingerprint(work), fingerprint(example()));
}

TEST(WorkJson, ThatIsDamagedIsRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder / "work.json";
  EXPECT_THROW(read_work(file), UserError);
  write_work(example(), file);
  const std::string bytes = bytes_of(file);
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = bytes;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& text :
       {std::string(), bytes.substr(0, bytes.size() / 2), replaced("\"period\"", "\"other\""),
        replaced("\"version\":2", "\"version\":99"), replaced("work of", "piece of"),
        replaced("\"pfm\"", "\"gif\""), replaced("[0,1,2]", "[0,1,9]"),
        replaced("[0,1,2]", "[\"a\",1,2]"),
        replaced("\"baseline_m\":0.12", "\"baseline_m\":\"x\"")}) {
    write_text(file, text);
    EXPECT_THROW(read_work(file), UserError) << text;
  }
}

TEST(PieceJson, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  const PieceReport report = example_report();
  write_piece(report, {0, 4}, folder / "piece.json");
  Range range;
  const PieceReport read = read_piece(folder / "piece.json", range);
  EXPECT_EQ(range.first, 0);
  EXPECT_EQ(range.count, 4);
  EXPECT_EQ(read.files, report.files);
  EXPECT_EQ(read.damage, report.damage);
  ASSERT_EQ(read.frames.size(), 3u);
  EXPECT_EQ(read.frames[2].pair, 3);
  EXPECT_EQ(read.frames[2].frames, (FramePair{4, 4}));
  EXPECT_EQ(read.frames[0].median_disparity, 12.25);
  EXPECT_EQ(read.frames[1].matching_ms, 3.5);
}

TEST(PieceJson, WithoutFramesIsValid) {
  const TemporaryFolder folder;
  write_piece({}, {7, 1}, folder / "piece.json");
  Range range;
  EXPECT_TRUE(read_piece(folder / "piece.json", range).frames.empty());
  EXPECT_EQ(range.first, 7);
}

TEST(RunJson, HasParametersFiguresAndMeans) {
  const TemporaryFolder folder;
  const fs::path file = folder / "run.json";
  write_run_report(example(), example_report(), 2, file);
  const nlohmann::json json = nlohmann::json::parse(bytes_of(file));
  EXPECT_EQ(json.at("parameters").at("mode"), "dense");
  EXPECT_EQ(json.at("correction").at("alignment"), "hold");
  EXPECT_EQ(json.at("pairs"), 4);
  EXPECT_EQ(json.at("processed_pairs"), 3);
  EXPECT_EQ(json.at("dropped_frames").at("left"), 1);
  EXPECT_EQ(json.at("pairs_per_second"), 1.5);
  EXPECT_EQ(json.at("means").at("density"), 0.375);
  EXPECT_EQ(json.at("inputs").at("left").at("damage"), "the file is truncated");
  EXPECT_EQ(json.at("inputs").at("right").at("pictures"), 5);
  EXPECT_EQ(json.at("frames").size(), 3u);
  EXPECT_EQ(json.at("frames")[1][0], 1);
  EXPECT_EQ(fingerprint_in(file), fingerprint(example()));
}

TEST(RunJson, StatesWhatWasUsed) {
  const TemporaryFolder folder;
  const fs::path file = folder / "run.json";
  write_run_report(example(), example_report(), 2, file);
  const nlohmann::json json = nlohmann::json::parse(bytes_of(file));
  // Every parameter, also those that were not set.
  const nlohmann::json& parameters = json.at("parameters");
  Parameters set;
  ASSERT_TRUE(set.set("mode", "dense"));
  for (const ParameterInfo& info : parameter_table()) {
    if (info.id == Parameter::kThreads || info.id == Parameter::kMaxDisparity) continue;
    EXPECT_EQ(parameters.at(info.name), set.text(info.id)) << info.name;
  }
  EXPECT_EQ(parameters.at("max-disparity"), "96");
  EXPECT_EQ(parameters.at("disparity-scale"), "256");
  EXPECT_EQ(parameters.at("sharpness"), "match");
  EXPECT_FALSE(parameters.contains("threads"));
  EXPECT_EQ(json.at("threads"), 3);
  EXPECT_EQ(json.at("limits").at("near_m"), 0.5);
  EXPECT_EQ(json.at("limits").at("far_of_clouds_m"), 40);
  EXPECT_EQ(json.at("disparity").at("smallest_px"), 0);
  EXPECT_EQ(json.at("disparity").at("largest_px"), 95);
  EXPECT_EQ(json.at("disparity").at("scale"), 256);
  EXPECT_EQ(json.at("geometry").at("focal_length_px"), 500.25);
  EXPECT_EQ(json.at("geometry").at("baseline_m"), 0.12);
  EXPECT_EQ(json.at("geometry").at("principal_offset_px"), 10);
  EXPECT_EQ(json.at("geometry").at("calibration_format"), "OpenCV");
  EXPECT_NEAR(json.at("frame_rate").get<double>(), 30, 1e-6);
  EXPECT_EQ(json.at("inputs").at("kind"), "two video files");
  EXPECT_EQ(json.at("inputs").at("calibration"), "/a/calibration.yml");
  EXPECT_EQ(json.at("inputs").at("rectified"), false);
}

TEST(RunJson, StatesTheDefaultEndOfClouds) {
  const TemporaryFolder folder;
  Work work = example();
  work.options.far.reset();
  write_run_report(work, example_report(), 2, folder / "run.json");
  nlohmann::json json = nlohmann::json::parse(bytes_of(folder / "run.json"));
  EXPECT_EQ(json.at("limits").at("far_m"), 0);
  EXPECT_EQ(json.at("limits").at("far_of_clouds_m"), 500.25 * 0.12 / 4);
}

TEST(RunJson, ThatIsMissingHasNoFingerprint) {
  const TemporaryFolder folder;
  EXPECT_EQ(fingerprint_in(folder / "run.json"), "");
  write_text(folder / "run.json", "[1, 2");
  EXPECT_EQ(fingerprint_in(folder / "run.json"), "");
}

TEST(JsonFile, ThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(write_work(example(), "/proc/no/such/work.json"), UserError);
}

}  // namespace
}  // namespace mtstereo::run::json_test
