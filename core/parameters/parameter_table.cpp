// SPDX-License-Identifier: LGPL-2.1-or-later
// The parameter table, from the rows of parameters.def.
#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>
#include <tuple>

#include "base/limits.hpp"
#include "mtstereo/parameters.hpp"
#include "parameters/choices.hpp"

namespace mtstereo {
namespace {

using T = ParameterType;

/// The words of a choice with '|' between them.
template <typename Enum>
struct Joined {
  static constexpr auto kText = [] {
    constexpr auto& kWords = ChoiceOf<Enum>::kWords;
    constexpr std::size_t kSize =
        std::accumulate(kWords.begin(), kWords.end(), kWords.size(),
                        [](std::size_t size, std::string_view word) { return size + word.size(); });
    std::array<char, kSize> text{};
    auto end = text.begin();
    for (const std::string_view word : kWords) {
      end = std::copy(word.begin(), word.end(), end);
      *end++ = '|';
    }
    text.back() = '\0';
    return text;
  }();
};

// clang-format off
// Type, smallest and largest value, and words of a choice.
#define CHOICE(choice) \
  T::kChoice, 0, ChoiceOf<choice>::kWords.size() - 1.0, Joined<choice>::kText.data()
// The defaults of a row: of the presets default, fast and paper, each in the modes sparse,
// semi-dense, dense and full.
#define MODES(sparse, semi_dense, dense, full) {{sparse, semi_dense, dense, full}}
#define BY_MODE(standard, fast, paper) {{standard, fast, paper}}
// One default for each preset.
#define EACH(standard, fast, paper) \
  BY_MODE(MODES(standard, standard, standard, standard), MODES(fast, fast, fast, fast), \
          MODES(paper, paper, paper, paper))
// One default for every preset and mode.
#define ALL(value) EACH(value, value, value)
// clang-format on

constexpr ParameterInfo kTable[] = {
#define MTSTEREO_PARAMETER(id, ...) {Parameter::id, __VA_ARGS__},
#include "mtstereo/parameters.def"
#undef MTSTEREO_PARAMETER
};
#undef ALL
#undef EACH
#undef BY_MODE
#undef MODES
#undef CHOICE

/// Whether the row of the enum's parameter has its words.
template <typename Enum>
constexpr bool is_bound() {
  return kTable[static_cast<int>(ChoiceOf<Enum>::kParameter)].choices == Joined<Enum>::kText.data();
}

template <typename... Enums>
constexpr bool are_bound(std::tuple<Enums...>*) {
  const auto rows = std::count_if(std::begin(kTable), std::end(kTable),
                                  [](const auto& row) { return row.type == T::kChoice; });
  return rows == sizeof...(Enums) && (is_bound<Enums>() && ...);
}
static_assert(are_bound(static_cast<Choices*>(nullptr)));

}  // namespace

std::span<const ParameterInfo> parameter_table() noexcept { return kTable; }

const ParameterInfo& parameter_info(Parameter id) noexcept { return kTable[static_cast<int>(id)]; }

const char* parameter_default(Parameter id, Preset preset, Mode mode) noexcept {
  return parameter_info(id).defaults[static_cast<int>(preset)][static_cast<int>(mode)];
}

const ParameterInfo* find_parameter(std::string_view name) noexcept {
  const auto* found = std::find_if(std::begin(kTable), std::end(kTable),
                                   [&](const ParameterInfo& info) { return info.name == name; });
  return found == std::end(kTable) ? nullptr : found;
}

}  // namespace mtstereo
