// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/sink_pads.hpp"

#include "shared/exception_guard.hpp"

namespace mtstereo::plugin {
namespace {

Arrival arrive(ElementState& state, GstPad* pad, GstBuffer* buffer) noexcept {
  try {
    const Side side = state.pairing.side_of(GST_AGGREGATOR_PAD(pad));
    const bool newest = state.flow_settings().newest_pair && state.clock.is_live();
    return state.pairing.arrive(side, buffer, newest);
  } catch (...) {
    post_exception(state.element);
  }
  return Arrival::kTaken;
}

GstFlowReturn chain(GstPad* pad, GstObject* parent, GstBuffer* buffer) noexcept {
  ElementState& state = state_of(parent);
  switch (arrive(state, pad, buffer)) {
    case Arrival::kTaken:
      return state.base_chain(pad, parent, buffer);
    case Arrival::kDropped:
      gst_buffer_unref(buffer);
      return GST_FLOW_OK;
    case Arrival::kRefused:
      break;
  }
  gst_buffer_unref(buffer);
  return state.messages.failed() ? GST_FLOW_ERROR : GST_FLOW_EOS;
}

}  // namespace

void add_sink_pads(ElementState& state) {
  auto* element = GST_ELEMENT_CAST(state.element);
  for (const Side side : kSides) {
    GstPadTemplate* pad_template =
        gst_element_class_get_pad_template(GST_ELEMENT_GET_CLASS(element), pad_name(side));
    auto* pad = static_cast<GstPad*>(g_object_new(GST_TYPE_AGGREGATOR_PAD, "name", pad_name(side),
                                                  "direction", GST_PAD_SINK, "template",
                                                  pad_template, nullptr));
    state.pairing.set_pad(side, GST_AGGREGATOR_PAD(pad));
    state.base_chain = GST_PAD_CHAINFUNC(pad);
    gst_pad_set_chain_function(pad, chain);
    gst_element_add_pad(element, pad);
  }
}

}  // namespace mtstereo::plugin
