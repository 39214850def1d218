// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::depth_test {
namespace {

using test::PaddedImage;
using Map = test::Plane<std::uint16_t>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A rig as that of KITTI.
DepthGeometry kitti() {
  DepthGeometry geometry;
  geometry.focal_length = 707.0912;
  geometry.baseline = 0.5371507;
  geometry.center_x = 601.8873;
  geometry.center_y = 183.1104;
  return geometry;
}

DepthConverter converter(const DepthGeometry& geometry, const DepthOptions& options = {}) {
  Result<DepthConverter> result = DepthConverter::create(geometry, options);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result.value());
}

/// The depth in units before it is rounded; not positive if there is none.
long double exact_units(const DepthGeometry& geometry, const DepthOptions& options, int value) {
  const long double disparity = static_cast<long double>(value) / geometry.scale + geometry.offset +
                                geometry.principal_offset;
  return static_cast<long double>(geometry.focal_length) * geometry.baseline / disparity /
         options.unit;
}

/// The value for the depth by the rules of the header, one after the other.
int reference(const DepthGeometry& geometry, const DepthOptions& options, int value) {
  if (value == 0) return 0;
  const long double units = exact_units(geometry, options, value);
  const bool finite = units > 0 && std::isfinite(units);
  const long double depth = finite ? units * options.unit : kInfinity;
  if (depth < options.near || depth > options.far) return 0;
  if (!finite || units >= 65535.5L) return options.clamp ? 65535 : 0;
  return std::max(1, static_cast<int>(std::floor(units + 0.5L)));
}

/// Compares all 65536 values. At the limits and between two units the last bit of a double may
/// decide: one unit of difference, or none, is accepted where the exact depth is that near.
void expect_reference(const DepthGeometry& geometry, const DepthOptions& options) {
  const DepthConverter convert = converter(geometry, options);
  constexpr long double kLastBits = 1e-9L;
  for (int value = 0; value < 65536; ++value) {
    const int expected = reference(geometry, options, value);
    const int actual = convert.depth16_of(static_cast<std::uint16_t>(value));
    if (expected == actual) continue;
    const long double units = exact_units(geometry, options, value);
    const auto near = [&](long double limit) {
      return std::abs(units - limit) < kLastBits * std::max(1.0L, std::abs(limit));
    };
    ASSERT_TRUE(near(std::floor(units) + 0.5L) || near(options.near / options.unit) ||
                near(options.far / options.unit))
        << "value " << value << ": expected " << expected << ", got " << actual;
  }
}

TEST(DepthGeometry, IsFocalLengthTimesBaselineOverDisparity) {
  DepthGeometry geometry = kitti();
  EXPECT_DOUBLE_EQ(geometry.depth_of(256), 707.0912 * 0.5371507);
  EXPECT_DOUBLE_EQ(geometry.depth_of(10 * 256), 70.70912 * 0.5371507);
  geometry.scale = 16;
  EXPECT_DOUBLE_EQ(geometry.depth_of(160), 70.70912 * 0.5371507);
}

TEST(DepthGeometry, AddsBothOffsetsToTheDisparity) {
  DepthGeometry geometry = kitti();
  geometry.offset = -20;
  geometry.principal_offset = 12.5;
  EXPECT_DOUBLE_EQ(geometry.depth_of(17 * 256 + 128), 70.70912 * 0.5371507);
}

TEST(DepthGeometry, IsInfiniteWithoutADisparityAndBeyondInfinity) {
  DepthGeometry geometry = kitti();
  EXPECT_EQ(geometry.depth_of(0), kInfinity);
  geometry.offset = -2;
  EXPECT_EQ(geometry.depth_of(2 * 256), kInfinity);
  EXPECT_EQ(geometry.depth_of(256), kInfinity);
  EXPECT_LT(geometry.depth_of(2 * 256 + 1), kInfinity);
}

TEST(DepthGeometry, StatesTheChangeOfTheDepthPerDisparity) {
  const DepthGeometry geometry = kitti();
  const double depth = geometry.depth_of(20 * 256);
  EXPECT_NEAR(geometry.depth_step(depth, 1.0 / 256), depth - geometry.depth_of(20 * 256 + 1), 1e-5);
}

TEST(DepthConverter, EqualsTheFormulaForAllValues) {
  for (const double scale : {256.0, 16.0, 1.0, 33.0}) {
    for (const double offset : {0.0, -20.0}) {
      for (const double unit : {0.001, 0.01, 1.0, 0.0254}) {
        DepthGeometry geometry = kitti();
        geometry.scale = scale;
        geometry.offset = offset;
        geometry.principal_offset = offset == 0 ? 0 : 3.25;
        expect_reference(geometry, {.unit = unit});
        expect_reference(geometry, {.unit = unit, .near = 2, .far = 40, .clamp = true});
      }
    }
  }
}

TEST(DepthConverter, RoundsToTheNearestUnit) {
  DepthGeometry geometry;
  geometry.focal_length = 1000;
  geometry.baseline = 0.25;
  geometry.scale = 1;  // depth = 250 / value m
  const DepthConverter convert = converter(geometry, {.unit = 1});
  EXPECT_EQ(convert.depth16_of(250), 1);
  EXPECT_EQ(convert.depth16_of(100), 3) << "2.5 is rounded up";
  EXPECT_EQ(convert.depth16_of(101), 2);
  EXPECT_EQ(convert.depth16_of(65535), 1) << "a depth below half a unit is not none";
}

TEST(DepthConverter, NeverWraps) {
  const DepthConverter none = converter(kitti());
  const DepthConverter clamped = converter(kitti(), {.clamp = true});
  EXPECT_EQ(none.depth16_of(1), 0);
  EXPECT_EQ(clamped.depth16_of(1), 65535);
  EXPECT_EQ(clamped.depth16_of(0), 0) << "no disparity has no depth";
  int last = 65535;
  for (int value = 1; value < 65536; ++value) {
    const int depth = clamped.depth16_of(static_cast<std::uint16_t>(value));
    ASSERT_LE(depth, last) << value;
    last = depth;
  }
}

TEST(DepthConverter, LeavesOutWhatIsNotInTheRange) {
  const DepthGeometry geometry = kitti();
  const DepthConverter convert = converter(geometry, {.near = 10, .far = 20, .clamp = true});
  for (int value = 1; value < 65536; ++value) {
    const double depth = geometry.depth_of(static_cast<std::uint16_t>(value));
    const int written = convert.depth16_of(static_cast<std::uint16_t>(value));
    ASSERT_EQ(written != 0, depth >= 10 && depth <= 20) << value;
  }
}

TEST(DepthConverter, InfinityIsClampedOrNone) {
  DepthGeometry geometry = kitti();
  geometry.offset = -2;
  EXPECT_EQ(converter(geometry, {.clamp = true}).depth16_of(512), 65535);
  EXPECT_EQ(converter(geometry).depth16_of(512), 0);
  EXPECT_EQ(converter(geometry, {.far = 1e6, .clamp = true}).depth16_of(512), 0);
}

TEST(DepthConverter, WritesOnlyThePixelsOfAPaddedImage) {
  test::Random random(1);
  const DepthConverter convert = converter(kitti());
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {33, 1}, {31, 13}, {64, 3}}) {
    Map map(width, height);
    for (std::uint16_t& value : map.pixels) {
      value = static_cast<std::uint16_t>(random.between(0, 65535));
    }
    for (const int padding : {0, 2, 30}) {
      const PaddedImage<std::uint16_t> in(map, padding, 2);
      PaddedImage<std::uint16_t> out(Map(width, height), padding + 4);
      const Status status = convert.convert(in.view(), out.writable());
      ASSERT_TRUE(status.ok()) << status.error().message;
      EXPECT_TRUE(test::same_pixels(
          width, height, [&](int x, int y) { return convert.depth16_of(map(x, y)); },
          [&](int x, int y) { return out.view().row(y)[x]; }));
      EXPECT_TRUE(in.unchanged());
      EXPECT_TRUE(out.padding_unchanged());
    }
  }
}

TEST(DepthConverter, MayWriteInPlace) {
  const Map map = [] {
    Map values(5, 4);
    for (std::size_t i = 0; i < values.pixels.size(); ++i) {
      values.pixels[i] = static_cast<std::uint16_t>(i * 3000);
    }
    return values;
  }();
  const DepthConverter convert = converter(kitti());
  PaddedImage<std::uint16_t> image(map, 6);
  ASSERT_TRUE(convert.convert(image.view(), image.writable()).ok());
  EXPECT_TRUE(test::same_pixels(
      5, 4, [&](int x, int y) { return convert.depth16_of(map(x, y)); },
      [&](int x, int y) { return image.view().row(y)[x]; }));
  EXPECT_TRUE(image.padding_unchanged());
}

TEST(DepthConverter, RefusesImagesThatDoNotFit) {
  const DepthConverter convert = converter(kitti());
  Map map(8, 4, 256);
  const auto write = [&](ImageView<const std::uint16_t> in, ImageView<std::uint16_t> out) {
    const Status status = convert.convert(in, out);
    EXPECT_FALSE(status.ok());
    return status.ok() ? Error{ErrorCode::kSystem, ""} : status.error();
  };
  std::uint16_t* data = map.pixels.data();
  const Error sizes = write(map.view(), {data, 4, 8, 8});
  EXPECT_EQ(sizes.code, ErrorCode::kSizeMismatch);
  EXPECT_NE(sizes.message.find("8x4"), std::string::npos) << sizes.message;
  EXPECT_NE(sizes.message.find("4x8"), std::string::npos) << sizes.message;
  EXPECT_EQ(write({}, {}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write(map.view(), {nullptr, 8, 4, 16}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write({data, 8, 4, 15}, {data, 8, 4, 16}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write({data, 8, 4, 16}, {data, 8, 4, 14}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write({data, 0, 4, 16}, {data, 0, 4, 16}).code, ErrorCode::kInvalidImage);
}

/// The refusal of a geometry; "" if it is accepted.
std::string refusal(const DepthGeometry& geometry) {
  const Result<DepthConverter> result = DepthConverter::create(geometry, {});
  const Status status = check_geometry(geometry);
  EXPECT_EQ(result.ok(), status.ok());
  if (status) return "";
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidCalibration);
  EXPECT_EQ(status.error().message, result.error().message);
  return status.error().message;
}

TEST(DepthConverter, NamesTheValueOfAnInvalidGeometry) {
  EXPECT_EQ(refusal(kitti()), "");
  const std::pair<double DepthGeometry::*, const char*> fields[] = {
      {&DepthGeometry::focal_length, "focal length"},
      {&DepthGeometry::baseline, "baseline"},
      {&DepthGeometry::scale, "scale"},
      {&DepthGeometry::principal_offset, "principal offset"},
      {&DepthGeometry::center_x, "column"},
      {&DepthGeometry::center_y, "row"},
      {&DepthGeometry::offset, "disparity offset"}};
  int number = 0;
  for (const auto& [field, name] : fields) {
    for (const double value : {kNaN, kInfinity, -kInfinity}) {
      DepthGeometry geometry = kitti();
      geometry.*field = value;
      EXPECT_NE(refusal(geometry).find(name), std::string::npos) << name << " " << value;
    }
    for (const double value : {0.0, -1.0}) {
      DepthGeometry geometry = kitti();
      geometry.*field = value;
      EXPECT_EQ(refusal(geometry).empty(), number >= 3) << name << " " << value;
    }
    ++number;
  }
}

TEST(DepthConverter, RefusesUnitsAndRangesThatMakeNoSense) {
  for (const DepthOptions& options : {DepthOptions{.unit = 0},
                                      {.unit = -0.001},
                                      {.unit = kNaN},
                                      {.unit = kInfinity},
                                      {.near = -1},
                                      {.near = kNaN},
                                      {.near = 5, .far = 5},
                                      {.near = 5, .far = 4},
                                      {.far = kNaN},
                                      {.near = kInfinity}}) {
    const Result<DepthConverter> result = DepthConverter::create(kitti(), options);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidParameter);
  }
}

}  // namespace
}  // namespace mtstereo::depth_test
