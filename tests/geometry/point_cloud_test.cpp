// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::point_cloud_test {
namespace {

using test::PaddedImage;
using Map = test::Plane<std::uint16_t>;
using Points = std::vector<CloudPoint>;

DepthGeometry rig() {
  DepthGeometry geometry;
  geometry.focal_length = 500;
  geometry.baseline = 0.2;
  geometry.principal_offset = 1.5;
  geometry.center_x = 15.25;
  geometry.center_y = 6.5;
  geometry.scale = 64;
  geometry.offset = -3;
  return geometry;
}

/// The images of one cloud, without padding. Colors have three channels.
struct Images {
  Map disparity;
  GrayPlane color;
  GrayPlane confidence;
};

Images random_images(int width, int height, std::uint64_t seed) {
  test::Random random(seed);
  Images images;
  images.disparity = Map(width, height);
  for (std::uint16_t& value : images.disparity.pixels) {
    value = static_cast<std::uint16_t>(random.below(3) == 0 ? 0 : random.between(1, 40 * 64));
  }
  images.color = test::noise(width * 3, height, seed + 1);
  images.confidence = test::noise(width, height, seed + 2);
  return images;
}

/// The points by the definition, pixel by pixel.
Points reference(const Images& images, const DepthGeometry& rig, const CloudOptions& options) {
  Points points;
  for (int y = 0; y < images.disparity.height; ++y) {
    for (int x = 0; x < images.disparity.width; ++x) {
      const int value = images.disparity(x, y);
      const int confidence = images.confidence.pixels.empty() ? 255 : images.confidence(x, y);
      const double disparity = value / rig.scale + rig.offset + rig.principal_offset;
      const bool left_out = value == 0 || disparity <= 0 || confidence < options.min_confidence ||
                            x % options.step != 0 || y % options.step != 0;
      if (left_out) continue;
      const double z = rig.focal_length * rig.baseline / disparity;
      if (z < options.near || z > options.far) continue;
      CloudPoint point;
      point.x = static_cast<float>((x - rig.center_x) * z / rig.focal_length);
      point.y = static_cast<float>((y - rig.center_y) * z / rig.focal_length);
      point.z = static_cast<float>(z);
      const bool colored = !images.color.pixels.empty();
      point.red = colored ? images.color(3 * x, y) : 255;
      point.green = colored ? images.color(3 * x + 1, y) : 255;
      point.blue = colored ? images.color(3 * x + 2, y) : 255;
      point.confidence = static_cast<std::uint8_t>(confidence);
      points.push_back(point);
    }
  }
  return points;
}

ImageView<const std::uint8_t> view_of(const GrayPlane& plane, int channels = 1) {
  if (plane.pixels.empty()) return {};
  return {plane.pixels.data(), plane.width / channels, plane.height, plane.width};
}

Points cloud_of(const Images& images, const DepthGeometry& geometry,
                const CloudOptions& options = {}) {
  const CloudInput input = {images.disparity.view(), view_of(images.color, 3), 3,
                            view_of(images.confidence)};
  Points points(7);
  const Status status = make_cloud(input, geometry, options, points);
  EXPECT_TRUE(status.ok()) << status.error().message;
  return points;
}

void expect_points(const Points& expected, const Points& actual) {
  ASSERT_EQ(expected.size(), actual.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const CloudPoint& e = expected[i];
    const CloudPoint& a = actual[i];
    ASSERT_NEAR(e.x, a.x, std::abs(e.x) * 1e-6) << "point " << i;
    ASSERT_NEAR(e.y, a.y, std::abs(e.y) * 1e-6) << "point " << i;
    ASSERT_EQ(e.z, a.z) << "point " << i;
    ASSERT_EQ(std::make_tuple(e.red, e.green, e.blue, e.confidence),
              std::make_tuple(a.red, a.green, a.blue, a.confidence))
        << "point " << i;
  }
}

TEST(Cloud, EqualsTheDefinition) {
  std::size_t points = 0;
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {33, 1}, {31, 13}, {64, 48}}) {
    const Images images = random_images(width, height, 5);
    for (const CloudOptions& options : {CloudOptions{},
                                        {.near = 4, .far = 12},
                                        {.min_confidence = 100},
                                        {.step = 3},
                                        {.near = 5, .far = 50, .min_confidence = 30, .step = 2}}) {
      const Points expected = reference(images, rig(), options);
      expect_points(expected, cloud_of(images, rig(), options));
      points += expected.size();
    }
  }
  EXPECT_GT(points, 2000u);
}

TEST(Cloud, HasTheAxesOfACamera) {
  Images images;
  images.disparity = Map(31, 14, 10 * 64);
  DepthGeometry geometry = rig();
  geometry.offset = geometry.principal_offset = 0;
  const Points points = cloud_of(images, geometry);  // at 10 m
  ASSERT_EQ(points.size(), 31u * 14);
  EXPECT_FLOAT_EQ(points.front().x, -15.25F * 10 / 500);
  EXPECT_FLOAT_EQ(points.front().y, -6.5F * 10 / 500);
  EXPECT_FLOAT_EQ(points.back().x, 14.75F * 10 / 500) << "x is to the right";
  EXPECT_FLOAT_EQ(points.back().y, 6.5F * 10 / 500) << "y is downwards";
  EXPECT_FLOAT_EQ(points.back().z, 10) << "z is forward";
}

TEST(Cloud, PointsAreWhiteAndCertainWithoutViewAndConfidence) {
  Images images;
  images.disparity = Map(3, 2, 640);
  for (const CloudPoint& point : cloud_of(images, rig(), {.min_confidence = 255})) {
    EXPECT_EQ(point.red, 255);
    EXPECT_EQ(point.green, 255);
    EXPECT_EQ(point.blue, 255);
    EXPECT_EQ(point.confidence, 255);
  }
}

TEST(Cloud, GrayViewsHaveThreeEqualComponents) {
  const Map map(4, 3, 640);
  const GrayPlane gray = test::noise(4, 3, 1);
  Points points;
  ASSERT_TRUE(make_cloud({map.view(), gray.view()}, rig(), {}, points).ok());
  ASSERT_EQ(points.size(), gray.pixels.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].red, gray.pixels[i]);
    EXPECT_EQ(points[i].green, gray.pixels[i]);
    EXPECT_EQ(points[i].blue, gray.pixels[i]);
  }
}

TEST(Cloud, PaddingIsIgnored) {
  const Images images = random_images(13, 7, 9);
  const Points expected = cloud_of(images, rig());
  const PaddedImage<std::uint16_t> map(images.disparity, 10, 4);
  const PaddedImage<std::uint8_t> color(images.color, 5, 1);
  const PaddedImage<std::uint8_t> confidence(images.confidence, 3, 7);
  ImageView<const std::uint8_t> color_view = color.view();
  color_view.width = 13;
  Points points;
  ASSERT_TRUE(make_cloud({map.view(), color_view, 3, confidence.view()}, rig(), {}, points).ok());
  EXPECT_EQ(expected, points);
}

TEST(Cloud, OfAMapWithoutDisparitiesIsEmpty) {
  Images images;
  images.disparity = Map(31, 13, 0);
  EXPECT_TRUE(cloud_of(images, rig()).empty());
  images.disparity = Map(31, 13, 64);  // 1 - 3 + 1.5 px: beyond infinity
  EXPECT_TRUE(cloud_of(images, rig()).empty());
}

TEST(Cloud, ReusesTheMemoryOfItsPoints) {
  const Images images = random_images(64, 48, 3);
  Points points = cloud_of(images, rig());
  const CloudPoint* memory = points.data();
  ASSERT_TRUE(make_cloud({images.disparity.view()}, rig(), {.step = 2}, points).ok());
  ASSERT_TRUE(make_cloud({images.disparity.view()}, rig(), {}, points).ok());
  EXPECT_EQ(points.data(), memory);
}

/// The error of an input; the points must be unchanged then.
Error error_of(const CloudInput& input, const DepthGeometry& geometry = rig(),
               const CloudOptions& options = {}) {
  Points points(3);
  const Status status = make_cloud(input, geometry, options, points);
  EXPECT_EQ(points, Points(3));
  if (!status.ok()) return status.error();
  ADD_FAILURE() << "it is accepted";
  return {ErrorCode::kSystem, ""};
}

TEST(Cloud, RefusesImagesThatDoNotFit) {
  const Map map(8, 4, 640);
  const GrayPlane small(7, 4);
  EXPECT_EQ(error_of({}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(error_of({.disparity = {map.pixels.data(), 8, 4, 15}}).code, ErrorCode::kInvalidImage);
  const Error color = error_of({.disparity = map.view(), .color = small.view()});
  EXPECT_EQ(color.code, ErrorCode::kSizeMismatch);
  EXPECT_NE(color.message.find("7x4"), std::string::npos) << color.message;
  const Error confidence = error_of({.disparity = map.view(), .confidence = small.view()});
  EXPECT_EQ(confidence.code, ErrorCode::kSizeMismatch);
  EXPECT_NE(confidence.message.find("confidence"), std::string::npos) << confidence.message;
  const GrayPlane gray(8, 4);
  EXPECT_EQ(error_of({.disparity = map.view(), .color = gray.view(), .color_channels = 3}).code,
            ErrorCode::kInvalidImage)
      << "the stride is that of a gray view";
  EXPECT_EQ(error_of({.disparity = map.view(), .color = gray.view(), .color_channels = 2}).code,
            ErrorCode::kInvalidParameter);
}

TEST(Cloud, RefusesGeometriesAndOptionsThatMakeNoSense) {
  const Map map(8, 4, 640);
  DepthGeometry geometry = rig();
  geometry.center_x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of({map.view()}, geometry).code, ErrorCode::kInvalidCalibration);
  EXPECT_EQ(error_of({map.view()}, DepthGeometry{}).code, ErrorCode::kInvalidCalibration);
  for (const CloudOptions& options : {CloudOptions{.near = 3, .far = 3},
                                      {.near = -1},
                                      {.min_confidence = 256},
                                      {.min_confidence = -1},
                                      {.step = 0},
                                      {.step = -2}}) {
    EXPECT_EQ(error_of({map.view()}, rig(), options).code, ErrorCode::kInvalidParameter);
  }
}

}  // namespace
}  // namespace mtstereo::point_cloud_test
