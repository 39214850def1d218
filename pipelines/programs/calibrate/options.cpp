// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/options.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include "lib/options/finite_range.hpp"
#include "lib/options/parse.hpp"
#include "lib/options/two_numbers.hpp"
#include "programs/calibrate/charuco.hpp"
#include "programs/calibrate/page.hpp"

namespace mtstereo::calibrate {
namespace {

// The option texts before validation.
struct Texts {
  std::string side_by_side, top_bottom;
  std::string size;
  std::string pairing = "time";
  std::string pattern = "charuco";
  std::string squares = "9x6";
  double square = 28, marker = 0;  // [mm]
  std::string model = "plumb-bob";
};

void add_sources(CLI::App& app, Texts& texts, Options& options) {
  const std::string group = "Sources";
  app.add_option("--left", options.source.left,
                 "the left camera: a device (/dev/video0), a video file, a folder or pattern of "
                 "images (left/*.png, left/%04d.png), a URI, or a part of a gst-launch line in "
                 "quotes that ends with video")
      ->type_name("SOURCE")
      ->group(group);
  app.add_option("--right", options.source.right, "the right camera")
      ->type_name("SOURCE")
      ->group(group);
  app.add_option("--side-by-side", texts.side_by_side,
                 "one source with the left view in its left half")
      ->type_name("SOURCE")
      ->group(group);
  app.add_option("--top-bottom", texts.top_bottom,
                 "one source with the left view in its upper half")
      ->type_name("SOURCE")
      ->group(group);
  app.add_option(
         "--pairing", texts.pairing,
         "pair the frames of two videos by their time stamps, as mtstereo does, or by their "
         "index; images are always paired in order")
      ->check(CLI::IsMember({"time", "index"}))
      ->capture_default_str()
      ->group(group);
  app.add_option("--size", texts.size, "size requested from devices, such as 1280x720")
      ->group(group);
  app.add_option("--rate", options.source.rate, "frame rate requested from devices")
      ->check(options::finite_range(0.1, 1000))
      ->group(group);
  app.add_option("--timeout", options.source.timeout,
                 "stop with an error if a source delivers no frame for this time [s]")
      ->check(options::finite_range(0.1, 3600))
      ->capture_default_str()
      ->group(group);
}

std::string is_page(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".pdf" || extension == ".png") return {};
  return "a board is a PDF or PNG file: the name '" + file + "' must end in .pdf or .png";
}

void add_board(CLI::App& app, Texts& texts, Options& options) {
  const std::string group = "Board";
  app.add_option("--board", options.board_file,
                 "write the board to this PDF or PNG file in true size, and exit")
      ->check(is_page)
      ->type_name("FILE")
      ->group(group);
  app.add_option("--paper", options.paper, "paper of this file")
      ->check(CLI::IsMember(paper_names()))
      ->capture_default_str()
      ->group(group);
  app.add_option("--pattern", texts.pattern, "charuco (may be partly visible) or checkerboard")
      ->check(CLI::IsMember({"charuco", "checkerboard"}))
      ->capture_default_str()
      ->group(group);
  app.add_option("--squares", texts.squares, "columns and rows of squares (not of inner corners)")
      ->capture_default_str()
      ->group(group);
  app.add_option("--square", texts.square, "side of a square, as measured on the board [mm]")
      ->check(options::finite())
      ->capture_default_str()
      ->group(group);
  app.add_option("--marker", texts.marker, "side of a marker [mm]; 0 = 3/4 of a square")
      ->check(options::finite())
      ->capture_default_str()
      ->group(group);
  app.add_option("--dictionary", options.board.dictionary, "dictionary of the markers")
      ->check(CLI::IsMember(dictionary_names()))
      ->capture_default_str()
      ->group(group);
}

void add_rest(CLI::App& app, Texts& texts, Options& options) {
  app.add_option("--out", options.out, "folder of the result; created if missing")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_flag("--overwrite", options.overwrite, "replace a calibration in this folder");
  app.add_option("--model", texts.model,
                 "lens model: plumb-bob (5 coefficients), rational (8, for wide lenses), fisheye "
                 "(equidistant), or auto = the best on held-out views")
      ->check(CLI::IsMember({"plumb-bob", "rational", "fisheye", "auto"}))
      ->capture_default_str();
  app.add_option("--views", options.most_views,
                 "stop after this number of views of a video; live video stops earlier if all of "
                 "the image is covered")
      ->check(CLI::Range(5, 500))
      ->capture_default_str();
  app.add_flag("--stills", options.stills,
               "each frame of a video shows the board at rest; otherwise a view is taken only if "
               "the board does not move");
  app.add_option("--give-up", options.give_up,
                 "stop live video without a new view for this time [s], and use the views so far; "
                 "0 = never")
      ->check(options::finite_range(0, 86400))
      ->capture_default_str();
  app.add_flag("--strict", options.strict, "exit status 3 if there are warnings");
}

// "9x6"
cv::Size parse_size(const std::string& option, const std::string& text) {
  const auto size = options::two_numbers(text);
  if (!size) throw CLI::ValidationError(option, "'" + text + "' is not of the form 9x6");
  return {size->first, size->second};
}

void apply_source(const Texts& texts, SourceOptions& source) {
  const int given = (source.left.empty() && source.right.empty() ? 0 : 1) +
                    (texts.side_by_side.empty() ? 0 : 1) + (texts.top_bottom.empty() ? 0 : 1);
  if (given != 1) {
    throw CLI::ValidationError("sources",
                               "give --left and --right, or --side-by-side, or --top-bottom");
  }
  if (!texts.side_by_side.empty() || !texts.top_bottom.empty()) {
    const bool across = !texts.side_by_side.empty();
    source.arrangement = across ? Arrangement::kSideBySide : Arrangement::kTopBottom;
    source.left = across ? texts.side_by_side : texts.top_bottom;
  } else if (source.left.empty() || source.right.empty()) {
    throw CLI::ValidationError("sources", "both --left and --right are needed");
  } else if (std::error_code error; source.left == source.right ||
                                    std::filesystem::equivalent(source.left, source.right, error)) {
    throw CLI::ValidationError("sources", "--left and --right are the same source");
  }
  source.pairing = texts.pairing == "index" ? Pairing::kIndex : Pairing::kTime;
  if (!texts.size.empty()) source.size = parse_size("--size", texts.size);
}

void apply(const Texts& texts, Options& options) {
  const cv::Size squares = parse_size("--squares", texts.squares);
  options.board.kind = texts.pattern == "charuco" ? BoardKind::kCharuco : BoardKind::kCheckerboard;
  options.board.columns = squares.width;
  options.board.rows = squares.height;
  options.board.square = texts.square / 1000;
  options.board.marker = texts.marker / 1000;
  if (const std::string wrong = check(options.board); !wrong.empty()) {
    throw CLI::ValidationError("board", wrong);
  }
  const std::map<std::string, std::optional<Model>> models{{"plumb-bob", Model::kPlumbBob},
                                                           {"rational", Model::kRational},
                                                           {"fisheye", Model::kFisheye},
                                                           {"auto", std::nullopt}};
  options.model = models.at(texts.model);
  if (options.board_file.empty()) apply_source(texts, options.source);
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  CLI::App app{
      "Calibrates two cameras from views of a printed board, and rates the calibration. Print the "
      "board with --board first.",
      "mtcalibrate"};
  app.set_version_flag("--version", MTSTEREO_VERSION);
  app.footer(
      "The folder of --out gets calibration.yml for mtrectify, report.json, and images of the "
      "views, their coverage, the residuals and a rectified pair.\n"
      "Exit status: 0 = the calibration was written, 1 = it was not (the reason is printed), 2 = "
      "invalid command, 3 = written with warnings (only with --strict).");
  app.get_formatter()->column_width(36);
  Texts texts;
  Options options;
  add_sources(app, texts, options);
  add_board(app, texts, options);
  add_rest(app, texts, options);
  const auto ended = options::parse(app, argc, argv, [&] { apply(texts, options); });
  if (ended) return {std::nullopt, *ended};
  return {std::move(options), kWritten};
}

}  // namespace mtstereo::calibrate
