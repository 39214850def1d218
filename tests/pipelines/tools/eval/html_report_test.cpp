// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/html_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

namespace mtstereo::eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::uint8_t> from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

cv::Mat picture_of(const std::string& uri) {
  const std::string start = "data:image/jpeg;base64,";
  EXPECT_THAT(uri, ::testing::StartsWith(start));
  EXPECT_EQ((uri.size() - start.size()) % 4, 0U);
  return cv::imdecode(from_base64(uri.substr(start.size())), cv::IMREAD_UNCHANGED);
}

Report small_report() {
  Report report;
  report.dataset = "eth3d";
  report.folder = "a <folder>";
  report.parameters = {{"mode", "sparse"}};
  report.methods = {"mtstereo"};
  report.kinds = {"clean", "noise=5"};
  for (const std::string& kind : report.kinds) {
    PairReport pair;
    pair.pair.name = "A & \"B\"";
    pair.kind = kind;
    MethodResult result;
    result.method = "mtstereo";
    result.evaluation.all.avgerr = kind == "clean" ? 0.25 : 0.75;
    pair.results = {result};
    report.pairs.push_back(pair);
  }
  return report;
}

TEST(HtmlPictures, AreReducedToTheirWidth) {
  const cv::Mat gray(300, 2 * kHtmlPictureWidth, CV_8UC1, cv::Scalar(90));
  const cv::Mat truth(gray.size(), CV_32FC1, cv::Scalar(8));
  const HtmlPictures pictures = html_pictures({gray, gray, {truth, {}}}, truth, gray, 16);
  for (const std::string& uri :
       {pictures.left, pictures.truth, pictures.disparity, pictures.error, pictures.confidence}) {
    EXPECT_EQ(picture_of(uri).size(), cv::Size(kHtmlPictureWidth, 150));
  }
  EXPECT_EQ(pictures.truth, pictures.disparity);
  EXPECT_NEAR(picture_of(pictures.left).at<std::uint8_t>(75, 100), 90, 1);
}

TEST(HtmlPictures, KeepASmallSize) {
  for (const int width : {1, 7, 8, 9}) {
    EXPECT_EQ(picture_of(data_uri(cv::Mat(5, width, CV_8UC3, cv::Scalar::all(10)))).cols, width);
  }
}

TEST(HtmlReport, EscapesTexts) {
  EXPECT_EQ(html_text("a<b> & 'c' \"d\""), "a&lt;b&gt; &amp; &#39;c&#39; &quot;d&quot;");
  const std::string page = to_html(small_report());
  EXPECT_THAT(page, HasSubstr("a &lt;folder&gt;"));
  EXPECT_THAT(page, HasSubstr("A &amp; &quot;B&quot;"));
  EXPECT_THAT(page, Not(HasSubstr("<folder>")));
}

TEST(HtmlReport, HasTheFiguresOfEachKind) {
  const std::string page = to_html(small_report());
  EXPECT_THAT(page, HasSubstr("<td data-value='0.250'>0.250</td>"));
  EXPECT_THAT(page, HasSubstr("<td data-value='0.750'>0.750</td>"));
  EXPECT_THAT(page, HasSubstr("<td data-value=''>-</td>")) << "unknown figures are sorted last";
  EXPECT_THAT(page, HasSubstr("<option>noise=5</option>"));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST(HtmlReport, HasNoEmptyParts) {
  const std::string page = to_html(small_report());
  for (const char* absent : {"Flicker", "<svg", "<figure>"}) {
    EXPECT_THAT(page, Not(HasSubstr(absent)));
  }
}

TEST(HtmlCurve, DrawsTheLinesBetweenTheAxes) {
  CurveReport report;
  report.kind = "noise=5";
  Sweep sweep{{0}, {1, 2, 3}, {{100, 2, 1, 1}, {50, 1, 1, 1}, {kNone, kNone, kNone, kNone}}};
  report.curves.push_back({"mine & yours", "", 0, false, sweep});
  const std::string svg = curve_svg(report, kCurveMeasures[0]);
  EXPECT_THAT(svg, HasSubstr("noise=5: avgerr [px]"));
  // The axes begin at (40, 214) and are 320 px wide and 190 px high; the largest error is on top.
  EXPECT_THAT(svg, HasSubstr("points='360,24 200,119 '"));
  EXPECT_THAT(svg, HasSubstr("mine &amp; yours"));
}

TEST(Reports, SummarizeEachKindByItself) {
  const Report report = small_report();
  EXPECT_EQ(summarize(report)[0].evaluation.all.avgerr, 0.25);
  EXPECT_EQ(summarize(report, "noise=5")[0].evaluation.all.avgerr, 0.75);
  EXPECT_EQ(summarize(report, "noise=5")[0].pairs, 1);
  EXPECT_EQ(summarize(report, "fog=1")[0].pairs, 0);
}

}  // namespace
}  // namespace mtstereo::eval
