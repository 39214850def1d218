// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/degradation.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/h264.hpp"

namespace mtstereo::eval {
namespace {

/// The amounts of a kind.
struct Amounts {
  double least = 0;
  double most = 0;
  bool whole = false;  // only whole numbers
};

/// The name of a kind and its amounts; none if it has no amount.
struct KindInfo {
  DegradationKind kind;
  std::string_view name;
  std::optional<Amounts> amounts = std::nullopt;
};

constexpr Amounts kQualities{1, 100, true};
constexpr Amounts kQuantizers{1, 50, true};
constexpr Amounts kSigmas{0, 10};

constexpr std::array kKinds = {
    KindInfo{DegradationKind::kNoise, "noise", Amounts{0, 100}},
    KindInfo{DegradationKind::kJpeg, "jpeg", kQualities},
    KindInfo{DegradationKind::kH264, "h264", kQuantizers},
    KindInfo{DegradationKind::kDark, "dark", Amounts{0, 1}},
    KindInfo{DegradationKind::kBright, "bright", Amounts{1, 16}},
    KindInfo{DegradationKind::kBlur, "blur", kSigmas},
    KindInfo{DegradationKind::kRim, "rim"},
    KindInfo{DegradationKind::kSoft2x, "soft2x"},
    KindInfo{DegradationKind::kSoft1_5x, "soft1.5x"},
    KindInfo{DegradationKind::kCam, "cam"},
    KindInfo{DegradationKind::kCam2x, "cam2x"},
    KindInfo{DegradationKind::kCam1_5x, "cam1.5x"},
    KindInfo{DegradationKind::kRimCam, "rimcam"},
    KindInfo{DegradationKind::kCamH264, "camh264", kQuantizers},
    KindInfo{DegradationKind::kBlurRight, "blur-right", kSigmas},
    KindInfo{DegradationKind::kLowerRight, "lower-right", Amounts{-100, 100}},
    KindInfo{DegradationKind::kRollRight, "roll-right", Amounts{-45, 45}},
    KindInfo{DegradationKind::kGainRight, "gain-right", Amounts{0, 16}},
    KindInfo{DegradationKind::kGammaRight, "gamma-right", Amounts{0.1, 10}},
};

const KindInfo& info_of(DegradationKind kind) {
  for (const KindInfo& info : kKinds) {
    if (info.kind == kind) return info;
  }
  throw UserError("unknown kind of degradation");
}

std::string kind_list() {
  std::string list;
  for (const KindInfo& info : kKinds) {
    if (!list.empty()) list += ", ";
    list += info.name;
  }
  return list;
}

std::string number_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// What the user writes for this kind: its name, with the range of the amount if there is one.
std::string usage_of(const KindInfo& info) {
  const std::string name(info.name);
  if (!info.amounts) return name;
  return name + "=" + number_text(info.amounts->least) + " .. " + number_text(info.amounts->most);
}

double parse_amount(const KindInfo& info, std::string_view degradation, std::string_view text) {
  const std::string which = "degradation '" + std::string(degradation) + "'";
  const Amounts& amounts = *info.amounts;
  double amount = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, amount);
  if (error != std::errc() || stop != end || !(amount >= amounts.least && amount <= amounts.most)) {
    throw UserError(which + " is out of range; use " + usage_of(info));
  }
  if (amounts.whole && amount != std::floor(amount)) {
    throw UserError(which + " needs a whole number; use " + usage_of(info));
  }
  return amount;
}

}  // namespace

std::string degradation_kinds() {
  std::string list;
  for (const KindInfo& info : kKinds) {
    if (!list.empty()) list += ", ";
    list += usage_of(info);
  }
  return list;
}

Degradation parse_degradation(std::string_view text) {
  const std::size_t equals = text.find('=');
  const bool has_amount = equals != std::string_view::npos;
  for (const KindInfo& info : kKinds) {
    if (info.name != text.substr(0, equals)) continue;
    if (info.amounts && has_amount) {
      return {info.kind, parse_amount(info, text, text.substr(equals + 1))};
    }
    if (!info.amounts && !has_amount) return {info.kind, 0};
    throw UserError("degradation '" + std::string(text) +
                    (has_amount ? "' takes no amount; use " : "' has no amount; use ") +
                    usage_of(info));
  }
  throw UserError("unknown degradation '" + std::string(text) + "'; the kinds are " + kind_list());
}

std::string degradation_text(const Degradation& degradation) {
  const KindInfo& info = info_of(degradation.kind);
  const std::string name(info.name);
  return info.amounts ? name + "=" + number_text(degradation.amount) : name;
}

std::optional<std::string> degradation_obstacle(const Degradation& degradation) {
  const bool needs_h264 =
      degradation.kind == DegradationKind::kH264 || degradation.kind == DegradationKind::kCamH264;
  return needs_h264 ? h264_obstacle() : std::nullopt;
}

}  // namespace mtstereo::eval
