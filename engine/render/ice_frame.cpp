#include "engine/render/ice_frame.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace septet::render {
namespace {

void add_surroundings(RenderGraph& graph, IcePass& pass, PassContext& context, const IceResources& resources,
                      const IceFrame& frame) {
  const auto resource = [&](IceImage which) { return resources[std::size_t(which)]; };
  graph.add_pass("surroundings",
                 {frame.view_reads,
                  {{resource(IceImage::around), Access::color_attachment},
                   {resource(IceImage::around_depth), Access::depth_attachment}}},
                 frame.draw_surroundings);
  graph.add_pass("surroundings cube",
                 {{{resource(IceImage::around), Access::transfer_source}},
                  {{resource(IceImage::cube), Access::transfer_destination}}},
                 [&pass, &context] { copy_surroundings(pass, context); });
}

}  // namespace

IceResources add_ice_passes(RenderGraph& graph, IcePass& pass, PassContext& context, const PreparedFrame& prepared,
                            const Instant& instant, const IceFrame& frame) {
  constexpr std::array<const char*, ice_image_count> names{
      "ice front", "ice back",     "ice beyond",         "ice beyond back",  "ice inside",
      "ice depth", "surroundings", "surroundings depth", "surroundings cube"};
  IceResources resources{};
  for (std::size_t i = 0; i < ice_image_count; ++i)
    resources[i] = frame.add_image(names[i], pass.targets.images[i], pass.targets.accesses[i]);
  const auto resource = [&](IceImage which) { return resources[std::size_t(which)]; };
  const bool kept = instant.ice_surroundings_kept && pass.targets.accesses[std::size_t(IceImage::cube)] != Access::none;
  if (!kept) add_surroundings(graph, pass, context, resources, frame);
  std::vector<ResourceUse> reads = frame.view_reads;
  const auto add_layer = [&](const char* name, IceImage layer) {
    std::vector<ResourceUse> writes{{resource(layer), Access::color_attachment}};
    if (layer != IceImage::inside) writes.push_back({resource(IceImage::depth), Access::depth_attachment});
    graph.add_pass(name, {reads, writes}, [&pass, &context, &prepared, &instant, layer, bindings = frame.bindings] {
      draw_ice_layer(pass, context, layer, prepared.ice, instant.ice, prepared.ice_upload, bindings);
    });
    reads.push_back({resource(layer), Access::sampled});
  };
  add_layer("ice front faces", IceImage::front);
  add_layer("ice back faces", IceImage::back);
  if (prepared.ice.beyond) {
    add_layer("ice front faces beyond", IceImage::beyond);
    add_layer("ice back faces beyond", IceImage::beyond_back);
  }
  reads.push_back({resource(IceImage::cube), Access::sampled});
  add_layer("ice inside", IceImage::inside);
  return resources;
}

std::vector<ResourceUse> ice_reads(const IceResources& resources, bool beyond) {
  std::vector<ResourceUse> reads;
  for (const IceImage seen :
       {IceImage::front, IceImage::back, IceImage::inside, IceImage::cube, IceImage::beyond, IceImage::beyond_back})
    if (beyond || (seen != IceImage::beyond && seen != IceImage::beyond_back))
      reads.push_back({resources[std::size_t(seen)], Access::sampled});
  return reads;
}

}  // namespace septet::render
