// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/matcher.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/buffer.hpp"
#include "base/settings.hpp"
#include "base/thread_pool.hpp"
#include "stages/census.hpp"
#include "stages/census_matching.hpp"
#include "stages/confidence.hpp"
#include "stages/cost_volume.hpp"
#include "stages/disparity_drawing.hpp"
#include "stages/gap_filling.hpp"
#include "stages/max_tree.hpp"
#include "stages/node_extrapolation.hpp"
#include "stages/node_levels.hpp"
#include "stages/node_matching.hpp"
#include "stages/outlier_removal.hpp"
#include "stages/pixel_matching.hpp"
#include "stages/preprocess.hpp"
#include "stages/rim_trimming.hpp"
#include "stages/speckle_removal.hpp"

namespace mtstereo {
namespace {

constexpr int kStages = 5;
constexpr int kMostLevels =
    static_cast<int>(std::tuple_size_v<decltype(Parameters::Levels::level)>);

/// What one level of S is matched with.
struct LevelState {
  NodeLevel left;
  NodeLevel right;
  SearchIntervals intervals;
  NodeMatches matches;
};

/// Scratch memory of one thread.
struct WorkerState {
  Image<std::uint8_t> median;
  Buffer<std::int16_t> gradient;
  Buffer<std::uint8_t> marks;
  Buffer<std::int32_t> intervals;
  CostScratch cost;
  MatchScratch match;
  Image<std::uint8_t> padded;
  CensusMatchingScratch census;
  PixelMatchingScratch pixels;
  SupportScratch support;
  RimScratch rim;
  Buffer<std::int32_t> columns;
};

int thread_count(const Parameters& parameters) {
  const int wanted = parameters.integer(Parameter::kThreads);
  return wanted > 0 ? wanted : std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
}

Status check_view(const char* name, GrayView view) {
  if (view.data != nullptr && view.width > 0 && view.height > 0 &&
      (view.stride >= view.width || view.height == 1)) {
    return {};
  }
  return Error{ErrorCode::kInvalidImage,
               std::string("the ") + name + " image cannot be read: " + std::to_string(view.width) +
                   "x" + std::to_string(view.height) + " px with a stride of " +
                   std::to_string(view.stride) + " bytes" +
                   (view.data == nullptr ? " and no data" : "") +
                   "; it needs data, at least 1x1 px and a stride of at least the width"};
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

/// An error whose text may need memory that is not there: then it goes without.
template <typename Text>
Error error_of(ErrorCode code, Text&& text) noexcept {
  try {
    return {code, text()};
  } catch (...) {
    return {code, {}};
  }
}

}  // namespace

/// All that a matcher keeps from frame to frame. The functions follow the order of the method.
/// Hidden by name, since it would be shown with the class it belongs to.
struct __attribute__((visibility("hidden"))) Matcher::State {
  explicit State(const Parameters& p) : parameters(p), settings(p) {}

  Parameters parameters;
  Settings settings;
  bool keep_stages = false;
  bool sized = false;  ///< the buffers fit width, height and settings
  int width = 0;
  int height = 0;
  std::optional<ThreadPool> pool;

  std::array<PreprocessedView, 2> views;  ///< indexed by Side, as all pairs here
  std::array<MaxTrees, 2> trees;
  std::array<LevelState, kMostLevels> levels;  ///< the first settings.node_levels.count are used
  SmoothingKernel kernel;
  CostVolume volume;
  VoteMap votes;
  LeafDisparities ends;
  std::array<CensusImage, 2> census;  ///< the right one is mirrored
  Image<std::int32_t> map;
  Image<std::uint8_t> ratio;       ///< peak ratios of the map
  Image<std::uint8_t> confidence;  ///< of the map
  SupportMap support;
  SpeckleRuns speckles;
  Image<std::uint8_t> rim_marks;
  std::array<Image<std::int32_t>, kStages> kept;
  std::vector<WorkerState> workers;
  FrameStatistics statistics;

  void take(const Parameters& p);
  void forget_frame();
  void size_buffers();
  void compute(GrayView left, GrayView right);

  void preprocess(GrayView left, GrayView right);
  void build_trees();
  void compute_costs();
  void select_levels();
  void match_level(int index);
  void remove_outliers();
  void extrapolate();
  void match_pixels(GrayView left, GrayView right);
  void remove_speckles();
  void rate_confidence();
  void trim_rims();
  void keep_node_ends();
  void fill_gaps();
  CensusMatchingOptions census_options() const;
  void keep(Stage stage);
  double density() const;

  const LevelState& leaves() const { return levels[settings.node_levels.count - 1]; }

  static constexpr int kBand = 32;     ///< [rows]
  static constexpr int kColumns = 64;  ///< of a block of columns, whose cache lines are its own

  /// Calls body(y0, y1, worker) for bands of rows. The bands are the same for every number of
  /// threads unless `per_thread`: then each thread gets one, for stages that carry work from row to
  /// row.
  template <typename Body>
  void for_rows(Body&& body, bool per_thread = false) {
    const int bands = per_thread ? std::min(pool->threads(), height) : (height + kBand - 1) / kBand;
    pool->run(bands, [&](int band, int worker) {
      const int y0 = per_thread ? static_cast<int>(1LL * height * band / bands) : band * kBand;
      const int y1 = per_thread ? static_cast<int>(1LL * height * (band + 1) / bands)
                                : std::min(y0 + kBand, height);
      body(y0, y1, workers[worker]);
    });
  }
};

void Matcher::State::take(const Parameters& p) {
  bool resize = false;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.reallocates && parameters.text(info.id) != p.text(info.id)) resize = true;
  }
  const Settings taken(p);  // may throw: before anything has changed
  parameters = p;
  settings = taken;
  if (resize) sized = false;
}

/// After a frame that failed: what is half done is not to be seen.
void Matcher::State::forget_frame() {
  sized = false;
  confidence.resize(0, 0);
  for (PreprocessedView& view : views) view.level.resize(0, 0);
}

void Matcher::State::size_buffers() {
  sized = false;
  const int threads = thread_count(parameters);
  if (!pool || pool->threads() != threads) {
    pool.reset();
    pool.emplace(threads);
  }
  workers.resize(threads);
  for (int side = 0; side < 2; ++side) {
    views[side].resize(width, height);
    trees[side].resize(width, height);
  }
  for (int i = 0; i < settings.node_levels.count; ++i) {
    levels[i].left.resize(width, height);
    levels[i].right.resize(width, height);
    levels[i].intervals.resize(levels[i].left);
    levels[i].matches.resize(levels[i].left);
  }
  kernel = smoothing_kernel(settings.cost_kernel_size, settings.cost_shift);
  volume.resize(width, height, settings.disparities, settings.cost_shift);
  votes.resize(width, height, settings.outlier_radius);
  ends.resize(leaves().left);
  map.resize(width, height);
  ratio.resize(width, height);
  confidence.resize(width, height);
  support.resize(width, height);
  speckles.resize(width, height);
  rim_marks.resize(width, height);
  if (settings.census) {
    census[0].resize(width, height, 0);
    census[1].resize(width, height, cost_lanes(settings.disparities));
  }
  for (WorkerState& worker : workers) {
    // As large as the stages ask for: which thread gets which band differs from frame to frame, and
    // none is to allocate when its first one, or a higher one, comes late.
    worker.median.resize(width, std::min(kBand + 4, height));
    worker.gradient.resize(2 * (width + 2));
    worker.marks.resize(trees[0].stride);
    worker.intervals.resize(2 * levels[0].left.stride);
    worker.cost.resize(volume, kernel);
    worker.match.resize(width, settings.disparities, settings.max_neighbors);
    worker.pixels.resize(width);
    worker.support.resize(width);
    // For any rim, which changes from frame to frame without sizing anything anew.
    worker.rim.resize(width, static_cast<int>(parameter_info(Parameter::kRimTrim).maximum));
    worker.columns.resize(kColumns);
    if (settings.census) {
      worker.padded.resize(width + 4, std::min(kBand, height) + 4);
      worker.census.resize(width, census_options());
    }
  }
  sized = true;
}

void Matcher::State::compute(GrayView left, GrayView right) {
  const auto start = std::chrono::steady_clock::now();
  preprocess(left, right);
  build_trees();
  compute_costs();
  select_levels();
  for (int i = 0; i < settings.node_levels.count; ++i) match_level(i);
  for_rows([&](int y0, int y1, WorkerState&) {
    draw_matches(leaves().left, leaves().matches, y0, y1, map);
  });
  keep(Stage::kNodeMatching);
  remove_outliers();
  keep(Stage::kNodesFiltered);
  extrapolate();
  keep(Stage::kExtrapolated);
  match_pixels(left, right);
  keep(Stage::kPixelMatching);
  if (settings.pixel_outliers) remove_outliers();
  remove_speckles();
  rate_confidence();
  trim_rims();
  if (settings.mode == Mode::kSparse && settings.census) keep_node_ends();
  fill_gaps();
  keep(Stage::kFinal);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  statistics = {took.count(), density()};
}

void Matcher::State::preprocess(GrayView left, GrayView right) {
  const LevelTable table = level_table(settings.gray_levels);
  const std::array<GrayView, 2> images = {left, right};
  for (int side = 0; side < 2; ++side) {
    for_rows([&](int y0, int y1, WorkerState& worker) {
      median_rows(images[side], y0, y1, worker.median, views[side].median);
    });
    for_rows([&](int y0, int y1, WorkerState& worker) {
      const GrayView costs_from =
          settings.median_in_costs ? views[side].median.view() : images[side];
      gradient_rows(table, costs_from, y0, y1, worker.gradient, views[side]);
    });
  }
}

void Matcher::State::build_trees() {
  for (int side = 0; side < 2; ++side) {
    for_rows([&](int y0, int y1, WorkerState&) {
      build_max_trees(views[side].level, y0, y1, trees[side]);
    });
  }
}

void Matcher::State::compute_costs() {
  const int block = slices_per_block(volume, kernel);
  const int blocks = (volume.disparities + block - 1) / block;
  pool->run(blocks, [&](int i, int worker) {
    const int d0 = i * block;
    const int d1 = std::min(d0 + block, volume.disparities);
    compute_cost_slices(views[0], views[1], kernel, d0, d1, workers[worker].cost, volume);
  });
}

void Matcher::State::select_levels() {
  const WidthRange widths = {1.0 * settings.min_node_width, settings.max_node_width * width};
  for (int i = 0; i < settings.node_levels.count; ++i) {
    const int ancestor = settings.node_levels.level[i];
    for (int side = 0; side < 2; ++side) {
      NodeLevel& level = side == 0 ? levels[i].left : levels[i].right;
      for_rows([&](int y0, int y1, WorkerState& worker) {
        select_nodes(trees[side], ancestor, widths, y0, y1, worker.marks, level);
      });
      for_rows([&](int y0, int y1, WorkerState&) { link_neighbors(y0, y1, level); });
    }
  }
}

void Matcher::State::match_level(int index) {
  LevelState& level = levels[index];
  for_rows([&](int y0, int y1, WorkerState& worker) {
    if (index == 0) {
      first_intervals(level.left, settings.disparities, y0, y1, level.intervals);
    } else {
      finer_intervals(level.left, levels[index - 1].left, levels[index - 1].matches,
                      settings.max_neighbors, y0, y1, worker.intervals, level.intervals);
    }
  });
  const PairCostInput input = {trees[0],    trees[1], level.left,
                               level.right, volume,   settings.intensity_weight};
  constexpr bool kPerThread = true;
  for_rows(
      [&](int y0, int y1, WorkerState& worker) {
        match_nodes(input, level.intervals, settings.max_neighbors, settings.node_confidence, y0,
                    y1, worker.match, level.matches);
      },
      kPerThread);
}

void Matcher::State::remove_outliers() {
  if (settings.outlier_radius == 0) return;
  for_rows([&](int y0, int y1, WorkerState&) { copy_votes(map, y0, y1, votes); });
  sum_votes(votes);
  for_rows([&](int y0, int y1, WorkerState&) { mtstereo::remove_outliers(votes, y0, y1, map); });
}

void Matcher::State::extrapolate() {
  const NodeLevel& level = leaves().left;
  // The census costs are only guided by the nodes: there whole nodes help in every mode.
  const bool whole = settings.census || settings.mode != Mode::kSparse;
  const int end_width = whole ? 0 : settings.node_end_width;
  for_rows([&](int y0, int y1, WorkerState&) { read_leaf_ends(level, map, y0, y1, ends); });
  for_rows([&](int y0, int y1, WorkerState&) {
    extrapolate_leaves(level, ends, settings.max_neighbors, end_width, y0, y1, map);
  });
}

CensusMatchingOptions Matcher::State::census_options() const {
  return {settings.search_range, settings.census_cost, settings.smoothness, settings.selection};
}

void Matcher::State::match_pixels(GrayView left, GrayView right) {
  if (!settings.census) {
    const PixelMatchingOptions options = {settings.search_range, settings.selection};
    for_rows([&](int y0, int y1, WorkerState& worker) {
      mtstereo::match_pixels(volume, options, y0, y1, worker.pixels, map, ratio);
    });
    return;
  }
  for_rows([&](int y0, int y1, WorkerState& worker) {
    census_rows(left, CensusOrder::kForward, y0, y1, worker.padded, census[0]);
    census_rows(right, CensusOrder::kMirrored, y0, y1, worker.padded, census[1]);
  });
  const CensusMatchingOptions options = census_options();
  constexpr bool kPerThread = true;
  for_rows(
      [&](int y0, int y1, WorkerState& worker) {
        match_pixels_by_census(left, census[0], census[1], options, y0, y1, worker.census, map,
                               ratio);
      },
      kPerThread);
}

void Matcher::State::remove_speckles() {
  if (settings.speckle_size <= 1) return;
  for_rows([&](int y0, int y1, WorkerState&) { find_runs(map, kDisparityOne, y0, y1, speckles); });
  join_bands(map, kDisparityOne, kBand, speckles);
  for_rows([&](int y0, int y1, WorkerState&) {
    remove_small(speckles, settings.speckle_size, y0, y1, map);
  });
}

void Matcher::State::rate_confidence() {
  for_rows([&](int y0, int y1, WorkerState&) { copy_support(map, ratio, y0, y1, support); });
  for_rows([&](int y0, int y1, WorkerState& worker) {
    rate_support(support, y0, y1, worker.support, confidence);
    if (settings.min_confidence > 0) {
      remove_doubtful(settings.min_confidence, y0, y1, map, confidence);
    }
  });
}

void Matcher::State::trim_rims() {
  if (settings.rim_trim == 0) return;
  for_rows([&](int y0, int y1, WorkerState& worker) {
    mark_rim(map, settings.rim_trim, y0, y1, worker.rim, rim_marks);
  });
  for_rows([&](int y0, int y1, WorkerState& worker) {
    trim_rim(rim_marks, settings.rim_trim, y0, y1, worker.rim, map);
    clear_confidence(map, y0, y1, confidence);
  });
}

void Matcher::State::keep_node_ends() {
  for_rows([&](int y0, int y1, WorkerState& worker) {
    keep_leaf_ends(leaves().left, ends, settings.max_neighbors, settings.node_end_width, y0, y1,
                   worker.marks, map, confidence);
  });
}

void Matcher::State::fill_gaps() {
  if (settings.max_gap == 0) return;
  for_rows([&](int y0, int y1, WorkerState&) {
    fill_gaps_along_rows(settings.max_gap, kDisparityOne, y0, y1, map, confidence);
  });
  pool->run((width + kColumns - 1) / kColumns, [&](int block, int worker) {
    const int x0 = block * kColumns;
    fill_gaps_along_columns(settings.max_gap, kDisparityOne, x0, std::min(x0 + kColumns, width),
                            workers[worker].columns, map, confidence);
  });
}

void Matcher::State::keep(Stage stage) {
  Image<std::int32_t>& copy = kept[static_cast<int>(stage)];
  if (!keep_stages) {
    copy.resize(0, 0);  // what is there belongs to an earlier frame
    return;
  }
  copy.resize(width, height);
  for (int y = 0; y < height; ++y) {
    std::memcpy(copy.row(y), map.row(y), width * sizeof(std::int32_t));
  }
}

double Matcher::State::density() const {
  std::size_t known = 0;
  for (int y = 0; y < height; ++y) {
    known += width - std::count(map.row(y), map.row(y) + width, kNoDisparity);
  }
  return static_cast<double>(known) / (static_cast<double>(width) * height);
}

Matcher::Matcher(std::unique_ptr<State> state) : state_(std::move(state)) {}
Matcher::Matcher(Matcher&&) noexcept = default;
Matcher& Matcher::operator=(Matcher&&) noexcept = default;
Matcher::~Matcher() = default;

Result<Matcher> Matcher::create(const Parameters& parameters) {
  try {
    return Matcher(std::make_unique<State>(parameters));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "there is no memory left for a matcher"};
  }
}

Status Matcher::set_parameters(const Parameters& parameters) {
  try {
    state_->take(parameters);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "there is no memory left for other parameters"};
  }
  return {};
}

const Parameters& Matcher::parameters() const { return state_->parameters; }

void Matcher::keep_stages(bool keep) { state_->keep_stages = keep; }

Result<DisparityView> Matcher::compute(GrayView left, GrayView right) {
  State& state = *state_;
  if (Status status = check_view("left", left); !status) return status.error();
  if (Status status = check_view("right", right); !status) return status.error();
  if (left.width != right.width || left.height != right.height) {
    return Error{ErrorCode::kSizeMismatch,
                 "the left image has " + size_text(left.width, left.height) + ", the right one " +
                     size_text(right.width, right.height) +
                     ": both views of a rectified pair have the same size"};
  }
  if (Status status = state.parameters.check_frame(left.width, left.height); !status) {
    return status.error();
  }
  try {
    if (!state.sized || state.width != left.width || state.height != left.height) {
      state.width = left.width;
      state.height = left.height;
      state.size_buffers();
    }
    state.compute(left, right);
  } catch (const std::bad_alloc&) {
    state.forget_frame();
    return error_of(ErrorCode::kOutOfMemory, [&] {
      return "there is not enough memory for images of " + size_text(left.width, left.height) +
             " with max-disparity = " + std::to_string(state.settings.disparities) +
             ": lower max-disparity or threads, or set cost-volume = half";
    });
  } catch (const std::exception& exception) {
    state.forget_frame();
    return error_of(ErrorCode::kSystem, [&] {
      return std::string("the frame could not be matched: ") + exception.what();
    });
  }
  return state.map.view();
}

DisparityView Matcher::stage(Stage stage) const {
  return state_->kept[static_cast<int>(stage)].view();
}

GrayView Matcher::preprocessed(Side side) const {
  return state_->views[static_cast<int>(side)].level.view();
}

GrayView Matcher::confidence() const { return state_->confidence.view(); }

double Matcher::cost(int x, int y, int d) const {
  const State& state = *state_;
  if (!state.sized || x < 0 || x >= state.width || y < 0 || y >= state.height || d < 0 || d > x ||
      d >= state.volume.disparities) {
    return 0;
  }
  return static_cast<double>(state.volume.at(x, y, d)) / kCostScale;
}

FrameStatistics Matcher::statistics() const { return state_->statistics; }

Status write_disparity16(DisparityView disparity, int scale, ImageView<std::uint16_t> out) {
  if (out.width != disparity.width || out.height != disparity.height) {
    return Error{ErrorCode::kSizeMismatch,
                 "the disparity has " + size_text(disparity.width, disparity.height) +
                     ", the image it is to be written to " + size_text(out.width, out.height)};
  }
  if (scale < 1 || scale > 65535) {
    return Error{ErrorCode::kInvalidParameter, "disparity-scale = " + std::to_string(scale) +
                                                   " is not possible: it takes 1 to 65535"};
  }
  if (disparity.data == nullptr || out.data == nullptr ||
      disparity.stride < static_cast<std::ptrdiff_t>(disparity.width * sizeof(std::int32_t)) ||
      out.stride < static_cast<std::ptrdiff_t>(out.width * sizeof(std::uint16_t))) {
    return Error{ErrorCode::kInvalidImage,
                 "the disparity or the image it is to be written to has no data or a stride that "
                 "is shorter than a row"};
  }
  for (int y = 0; y < out.height; ++y) {
    const std::int32_t* in = disparity.row(y);
    std::uint16_t* row = out.row(y);
    for (int x = 0; x < out.width; ++x) {
      const std::int64_t value =
          (static_cast<std::int64_t>(in[x]) * scale + kDisparityOne / 2) / kDisparityOne;
      row[x] = in[x] == kNoDisparity
                   ? std::uint16_t{0}
                   : static_cast<std::uint16_t>(std::clamp<std::int64_t>(value, 1, 65535));
    }
  }
  return {};
}

const char* version() { return MTSTEREO_VERSION; }

}  // namespace mtstereo
