#pragma once
/// Passes of a frame that ice needs before the views: surroundings, then the layers (passes/ice_pass.hpp).

#include <array>
#include <functional>
#include <vector>

#include "engine/render/frame_preparation.hpp"
#include "engine/render/passes/frame_graph.hpp"
#include "engine/render/passes/ice_pass.hpp"

namespace septet::render {

/// Resources of the frame's graph, by IceImage.
using IceResources = std::array<ResourceId, ice_image_count>;

/// Parts of the frame that ice needs from outside.
struct IceFrame {
  std::vector<ResourceUse> view_reads;  ///< Reads of a view, those of ice excepted.
  ViewBindings bindings;                ///< Bindings of any view.
  std::function<void(std::uint32_t around)> draw_surroundings;
};

/// Adds the passes. Their recording functions refer to all arguments except `frame`, until the graph has been executed.
IceResources add_ice_passes(FrameGraph& graph, IcePass& pass, PassContext& context, const PreparedFrame& prepared,
                            const Instant& instant, const IceFrame& frame);

/// Ice resources that a view with ice reads.
std::vector<ResourceUse> ice_reads(const IceResources& resources, const PreparedFrame& prepared);

}  // namespace septet::render
