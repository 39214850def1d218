// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "lib/images/images.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "lib/outputs/write_file.hpp"

namespace mtstereo::calibrate {
namespace {

using outputs::decimal;

struct Paper {
  const char* name;
  double width, height;  // upright [mm]
};
constexpr std::array kPapers{Paper{"A4", 210, 297},  Paper{"A3", 297, 420},
                             Paper{"A2", 420, 594},  Paper{"A1", 594, 841},
                             Paper{"A0", 841, 1189}, Paper{"letter", 215.9, 279.4}};
constexpr const char* kFit = "fit";

constexpr double kMargin = 6;     // that printers leave white [mm]
constexpr double kTextSpace = 9;  // above and below the board [mm]
constexpr double kTextSize = 3;   // [mm]
constexpr double kRuler = 100;    // [mm]
constexpr double kPointsPerMm = 72 / 25.4;

void add_ruler(double x, double y, Page& page) {
  constexpr double kThin = 0.2;
  page.black.emplace_back(x, y - kThin / 2, kRuler, kThin);
  for (int i = 0; i <= 10; ++i) {
    const double tick = i % 5 == 0 ? 3 : 1.5;
    // The outer edges of the first and the last tick are 100 mm apart.
    const double at = x + 10 * i - (i == 0 ? 0 : i == 10 ? kThin : kThin / 2);
    page.black.emplace_back(at, y - tick / 2, kThin, tick);
  }
}

void add_text(double x, double y, double size, const std::string& text, Page& page) {
  PageText& line = page.texts.emplace_back();
  line.x = x;
  line.y = y;
  line.size = size;
  line.text = text;
}

void add_texts(const BoardOptions& board, Page& page) {
  constexpr double kSmallSize = 2.2;  // [mm]
  const double left = kMargin + 2;
  const double bottom = page.height - kMargin - 2;
  add_text(left, kMargin + kTextSize, kTextSize, "mtcalibrate: " + describe(board), page);
  add_ruler(left, bottom - 1, page);
  add_text(left + kRuler + 4, bottom - 2, kSmallSize,
           "This line is 100 mm long. Print without scaling, mount the", page);
  add_text(left + kRuler + 4, bottom + 1, kSmallSize,
           "board flat, measure a square and pass its side by --square.", page);
}

// Text of a PDF string.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char each : text) {
    if (each == '(' || each == ')' || each == '\\') result += '\\';
    result += each;
  }
  return result;
}

// The operators that draw the page. All rectangles are one path: no seams between them.
std::string pdf_content(const Page& page) {
  const auto number = [](double mm) { return decimal(mm * kPointsPerMm, 4) + " "; };
  std::string content = "0 g\n";
  for (const cv::Rect2d& each : page.black) {
    content += number(each.x) + number(page.height - each.y - each.height) + number(each.width) +
               number(each.height) + "re\n";
  }
  content += "f\n";
  for (const PageText& each : page.texts) {
    content += "BT /F1 " + number(each.size) + "Tf " + number(each.x) +
               number(page.height - each.y) + "Td (" + escaped(each.text) + ") Tj ET\n";
  }
  return content;
}

std::uint32_t png_crc(const std::string& bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char each : bytes) {
    crc ^= static_cast<std::uint8_t>(each);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> shift) & 0xff);
  return bytes;
}

// The chunk that states the resolution.
std::string resolution_chunk(std::uint32_t pixels_per_meter) {
  const std::string content =
      "pHYs" + big_endian(pixels_per_meter) + big_endian(pixels_per_meter) + '\1';
  return big_endian(9) + content + big_endian(png_crc(content));
}

}  // namespace

std::vector<std::string> paper_names() {
  std::vector<std::string> names;
  for (const Paper& paper : kPapers) names.emplace_back(paper.name);
  names.emplace_back(kFit);
  return names;
}

Page make_page(const BoardOptions& board, const std::string& paper) {
  const double width = 1000 * board.square * board.columns;
  const double height = 1000 * board.square * board.rows;
  // The white around the board is part of what the detection needs; the texts are outside of it.
  const double needed_width = width + 2 * kMargin;
  const double needed_height = height + 2 * (kMargin + kTextSpace);
  Page page;
  if (paper == kFit) {
    page.width = std::max(needed_width, kRuler + 100);
    page.height = needed_height;
  }
  for (const Paper& each : kPapers) {
    if (paper != each.name) continue;
    const bool across = width > height;
    page.width = across ? each.height : each.width;
    page.height = across ? each.width : each.height;
  }
  if (page.width < needed_width || page.height < needed_height) {
    throw UserError("the " + describe(board) + " is " + decimal(width, 0) + "x" +
                    decimal(height, 0) + " mm and does not fit on " + paper +
                    ": choose a larger --paper, or smaller or fewer squares");
  }
  const cv::Point2d origin((page.width - width) / 2, (page.height - height) / 2);
  for (const cv::Rect2d& each : black_rectangles(board)) {
    page.black.emplace_back(1000 * each.x + origin.x, 1000 * each.y + origin.y, 1000 * each.width,
                            1000 * each.height);
  }
  add_texts(board, page);
  return page;
}

std::string pdf_of(const Page& page) {
  const std::string content = pdf_content(page);
  const std::array<std::string, 5> objects{
      "<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
      "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " + decimal(page.width * kPointsPerMm, 4) + " " +
          decimal(page.height * kPointsPerMm, 4) +
          "] /Contents 4 0 R /Resources << /Font << /F1 5 0 R >> >> >>",
      "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "endstream",
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
  std::string file = "%PDF-1.4\n";
  std::string table = "xref\n0 6\n0000000000 65535 f \n";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string offset = std::to_string(file.size());
    table += std::string(10 - offset.size(), '0') + offset + " 00000 n \n";
    file += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::string start = std::to_string(file.size());
  return file + table + "trailer\n<< /Size 6 /Root 1 0 R >>\nstartxref\n" + start + "\n%%EOF\n";
}

std::string png_of(const Page& page, double pixels_per_mm) {
  // The resolution is stated in whole pixels per meter.
  const auto per_meter = static_cast<std::uint32_t>(std::lround(1000 * pixels_per_mm));
  const double scale = per_meter / 1000.0;
  const auto pixel = [&](double mm) { return static_cast<int>(std::lround(mm * scale)); };
  cv::Mat image(pixel(page.height), pixel(page.width), CV_8UC1, cv::Scalar(255));
  for (const cv::Rect2d& each : page.black) {
    const cv::Point from(pixel(each.x), pixel(each.y));
    const cv::Point to(pixel(each.x + each.width), pixel(each.y + each.height));
    image(cv::Rect(from, to) & cv::Rect({}, image.size())).setTo(0);
  }
  for (const PageText& each : page.texts) {
    // The simplex font is 21 px high at scale 1, and a third wider than Helvetica.
    cv::putText(image, each.text, {pixel(each.x), pixel(each.y)}, cv::FONT_HERSHEY_SIMPLEX,
                each.size * scale / 36, cv::Scalar(0), std::max(1, pixel(0.15)), cv::LINE_AA);
  }
  const std::string bytes = images::encode(".png", image);
  constexpr std::size_t kAfterHeader = 8 + 25;  // signature, IHDR
  return bytes.substr(0, kAfterHeader) + resolution_chunk(per_meter) + bytes.substr(kAfterHeader);
}

namespace {

// Whether a file has these bytes, or is a page of this program. PNG files do not state that.
bool is_page(const std::filesystem::path& file, const std::string& bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error))) return false;
  std::ifstream in(file, std::ios::binary);
  const std::string found{std::istreambuf_iterator<char>(in), {}};
  return found == bytes ||
         (found.starts_with("%PDF") && found.find("(mtcalibrate: ") < found.size());
}

}  // namespace

void write_page(const Page& page, const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".pdf" && extension != ".png") {
    throw UserError(file.string() + ": a board is a .pdf or .png file");
  }
  const std::string bytes = extension == ".pdf" ? pdf_of(page) : png_of(page);
  std::error_code error;
  const auto status = std::filesystem::symlink_status(file, error);
  if (std::filesystem::exists(status) && !is_page(file, bytes)) {
    throw UserError(file.string() +
                    " is in the way and is not a board of mtcalibrate: choose another name");
  }
  outputs::write_file(file, bytes);
}

}  // namespace mtstereo::calibrate
