// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/outputs.hpp"

#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/files.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

void refuse_inputs(const fs::path& file, const DataSet& set) {
  for (const StereoPair& pair : set.pairs) {
    for (const fs::path& input :
         {pair.left, pair.right, pair.truth, pair.visible_mask, pair.visible_truth, pair.object_map,
          pair.cameras.first, pair.cameras.second}) {
      std::error_code not_there;
      if (!input.empty() && fs::equivalent(file, input, not_there)) {
        throw UserError(file, "belongs to the data set: choose another output file");
      }
    }
  }
}

// A report of this program begins in this way.
void refuse_foreign(const fs::path& file, const std::string& mark) {
  constexpr std::size_t kHead = 512;  // bytes
  std::error_code error;
  const fs::file_status status = fs::symlink_status(file, error);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) {
    throw UserError(file, "is a folder, a link, a pipe or a device: choose another output file");
  }
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.empty() || head.find(mark) != std::string::npos) return;
  throw UserError(file,
                  "is in the way, and mtstereo-eval did not write it: move it, or choose "
                  "another output file");
}

// Leaves no new file, because the evaluation may still fail.
void require_writable(const fs::path& file) {
  make_parent_folder(file);
  const bool was_there = fs::exists(file);
  if (!std::ofstream(file, std::ios::app)) throw UserError(file, "cannot be written");
  std::error_code ignored;
  if (!was_there) fs::remove(file, ignored);
}

bool attempt(const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const UserError& error) {
    std::cerr << "mtstereo-eval: " << error.what() << '\n';
    return false;
  }
}

}  // namespace

void check_outputs(const Options& options, const DataSet& set) {
  const std::pair<std::optional<fs::path>, const char*> files[] = {
      {options.json, "{\n  \"compared_methods\""}, {options.csv, "pair,method,region,"}};
  for (const auto& [file, mark] : files) {
    if (!file) continue;
    refuse_inputs(*file, set);
    refuse_foreign(*file, mark);
    require_writable(*file);
  }
}

bool write_outputs(const Options& options, const Report& report) {
  bool fine = true;
  if (options.json) {
    const std::string text = outputs::text_of(to_json(report), 2) + "\n";
    fine &= attempt([&] { write_bytes(*options.json, text); });
  }
  if (options.csv) fine &= attempt([&] { write_bytes(*options.csv, to_csv(report)); });
  return fine;
}

}  // namespace mtstereo::eval
