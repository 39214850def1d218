// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/check_command.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "lib/images/images.hpp"
#include "lib/outputs/listed_folder.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/run/check_page.hpp"
#include "programs/run/interruption.hpp"
#include "recordings/checks/rows_image.hpp"
#include "recordings/inputs/recording_files.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImage = "rows.png";

void write_image(const Work& work, outputs::ListedFolder& files) {
  const cv::Mat image = draw_rows(work);
  if (image.empty()) return;
  const std::string bytes = images::encode(".png", image);
  if (bytes.empty()) throw UserError(std::string(kImage) + ": cannot be encoded");
  files.write(kImage, bytes);
}

int check(const Recording& recording, const Options& options, const fs::path& folder) {
  // What is in the way of the image is found before anything is measured.
  std::optional<outputs::ListedFolder> files;
  if (!folder.empty()) {
    files.emplace(folder, "mtstereo-check");
    files->check({kImage}, outputs::FileSet(recording_files(recording)));
  }
  const bool two = recording.arrangement == Arrangement::kTwoSources;
  const CheckFigures figures = measure(
      recording, options.work, two ? options.relation : std::nullopt, two && options.estimate);
  const std::vector<Finding> findings = find_problems(figures);
  std::cout << check_page(figures, findings) << std::flush;
  if (files) {
    write_image(figures.work, *files);
    std::cout << "Rows: " << outputs::printable((folder / kImage).string()) << std::endl;
  }
  const bool harms =
      std::any_of(findings.begin(), findings.end(), [](const Finding& each) { return each.harms; });
  return harms ? kWorthless : kDone;
}

}  // namespace

int run_check_command(const std::vector<Recording>& recordings,
                      const std::vector<Problem>& problems, const Options& options) {
  end_at_signals("mtstereo-run: interrupted\n", kIncomplete);
  if (recordings.size() == 1 && problems.empty()) {
    return check(recordings.front(), options, options.folder);
  }
  int status = problems.empty() ? kDone : kIncomplete;
  std::size_t failed = 0;
  for (const Recording& recording : recordings) {
    if (&recording != &recordings.front()) std::cout << '\n';
    try {
      const fs::path folder = options.folder.empty() ? fs::path() : options.folder / recording.name;
      status = std::max(status, check(recording, options, folder));
    } catch (const std::exception& error) {
      std::cerr << "mtstereo-run: " << error.what() << '\n';
      status = std::max<int>(status, kIncomplete);
      ++failed;
    }
  }
  return failed == recordings.size() ? kFailed : status;
}

}  // namespace mtstereo::run
