// SPDX-License-Identifier: LGPL-2.1-or-later

// Several data sets that are evaluated together.

#include <iterator>
#include <set>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/datasets.hpp"
#include "tools/eval/layouts.hpp"

namespace mtstereo::eval {
namespace fs = std::filesystem;
namespace {

void put_below(const std::string& folder, DataSet& set) {
  for (StereoPair& pair : set.pairs) pair.name = folder + "/" + pair.name;
  for (Problem& problem : set.problems) problem.pair = folder + "/" + problem.pair;
  for (std::string& note : set.notes) note = folder + ": " + note;
}

template <typename T>
void append(std::vector<T>& target, std::vector<T>& source) {
  target.insert(target.end(), std::make_move_iterator(source.begin()),
                std::make_move_iterator(source.end()));
}

void add(DataSet& all, DataSet set, std::set<std::string>& layouts) {
  const std::string layout(layout_name(set.layout));
  if (layouts.insert(layout).second) all.name += (all.name.empty() ? "" : " + ") + layout;
  all.folder += (all.folder.empty() ? "" : ", ") + set.root.string();
  append(all.pairs, set.pairs);
  append(all.problems, set.problems);
  append(all.notes, set.notes);
}

}  // namespace

DataSet find_pairs(const std::vector<fs::path>& roots, std::optional<Layout> layout) {
  DataSet all;
  std::set<std::string> layouts, names;
  for (const fs::path& root : roots) {
    DataSet set = find_pairs(root, layout ? *layout : detect_layout(root));
    if (roots.size() > 1) put_below(own_name(set.root), set);
    if (layouts.empty()) {
      all.layout = set.layout;
      all.root = set.root;
    }
    add(all, std::move(set), layouts);
  }
  for (const StereoPair& pair : all.pairs) {
    if (names.insert(pair.name).second) continue;
    throw UserError("two pairs have the name " + pair.name + ": evaluate their folders one by one");
  }
  return all;
}

}  // namespace mtstereo::eval
