// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <tuple>

#include "lib/options/finite_range.hpp"
#include "lib/options/parse.hpp"
#include "lib/options/two_numbers.hpp"
#include "lib/outputs/user_error.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "mtstereo/parameters.hpp"
#include "programs/run/help_format.hpp"
#include "recordings/matching/matching_line.hpp"
#include "recordings/matching/products.hpp"
#include "recordings/matching/work_options.hpp"

namespace mtstereo::run {
namespace {

constexpr double kLongestOffset = 1e6;  // [s]
constexpr int kMostJobs = 1024;

const std::map<std::string, Arrangement> kLayouts{{"side-by-side", Arrangement::kSideBySide},
                                                  {"top-bottom", Arrangement::kTopBottom}};
const std::map<std::string, std::vector<Product>> kProducts{
    {"disparity", {Product::kDisparity}},
    {"depth", {Product::kDepth}},
    {"color", {Product::kColor}},
    {"confidence", {Product::kConfidence}},
    {"cloud", {Product::kCloud}},
    {"rectified", {Product::kRectifiedLeft, Product::kRectifiedRight}}};
const std::map<std::string, MapFormat> kFormats{
    {"mkv", MapFormat::kMatroska}, {"png", MapFormat::kPng}, {"pfm", MapFormat::kPfm}};
// The figures of each frame; run.json always has them.
constexpr const char* kStats = "stats";

// The option texts before validation.
struct Texts {
  std::string layout, rectified, size, sync = "none", format = "mkv";
  std::vector<std::string> what{"disparity"};
  double drift = 0;  // [ppm]
  std::map<std::string, std::string> parameters;
};

template <typename Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  return names;
}

void add_shape(CLI::App& app, Texts& texts, RectifiedShape& shape) {
  const std::string group = "Inputs";
  app.add_option("--alpha", shape.alpha,
                 "of the rectification: 0: only what both cameras see; 1: all pixels of both; "
                 "between: between; -1: the focal length of the cameras")
      ->type_name("NUMBER")
      ->check(CLI::Range(-1.0, 1.0).description(""))
      ->capture_default_str()
      ->group(group);
  app.add_option("--rectified-size", texts.size,
                 "size of the rectified views [px] [default: that of the views, or of the "
                 "rectification in the calibration]")
      ->type_name("WxH")
      ->group(group);
}

void apply_size(const std::string& text, RectifiedShape& shape) {
  if (text.empty()) return;
  std::tie(shape.width, shape.height) = options::two_numbers(text).value_or(std::pair(0, 0));
  const auto [least, most] = std::minmax(shape.width, shape.height);
  if (least >= 1 && most <= kLargestImageSide) return;
  throw CLI::ValidationError("--rectified-size", "'" + text + "' is not a size such as 640x480");
}

void apply_shape(const Texts& texts, RectifiedShape& shape) {
  apply_size(texts.size, shape);
  if (shape.alpha == kKeepScale || (shape.alpha >= 0 && shape.alpha <= 1)) return;
  throw CLI::ValidationError("--alpha", "must be 0 to 1, or -1");
}

void add_inputs(CLI::App& app, Texts& texts, Options& options) {
  const std::string group = "Inputs";
  app.add_option("INPUT", options.inputs,
                 "two videos, two images, folders or patterns of images (left/%06d.png, "
                 "'left/*.png'), one file or folder with both views, a folder of a data set "
                 "(KITTI, EuRoC, Middlebury, ETH3D), or a folder with any of these below it")
      ->required()
      ->expected(1, 2)
      ->type_name("");
  app.add_option("--layout", texts.layout,
                 "arrangement of both views in one file [default: by size and content]")
      ->check(CLI::IsMember(names_of(kLayouts)))
      ->group(group);
  app.add_flag(
         "--swap", options.input.swap,
         "exchange the views: the second input, or the second half of the frames, is the left one")
      ->group(group);
  app.add_option("--calibration", options.input.calibration,
                 "calibration file; a comma separates two [default: the "
                 "file beside the input]")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--rectified", texts.rectified,
                 "yes: the views are rectified, and the calibration only gives meters; no: rectify "
                 "them [default: by the input]")
      ->check(CLI::IsMember({"yes", "no"}))
      ->group(group);
  add_shape(app, texts, options.input.shape);
  app.add_option("--rate", options.input.frame_rate, "frames per second of images without times")
      ->type_name("N")
      ->check(options::finite_range(0.001, 100000))
      ->capture_default_str()
      ->group(group);
  app.add_option(
         "--sync", texts.sync,
         "for recorders started apart: auto finds offset and drift from the images; a number: how "
         "much later events are in the right recording; none: the times of the frames")
      ->type_name("auto|none|SECONDS")
      ->capture_default_str()
      ->group(group);
  app.add_option("--drift", texts.drift,
                 "with --sync SECONDS: how much faster the clock of the right recorder is")
      ->type_name("PPM")
      ->check(options::finite_range(-1e5, 1e5))
      ->group(group);
}

void add_limits(CLI::App& app, WorkOptions& work, const std::string& group) {
  constexpr double kFarthest = 1e6;  // of mtdepth [m]
  app.add_option("--near", work.near, "omit nearer depths and points")
      ->type_name("METERS")
      ->check(options::finite_range(0, kFarthest))
      ->capture_default_str()
      ->group(group);
  app.add_option("--far", work.far,
                 "omit farther depths and points, 0 = no limit [default: clouds end where "
                 "the disparity is 4 px, depth maps have no limit]")
      ->type_name("METERS")
      ->check(options::finite_range(0, kFarthest))
      ->group(group);
}

void add_outputs(CLI::App& app, Texts& texts, Options& options) {
  const std::string group = "Results";
  std::vector<std::string> products = names_of(kProducts);
  products.emplace_back(kStats);
  app.add_option("--out", options.folder,
                 options.plan ? "folder of the plan and of its results; all machines must see it"
                              : "folder of the results; several recordings get folders in it")
      ->type_name("DIR")
      ->group(group);
  app.add_option("--what", texts.what,
                 "results of each pair: disparity, depth, color, confidence, cloud, rectified (the "
                 "matched views), stats (figures, always written)")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(products))
      ->group(group);
  app.add_option("--format", texts.format,
                 "mkv: one lossless video (FFV1); png: 16-bit images; pfm: floating-point images "
                 "(px, m)")
      ->check(CLI::IsMember(names_of(kFormats)))
      ->capture_default_str()
      ->group(group);
  CLI::Option* const resume =
      app.add_flag("--resume", options.resume,
                   options.plan ? "plan again, and keep prepared recordings and finished tasks"
                                : "continue a run that was interrupted")
          ->group(group);
  app.add_flag("--overwrite", options.overwrite,
               options.plan ? "remove the plan in the folder and its results"
                            : "replace the results in the folder")
      ->excludes(resume)
      ->group(group);
  app.add_flag("--quiet", options.quiet, "print no progress")->group(group);
  add_limits(app, options.work, group);
}

void add_check(CLI::App& app, Options& options) {
  CLI::Option* const check =
      app.add_flag("--check", options.check,
                   "measure some pairs, and print a page: problems, remedies, and the density, "
                   "errors and time to expect; --out is optional, and gets an image of the rows");
  for (const char* const other : {"--resume", "--overwrite", "--list", "--jobs"}) {
    check->excludes(app.get_option(other));
  }
}

std::string value_name(const ParameterInfo& info) {
  if (info.type == ParameterType::kChoice) return info.choices;
  if (info.type == ParameterType::kBoolean) return "true|false";
  if (info.type == ParameterType::kLevels) return "LEVELS";
  return *info.unit == '\0' ? "NUMBER" : info.unit;
}

void add_parameter(CLI::App& app, Texts& texts, const std::string& name, const std::string& help,
                   const std::string& type) {
  app.add_option_function<std::string>(
         "--" + name, [&texts, name](const std::string& text) { texts.parameters[name] = text; },
         help)
      ->type_name(type)
      ->group("Matcher parameters");
}

void add_parameters(CLI::App& app, Texts& texts) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.id == Parameter::kThreads) {
      add_parameter(app, texts, info.name,
                    "threads that match, 0 = one for each processor; pairs run in parallel, and "
                    "the result does not depend on them [default: 0]",
                    "NUMBER");
      continue;
    }
    const bool is_range = info.id == Parameter::kMaxDisparity;
    const std::string range = is_range ? ", or that of the data set; auto: by the recording" : "";
    add_parameter(
        app, texts, info.name,
        std::string(info.help) + " [default: " + parameter_defaults_text(info.id) + range + "]",
        is_range ? "px|auto" : value_name(info));
  }
  add_parameter(app, texts, "disparity-scale",
                "steps per px of the maps [default: 256, or as many as fit the search range]",
                "NUMBER");
  add_parameter(app, texts, "alignment",
                "correct: measure misaligned rows of the right view once, and correct them in all "
                "pairs [default: correct; preset paper: off]",
                "off|correct");
  add_parameter(app, texts, "sharpness",
                "match: blur the sharper view like the other one [default: match; preset paper: "
                "keep]",
                "keep|match");
}

void apply_sync(const Texts& texts, Options& options) {
  if (texts.sync == "auto") {
    options.estimate = true;
  } else if (texts.sync != "none") {
    double offset = 0;
    if (!CLI::detail::lexical_cast(texts.sync, offset) || !(std::abs(offset) < kLongestOffset)) {
      throw CLI::ValidationError("--sync", "'" + texts.sync + "' is not auto, none or seconds");
    }
    options.relation = ClockRelation{offset, 1e-6 * texts.drift};
  }
  if (texts.drift != 0 && !options.relation) {
    throw CLI::ValidationError("--drift", "needs --sync SECONDS");
  }
}

void apply(const Texts& texts, Options& options) {
  if (!texts.layout.empty()) options.input.arrangement = kLayouts.at(texts.layout);
  if (!texts.rectified.empty()) options.input.rectified = texts.rectified == "yes";
  apply_shape(texts, options.input.shape);
  apply_sync(texts, options);
  WorkOptions& work = options.work;
  work.products.clear();
  for (const std::string& name : texts.what) {
    if (name == kStats) continue;
    for (const Product product : kProducts.at(name)) {
      if (!makes(work, product)) work.products.push_back(product);
    }
  }
  if (work.far && *work.far > 0 && work.near >= *work.far) {
    throw CLI::ValidationError("--near", "must be less than --far");
  }
  work.format = kFormats.at(texts.format);
  for (const auto& [name, value] : texts.parameters) {
    if (name == "threads") continue;
    work.parameters.emplace_back(name, value);
  }
  const auto threads = texts.parameters.find("threads");
  if (threads != texts.parameters.end()) {
    Parameters parameters;
    const Status status = parameters.set(Parameter::kThreads, threads->second);
    if (!status) throw CLI::ValidationError("--threads", status.error().message);
    work.threads = parameters.integer(Parameter::kThreads);
  }
  try {
    matcher_parameters(work);
  } catch (const UserError& error) {
    throw CLI::ValidationError(error.what());
  }
}

std::string examples(bool plan) {
  if (plan) {
    return "Examples:\n"
           "  mtstereo-run plan archive --out results --what disparity,depth\n"
           "  mtstereo-run plan archive --out results --resume\n\n";
  }
  return "Examples:\n"
         "  mtstereo-run left.mp4 right.mp4 --out result\n"
         "  mtstereo-run left.mp4 right.mp4 --check\n"
         "  mtstereo-run left.mp4 right.mp4 --max-disparity auto --sync auto --out result\n"
         "  mtstereo-run both.mp4 --calibration stereo.yaml --what depth,cloud --far 40 --out "
         "meters\n"
         "  mtstereo-run left right --rate 24 --format png --what disparity,rectified --out "
         "images\n\n";
}

void describe(CLI::App& app, bool plan) {
  app.set_version_flag("--version", MTSTEREO_VERSION);
  app.formatter(
      std::make_shared<HelpFormatter>(plan ? "mtstereo-run plan INPUT [INPUT] --out DIR [OPTIONS]"
                                           : "mtstereo-run INPUT [INPUT] --out DIR [OPTIONS]\n"
                                             "       mtstereo-run INPUT [INPUT] --check "
                                             "[OPTIONS]\n"
                                             "       mtstereo-run plan|task|merge ...    (archives "
                                             "on many machines; each has its own "
                                             "--help)"));
  app.footer(
      examples(plan) +
      std::string(plan ? "An interrupted call can be repeated: recordings that are prepared are "
                         "kept.\n"
                       : "") +
      "Exit status: 0 = done, 1 = nothing was done (the reason is printed), 2 = invalid command, 3 "
      "= partly done (unusable or damaged inputs are printed), 4 = useless results: views "
      "exchanged, at different times or not rectified, or less than 5 % density (the remedy is "
      "printed)" +
      (plan ? "." : "; --check: a finding harms the results."));
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  Options options;
  Texts texts;
  options.plan = argc > 1 && std::string(argv[1]) == "plan";
  CLI::App app{options.plan
                   ? "Divides the recordings of an archive into tasks, for mtstereo-run task "
                     "and merge."
                   : "Computes disparities, depths, clouds and figures of recordings of two "
                     "cameras."};
  describe(app, options.plan);
  add_inputs(app, texts, options);
  add_outputs(app, texts, options);
  app.add_option("--jobs", options.jobs,
                 options.plan ? "recordings that are prepared at the same time"
                              : "processes that do pieces of the recordings at the same time")
      ->check(CLI::Range(1, kMostJobs).description(""))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag("--list", options.list, "print the recordings that are found, and exit");
  options.plan ? add_plan_options(app, options.plan_options) : add_check(app, options);
  add_parameters(app, texts);
  // The parser sees the arguments after the name of the program.
  const int skipped = options.plan ? 1 : 0;
  const auto ended = options::parse(app, argc - skipped, argv + skipped, [&] {
    apply(texts, options);
    if (options.folder.empty() && !options.list && !options.check)
      throw CLI::RequiredError("--out");
  });
  if (ended) return {std::nullopt, *ended};
  options.plan_options.folder = options.folder;
  options.plan_options.jobs = options.jobs;
  return {std::move(options), kDone};
}

}  // namespace mtstereo::run
