// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "programs/calibrate/board.hpp"

// The board on paper, in true size. By hand on purpose: cairo can neither forbid printers to scale
// the PDF nor state the resolution of the PNG.

namespace mtstereo::calibrate {

/// One line of text on a page.
struct PageText {
  double x = 0, y = 0;  ///< left end of the baseline, from the upper left corner of the page [mm]
  double size = 0;      ///< [mm]
  std::string text;
};

/// A page to print.
struct Page {
  double width = 0;               ///< [mm]
  double height = 0;              ///< [mm]
  std::vector<cv::Rect2d> black;  ///< from the upper left corner [mm]
  std::vector<PageText> texts;
};

/// Names of paper sizes: A4, A3, ..., letter, and "fit" for one as large as the board needs.
std::vector<std::string> paper_names();

/// The board in the middle of a page, with its description, a line of 100 mm to measure, and what
/// to do with it. The page is upright or across, as the board fits. Throws UserError if it
/// does not.
Page make_page(const BoardOptions& board, const std::string& paper);

/// The page as a PDF, in vectors.
std::string pdf_of(const Page& page);

/// The page as a PNG that states its resolution, with this many pixels per mm, at least.
std::string png_of(const Page& page, double pixels_per_mm = 12);

/// Writes the page in the format of the extension, .pdf or .png. Throws UserError.
void write_page(const Page& page, const std::filesystem::path& file);

}  // namespace mtstereo::calibrate
