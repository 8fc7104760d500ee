#pragma once
/// The passes of a frame that ice needs before the views: surroundings, then the layers (passes/ice_pass.hpp).

#include <array>
#include <functional>
#include <vector>

#include "engine/render/frame_preparation.hpp"
#include "engine/render/passes/frame_graph.hpp"
#include "engine/render/passes/ice_pass.hpp"

namespace septet::render {

/// Resources of the frame's graph, by IceImage.
using IceResources = std::array<ResourceId, ice_image_count>;

/// What the frame knows and ice does not.
struct IceFrame {
  std::vector<ResourceUse> view_reads;  ///< What a view reads but for ice.
  ViewBindings bindings;                ///< Of any view.
  std::function<void(std::uint32_t around)> draw_surroundings;
};

/// Adds the passes; what they record refers to all but `frame`, until the graph has been executed.
IceResources add_ice_passes(FrameGraph& graph, IcePass& pass, PassContext& context, const PreparedFrame& prepared,
                            const Instant& instant, const IceFrame& frame);

/// What a view that has ice reads of it.
std::vector<ResourceUse> ice_reads(const IceResources& resources, const PreparedFrame& prepared);

}  // namespace septet::render
