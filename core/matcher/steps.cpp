// SPDX-License-Identifier: LGPL-2.1-or-later
// The whole method, in order. A row has the name of a step, the settings with which it runs, and
// its function, whose arguments are the groups of the memory that it reads (const) and writes. To
// add a step, add a stage with its test to stages/, a function that calls it to one of the files
// that are included here, and a row.
#include "matcher/steps.hpp"

#include "matcher/frame_memory.hpp"

namespace mtstereo {
namespace {

template <auto kFunction, typename... Groups>
void call(void (*)(const StepContext&, Groups&...), const StepContext& context,
          FrameMemory& memory) {
  kFunction(context, memory.group<Groups>()...);
}

/// A step's function, called with the groups of the memory that it takes.
template <auto kFunction>
void on(const StepContext& context, FrameMemory& memory) {
  call<kFunction>(kFunction, context, memory);
}

using S = const Settings&;

constexpr bool always(S) { return true; }

// clang-format off

/// Prepares the views.
constexpr Step kViewList[] = {
    {"time-filter",        [](S s) { return s.filters(); },          on<filter_in_time>},
    {"row-alignment",      [](S s) { return s.aligned(); },          on<align>},
    {"view-shift",         [](S s) { return s.shifted(); },          on<shift_views>},
    {"sharpness",          [](S s) { return s.blurred(); },          on<match_sharpness>},
    {"halving",            [](S s) { return s.half(); },             on<halve>},
    {"block-borders",      [](S s) { return s.by_paths(); },         on<measure_block_borders>},
    {"contrast",           [](S s) { return s.by_paths(); },         on<measure_contrast>},
    {"noise-filter",       [](S s) { return s.noise_filter; },       on<filter_views>},
};

/// Matches all pixels along paths, coarse to fine.
constexpr Step kPathList[] = {
    {"reduced-matching",   always,                                   on<match_reduced>},
    {"search-windows",     always,                                   on<choose_search_windows>},
    {"gray-balance",       always,                                   on<balance_grays>},
    {"census",             always,                                   on<transform>},
    {"path-matching",      always,                                   on<match_by_paths>},
    {"guide-support",      always,                                   on<support_guide>},
    {"guide-rating",       always,                                   on<rate_guide>},
    {"thin-search",        [](S s) { return s.thin_objects; },       on<find_thin_structures>},
    {"speckle-removal",    [](S s) { return s.removes_speckles(); }, on<remove_speckles>},
    {"confidence",         always,                                   on<rate_confidence>},
    {"smoothing",          [](S s) { return s.smoothing_radius > 0; }, on<smooth>},
};

/// Matches nodes of the Max-trees, then the pixels that they guide.
constexpr Step kNodeList[] = {
    {"preprocessing",      always,                                   on<preprocess>},
    {"max-trees",          always,                                   on<build_trees>},
    {"cost-volume",        always,                                   on<compute_cost_volume>},
    {"node-matching",      always,                                   on<match_levels>},
    {"node-drawing",       [](S s) { return s.outlier_radius > 0; }, on<draw_leaves>},
    {"node-outliers",      [](S s) { return s.outlier_radius > 0; }, on<remove_node_outliers>},
    {"node-extrapolation", always,                                   on<extrapolate>},
    {"gradient-matching",  always,                                   on<match_by_gradient>},
    {"pixel-outliers",     [](S s) { return s.removes_pixel_outliers(); }, on<remove_pixel_outliers>},
    {"speckle-removal",    [](S s) { return s.removes_speckles(); }, on<remove_speckles>},
    {"confidence",         always,                                   on<rate_confidence>},
    {"smoothing",          [](S s) { return s.smoothing_radius > 0; }, on<smooth>},
};

/// Completes the map of the paths, rates it, and rejects what is not reliable.
constexpr Step kResultList[] = {
    {"fine-detail",        [](S s) { return s.rates_detail(); },     on<measure_fine_detail>},
    {"block-grid",         always,                                   on<measure_block_grid>},
    {"completion",         always,                                   on<complete_map>},
    {"edge-check",         [](S s) { return !s.infers(); },          on<doubt_map_edges>},
    {"edge-alignment",     [](S s) { return s.infers(); },           on<align_map_edges>},
    {"reliability",        always,                                   on<calibrate_confidence>},
    {"left-strip",         [](S s) { return s.mode == Mode::kFull; }, on<correct_strip>},
    {"flat-planes",        [](S s) { return s.infers() || s.checks_planes(); }, on<fit_flat_areas>},
    {"plane-check",        [](S s) { return s.checks_planes(); },    on<check_flat_areas>},
    {"plane-completion",   [](S s) { return s.mode == Mode::kFull; }, on<complete_flat_areas>},
    {"plane-edges",        [](S s) { return s.mode == Mode::kFull && !s.half(); }, on<align_plane_edges>},
    {"camera-motion",      [](S s) { return s.follows(); },          on<find_camera_motion>},
    {"holding",            [](S s) { return s.holds(); },            on<hold_known>},
    {"rejection",          [](S s) { return s.rejects_unlikely(); }, on<reject_unlikely>},
    {"gap-closing",        [](S s) { return s.rejects_unlikely() && s.max_gap > 0; }, on<close_gaps>},
    {"thin-drawing",       [](S s) { return s.thin_objects; },       on<draw_thin_structures>},
    {"pair-keeping",       [](S s) { return s.follows(); },          on<keep_pair>},
};

/// Gives the map the size of the caller's views.
constexpr Step kSizeList[] = {
    {"input-census",       [](S s) { return s.refined(); },          on<transform_input>},
    {"refinement",         [](S s) { return s.refined(); },          on<refine>},
    {"enlarging",          [](S s) { return s.half(); },             on<enlarge>},
    {"enlarged-edges",     [](S s) { return s.keeps_all() && s.half(); }, on<align_enlarged_edges>},
    {"map-shift",          [](S s) { return s.shifted(); },          on<shift_result>},
};
// clang-format on

}  // namespace

constinit const StepList kViewSteps = kViewList;
constinit const StepList kPathSteps = kPathList;
constinit const StepList kNodeSteps = kNodeList;
constinit const StepList kResultSteps = kResultList;
constinit const StepList kSizeSteps = kSizeList;

}  // namespace mtstereo
