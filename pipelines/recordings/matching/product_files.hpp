// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "recordings/matching/map_files.hpp"
#include "recordings/matching/matching_run.hpp"
#include "recordings/matching/piece.hpp"
#include "recordings/media/matroska.hpp"

namespace mtstereo::run {

/// The file or the folder of a product: "disparity.mkv", "disparity", "clouds".
std::string product_path(const WorkOptions& options, Product product);
/// All names that products can have.
std::vector<std::string> product_paths();
/// The file of one pair in the folder of a product: "000012.png".
std::string pair_file(const WorkOptions& options, Product product, std::int64_t pair);
/// Whether a product is one file with all pairs.
bool in_one_file(const WorkOptions& options, Product product);

/// Writes the products of pairs into a folder.
class ProductFiles {
 public:
  /// `done`: so many pairs are in the folder already, and are kept. Throws UserError.
  ProductFiles(const Work& work, std::filesystem::path folder, std::int64_t done);
  ~ProductFiles();
  ProductFiles(const ProductFiles&) = delete;
  ProductFiles& operator=(const ProductFiles&) = delete;

  /// Writes the products of a pair, and returns its figures. Throws UserError.
  FrameFigures write(const PairResult& result);
  /// Finishes the files.
  void finish();

 private:
  void write_video(Product product, GstSample* sample, std::int64_t pair);
  void write_file(Product product, const PairResult& result);

  const Work& work_;
  std::filesystem::path folder_;
  MapGeometry geometry_;
  std::map<Product, std::unique_ptr<MatroskaWriter>> videos_;
};

}  // namespace mtstereo::run
