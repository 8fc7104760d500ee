#include "engine/render/ice_frame.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace septet::render {
namespace {

void add_surroundings(FrameGraph& graph, IcePass& pass, PassContext& context, const IceResources& resources,
                      std::uint32_t around, const IceFrame& frame) {
  const auto resource = [&](IceImage which) { return resources[std::size_t(which)]; };
  graph.add_pass("surroundings",
                 {frame.view_reads,
                  {{resource(IceImage::around), Access::color_attachment},
                   {resource(IceImage::around_depth), Access::depth_attachment}}},
                 [draw = frame.draw_surroundings, around] { draw(around); });
  graph.add_pass("surroundings cube",
                 {{{resource(IceImage::around), Access::transfer_source}},
                  {{resource(cube_of(around)), Access::transfer_destination}}},
                 [&pass, &context, around] { copy_surroundings(pass, context, cube_of(around)); });
}

}  // namespace

IceResources add_ice_passes(FrameGraph& graph, IcePass& pass, PassContext& context, const PreparedFrame& prepared,
                            const Instant& instant, const IceFrame& frame) {
  constexpr std::array<const char*, ice_image_count> names{
      "ice front", "ice back",     "ice beyond",         "ice beyond back",   "ice inside",
      "ice depth", "surroundings", "surroundings depth", "surroundings cube", "second cube"};
  IceResources resources{};
  for (std::size_t i = 0; i < ice_image_count; ++i)
    resources[i] = graph.add_image(names[i], pass.targets.images[i], pass.targets.accesses[i]);
  const auto resource = [&](IceImage which) { return resources[std::size_t(which)]; };
  const std::uint32_t surroundings = prepared.surroundings();
  for (std::uint32_t around = 0; around < surroundings; ++around)
    if (!instant.ice_surroundings_kept || pass.targets.accesses[std::size_t(cube_of(around))] == Access::none)
      add_surroundings(graph, pass, context, resources, around, frame);
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
  for (std::uint32_t around = 0; around < surroundings; ++around)
    reads.push_back({resource(cube_of(around)), Access::sampled});
  add_layer("ice inside", IceImage::inside);
  return resources;
}

std::vector<ResourceUse> ice_reads(const IceResources& resources, const PreparedFrame& prepared) {
  std::vector<IceImage> seen{IceImage::front, IceImage::back, IceImage::inside};
  if (prepared.ice.beyond) seen.insert(seen.end(), {IceImage::beyond, IceImage::beyond_back});
  for (std::uint32_t around = 0; around < prepared.surroundings(); ++around) seen.push_back(cube_of(around));
  std::vector<ResourceUse> reads;
  reads.reserve(seen.size());
  for (const IceImage image : seen) reads.push_back({resources[std::size_t(image)], Access::sampled});
  return reads;
}

}  // namespace septet::render
