// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "lib/options/finite_range.hpp"
#include "lib/options/parse.hpp"
#include "lib/outputs/user_error.hpp"

namespace mtstereo::eval {
namespace {

// The option texts before validation.
struct Texts {
  std::vector<std::string> folders;
  std::string dataset = "auto";
  std::string dmap = "auto";
  std::string json, disparity_folder, image_folder;
  std::vector<std::string> compare;
  std::vector<std::string> degrade;
  std::string alignment;
  std::map<std::string, std::string> parameters;
};

std::string parameter_help(const ParameterInfo& info) {
  if (info.id == Parameter::kMaxDisparity) {
    return std::string(info.help) + " [default: from the data set]";
  }
  return std::string(info.help) + " [default: " + parameter_defaults_text(info.id) + "]";
}

std::string value_name(const ParameterInfo& info) {
  switch (info.type) {
    case ParameterType::kChoice:
      return info.choices;
    case ParameterType::kBoolean:
      return "true|false";
    case ParameterType::kLevels:
      return "LEVELS";
    case ParameterType::kInteger:
    case ParameterType::kNumber:
      break;
  }
  return *info.unit == '\0' ? "NUMBER" : info.unit;
}

void add_parameters(CLI::App& app, Texts& texts) {
  for (const ParameterInfo& info : parameter_table()) {
    app.add_option_function<std::string>(
           std::string("--") + info.name,
           [&texts, name = std::string(info.name)](const std::string& text) {
             texts.parameters[name] = text;
           },
           parameter_help(info))
        ->type_name(value_name(info))
        ->group("Matcher parameters");
  }
}

void add_options(CLI::App& app, Texts& texts, Options& options) {
  std::vector<std::string> layouts = layout_names();
  layouts.insert(layouts.begin(), "auto");
  app.add_option("FOLDER", texts.folders, "folders of the data sets")->required()->type_name("");
  app.add_option("--dataset", texts.dataset, "layout of each FOLDER")
      ->check(CLI::IsMember(layouts))
      ->capture_default_str();
  app.add_option("--only", options.only,
                 "run only pairs whose name contains TEXT, or one of several texts")
      ->type_name("TEXT,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--limit", options.limit, "run at most the first N of these pairs; 0 = all")
      ->type_name("N")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  app.add_flag("--list", options.list, "list the pairs that were found and exit");
  app.add_option(
         "--dmap", texts.dmap,
         "meaning of the values in a *_dmap.bin; auto = depth if both *_cam.txt exist, else "
         "disparity")
      ->check(CLI::IsMember({"auto", "depth", "disparity"}))
      ->capture_default_str();
  app.add_option("--warm-up", options.run.warm_up,
                 "untimed frames of each pair before the timed ones")
      ->type_name("N")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--repeat", options.run.repeat,
                 "timed frames of each pair; the reported time is their median")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void add_methods(CLI::App& app, Texts& texts, Options& options) {
  app.add_option("--compare", texts.compare,
                 "also run these matchers of OpenCV on the same pairs: sgbm, sgbm-3way, sgbm-hh, "
                 "bm")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(opencv_names()));
  app.add_option("--alignment", texts.alignment,
                 "correct: align the rows and even out the sharpness of each pair before mtstereo "
                 "matches it, as the element does; off: match it as it is [default: correct; off "
                 "with preset paper]")
      ->type_name("off|correct")
      ->check(CLI::IsMember({"off", "correct"}));
  app.add_option("--degrade", texts.degrade,
                 "also evaluate degraded images: " + degradation_kinds())
      ->type_name("KIND,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--flicker", options.run.flicker,
                 "also measure how the disparities of " + std::to_string(kFlickerFrames) +
                     " frames differ that have fresh noise of this standard deviation")
      ->type_name("SIGMA")
      ->check(options::finite_range(0.1, 100));
  app.add_flag("--stream", options.run.stream,
               "the pairs, in the order of their names, are frames of one stream; also measure how "
               "the disparities of each " +
                   std::to_string(kFlickerFrames) + " differ")
      ->excludes("--flicker", "--degrade", "--warm-up", "--repeat");
}

void add_outputs(CLI::App& app, Texts& texts, Options& options) {
  const std::string group = "Output";
  app.add_option("--json", texts.json, "write all figures to this file as JSON")
      ->type_name("FILE")
      ->group(group);
  app.add_flag("--curve", options.run.curve,
               "sweep the confidence and print the errors at equal density; with --compare, sweep "
               "the uniquenessRatio of those matchers too; --json has the curves for plot.py")
      ->group(group);
  app.add_option("--write-disparity", texts.disparity_folder,
                 "write the disparity maps to this folder as PFM: 32-bit float, infinity = none")
      ->type_name("DIR")
      ->group(group);
  app.add_option("--write-pictures", texts.image_folder,
                 "write an image of each pair to this folder: left image, ground truth, disparity "
                 "and error")
      ->type_name("DIR")
      ->group(group);
}

std::optional<std::filesystem::path> path_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return std::filesystem::path(text);
}

// The library checks the parameters; its messages state value and range.
void apply_parameters(const Texts& texts, Parameters& parameters) {
  for (const ParameterInfo& info : parameter_table()) {
    const auto found = texts.parameters.find(info.name);
    if (found == texts.parameters.end()) continue;
    const Status status = parameters.set(info.id, found->second);
    if (!status) throw CLI::ValidationError(std::string("--") + info.name, status.error().message);
  }
}

void apply_degradations(const Texts& texts, std::vector<Degradation>& degradations) {
  std::set<std::string> known;
  for (const std::string& text : texts.degrade) {
    try {
      const Degradation degradation = parse_degradation(text);
      if (known.insert(degradation_text(degradation)).second) degradations.push_back(degradation);
    } catch (const UserError& error) {
      throw CLI::ValidationError("--degrade", error.what());
    }
  }
}

void apply(const Texts& texts, Options& options) {
  apply_parameters(texts, options.run.parameters);
  options.folders.assign(texts.folders.begin(), texts.folders.end());
  if (texts.dataset != "auto") options.layout = find_layout(texts.dataset);
  if (texts.dmap == "depth") options.run.dmap = DmapMeaning::kDepth;
  if (texts.dmap == "disparity") options.run.dmap = DmapMeaning::kDisparity;
  for (const std::string& name : texts.compare) {
    const OpenCvMethod method = *find_opencv(name);
    const std::vector<OpenCvMethod>& known = options.run.opencv_methods;
    const bool twice = std::find(known.begin(), known.end(), method) != known.end();
    if (!twice) options.run.opencv_methods.push_back(method);
  }
  if (!texts.alignment.empty()) options.run.align = texts.alignment == "correct";
  apply_degradations(texts, options.run.degradations);
  options.json = path_of(texts.json);
  options.run.disparity_folder = path_of(texts.disparity_folder);
  options.run.image_folder = path_of(texts.image_folder);
  if (options.run.stream) options.run.warm_up = 0;  // it would be an earlier frame
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  CLI::App app{"Matches stereo pairs with ground truth, and measures errors, density and time.",
               "mtstereo-eval"};
  app.set_version_flag("--version", version());
  app.footer(
      "Exit status: 0 = all pairs were evaluated, 1 = some could not be evaluated or a file could "
      "not be written (each is named), 2 = the command is invalid or there is nothing to "
      "evaluate.");
  app.get_formatter()->column_width(36);
  Texts texts;
  Options options;
  add_options(app, texts, options);
  add_methods(app, texts, options);
  add_outputs(app, texts, options);
  add_parameters(app, texts);
  const auto ended = options::parse(app, argc, argv, [&] { apply(texts, options); });
  if (ended) return {std::nullopt, *ended};
  return {std::move(options), kAllFine};
}

}  // namespace mtstereo::eval
