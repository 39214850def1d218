// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-fit-confidence: fits the table of core/stages/refine/reliability_table.cpp to pairs with
// ground truth and to rendered scenes, and reports what carries over to data sets left out.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>

#include "lib/options/failure_message.hpp"
#include "lib/outputs/user_error.hpp"
#include "tools/eval/degradation.hpp"
#include "tools/fit/fitting.hpp"
#include "tools/fit/samples.hpp"

namespace mtstereo::fit {
namespace {

const std::vector<std::string> kKinds = {eval::kCleanKind, "noise=5", "noise=10",  "jpeg=50",
                                         "jpeg=20",        "h264=28", "dark=0.15", "bright=1.8",
                                         "blur-right=1.5", "soft2x",  "cam",       "cam2x"};

/// Clean views count this much more than each kind of degraded ones.
constexpr int kCleanShare = 3;

std::vector<PairSamples> sample_all(const std::vector<TrainingPair>& pairs, RatedMap rated,
                                    const TableParts& guide, int count) {
  std::vector<PairSamples> samples(pairs.size() * kKinds.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string& kind = kKinds[i / pairs.size()];
    const int wanted = kind == eval::kCleanKind ? kCleanShare * count : count;
    samples[i] = take_samples(pairs[i % pairs.size()], kind, rated, guide, wanted);
  }
  return samples;
}

std::vector<const PairSamples*> without(const std::vector<PairSamples>& samples,
                                        const std::string& family) {
  std::vector<const PairSamples*> rest;
  for (const PairSamples& pair : samples) {
    if (pair.family != family) rest.push_back(&pair);
  }
  return rest;
}

/// The outcome for each kind of input, with tables that have not seen the pair's data sets.
void report(const std::vector<PairSamples>& samples, const TableParts& own) {
  std::map<std::string, TableParts> tables;
  for (const PairSamples& pair : samples) {
    if (tables.count(pair.family) == 0) {
      tables[pair.family] = library_table(fit(without(samples, pair.family)));
    }
  }
  std::printf(
      "D-all [%%] at density [%%], by tables fitted without the pair's family of data sets,\n"
      "and by the table of all families\n");
  for (const std::string& kind : kKinds) {
    std::vector<const PairSamples*> pairs;
    std::vector<const TableParts*> others;
    for (const PairSamples& pair : samples) {
      if (pair.kind != kind || pair.family == "rendered") continue;
      pairs.push_back(&pair);
      others.push_back(&tables[pair.family]);
    }
    if (pairs.empty()) continue;
    for (const int least : {160, 140, 120, 100, 80, 1}) {
      const Outcome left_out = outcome(pairs, others, least);
      const Outcome seen = outcome(pairs, {pairs.size(), &own}, least);
      std::printf("%-14s confidence >= %3d: %5.2f at %5.1f   %5.2f at %5.1f\n", kind.c_str(), least,
                  left_out.d_all, left_out.density, seen.d_all, seen.density);
    }
  }
}

/// The entries of each clue up to the last one that is not 0.
void write_part(const ReliabilityTable& part, std::ostream& file) {
  file << "        {{\n";
  for (const auto& clue : part) {
    int end = kClueBins;
    while (end > 1 && clue[end - 1] == 0) --end;
    file << "            {{";
    for (int bin = 0; bin < end; ++bin) {
      if (bin > 0) file << (bin % 16 == 0 ? ",\n              " : ", ");
      file << clue[bin];
    }
    file << "}},\n";
  }
  file << "        }},\n";
}

void write_tables(const std::array<TableParts, kRatedMaps>& tables, const std::string& path) {
  std::ofstream file(path);
  file << "// SPDX-License-Identifier: LGPL-2.1-or-later\n"
          "// Written by mtstereo-fit-confidence; do not change it by hand.\n"
          "#include \"stages/refine/reliability_table.hpp\"\n\nnamespace mtstereo {\n\n"
          "// clang-format off\n"
          "const std::array<TableParts, kRatedMaps> kReliabilityTables = {{\n";
  for (const TableParts& parts : tables) {
    file << "    {{\n";
    for (const ReliabilityTable& part : parts) write_part(part, file);
    file << "    }},\n";
  }
  file << "}};\n// clang-format on\n\n}  // namespace mtstereo\n";
  if (!file.flush()) throw mtstereo::UserError("cannot write " + path);
}

/// Fits the table of these pixels.
TableParts fitted(const std::vector<TrainingPair>& pairs, RatedMap rated, const TableParts& guide,
                  int count) {
  const std::vector<PairSamples> samples = sample_all(pairs, rated, guide, count);
  const TableParts table = library_table(fit(without(samples, "")));
  constexpr std::array kTitles = {"Mode full", "Mode full at half resolution",
                                  "Matched pixels of mode semi-dense",
                                  "The same at half resolution", "The map of half the resolution"};
  std::printf("%s\n", kTitles[static_cast<int>(rated)]);
  report(samples, table);
  return table;
}

int run(int argc, char** argv) {
  CLI::App app("Fits the confidence of complete maps to pairs with ground truth.");
  std::vector<std::string> folders;
  std::string out;
  int count = 20000;
  app.add_option("folder", folders, "data sets with ground truth, as for mtstereo-eval");
  app.add_option("--out", out, "file of the table")->required();
  app.add_option("--samples", count, "pixels of each pair")->check(CLI::PositiveNumber);
  app.failure_message(options::failure_message);
  CLI11_PARSE(app, argc, argv);
  if (!std::ofstream(out, std::ios::app)) throw mtstereo::UserError("cannot write " + out);
  std::vector<TrainingPair> pairs = rendered_pairs();
  for (const std::string& folder : folders) {
    for (TrainingPair& pair : pairs_in(folder)) pairs.push_back(std::move(pair));
  }
  std::array<TableParts, kRatedMaps> tables;
  // The guide first, since its rating is a clue for the others.
  constexpr int kGuideTable = static_cast<int>(RatedMap::kGuide);
  for (int i = kRatedMaps - 1; i >= 0; --i) {
    tables[i] = fitted(pairs, static_cast<RatedMap>(i), tables[kGuideTable], count);
  }
  write_tables(tables, out);
  return 0;
}

}  // namespace
}  // namespace mtstereo::fit

int main(int argc, char** argv) {
  try {
    return mtstereo::fit::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mtstereo-fit-confidence: %s\n", error.what());
    return 1;
  }
}
