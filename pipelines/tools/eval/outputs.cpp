// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/outputs.hpp"

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/files.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

void refuse_inputs(const fs::path& file, const DataSet& set) {
  for (const StereoPair& pair : set.pairs) {
    for (const fs::path& input : {pair.left, pair.right, pair.truth, pair.visible_mask,
                                  pair.visible_truth, pair.cameras.first, pair.cameras.second}) {
      std::error_code not_there;
      if (!input.empty() && fs::equivalent(file, input, not_there)) {
        throw UserError(file, "belongs to the data set: choose another output file");
      }
    }
  }
}

// A report of this program begins in this way.
void refuse_foreign(const fs::path& file) {
  constexpr std::size_t kHead = 512;  // bytes
  constexpr const char* kMark = "{\n  \"compared_methods\"";
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
  if (head.empty() || head.find(kMark) != std::string::npos) return;
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

}  // namespace

void check_outputs(const Options& options, const DataSet& set) {
  if (!options.json) return;
  refuse_inputs(*options.json, set);
  refuse_foreign(*options.json);
  require_writable(*options.json);
}

bool write_outputs(const Options& options, const Report& report) {
  if (!options.json) return true;
  const std::string text = outputs::text_of(to_json(report), 2) + "\n";
  try {
    write_bytes(*options.json, text);
    return true;
  } catch (const UserError& error) {
    std::cerr << "mtstereo-eval: " << error.what() << '\n';
    return false;
  }
}

}  // namespace mtstereo::eval
