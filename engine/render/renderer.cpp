#include "engine/render/renderer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "engine/core/check.hpp"
#include "engine/render/frame_order.hpp"
#include "engine/render/renderer_state.hpp"

namespace septet::render {
namespace {

Expected<void> check_size(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t largest = 16384;
  if (width > 0 && height > 0 && width <= largest && height <= largest) return {};
  return failure(fmt::format("the picture is {} × {} pixels", width, height), "screen size",
                 fmt::format("give a width and height from 1 to {} pixels", largest));
}

}  // namespace

Renderer::Renderer(std::unique_ptr<RendererState> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Expected<Renderer> Renderer::create(const RendererOptions& options) {
  if (auto possible = check_size(options.width, options.height); !possible) return tl::unexpected(possible.error());
  auto state = std::make_unique<RendererState>();
  try {
    create_state(*state, options);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return Renderer(std::move(state));
}

Expected<void> Renderer::upload(const scene::ResolvedScene& scene) {
  if (state_->scene.revision == scene.revision) return {};
  try {
    const auto wait = [&] { wait_for_frames(state_->ring, state_->device); };
    const auto changes = state_->scene.revision ? scene.changes.since(*state_->scene.revision) : std::nullopt;
    if (changes) {
      renew_scene(state_->scene, scene, *changes, state_->device, state_->memory, wait);
      return {};
    }
    wait();
    upload_scene(state_->scene, scene, state_->device, state_->memory);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return {};
}

Expected<void> Renderer::resize(std::uint32_t width, std::uint32_t height) {
  if (auto possible = check_size(width, height); !possible) return possible;
  if (width == state_->targets.width && height == state_->targets.height) return {};
  try {
    resize_targets(*state_, width, height);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return {};
}

Expected<void> Renderer::draw(const Instant& instant, const std::vector<OverlayText>& passing) {
  for (const MirrorGlass& mirror : instant.mirrors)
    SEPTET_CHECK(mirror.picture.viewport.x >= 0 && mirror.picture.viewport.y >= 0, "a mirror's picture at ({}, {})",
                 mirror.picture.viewport.x, mirror.picture.viewport.y);
  for (const FrameView& view : instant.views) {
    const auto& [x, y, w, h] = view.viewport;
    SEPTET_CHECK(
        x >= 0 && y >= 0 && w > 0 && h > 0 && x + std::int64_t{w} <= width() && y + std::int64_t{h} <= height(),
        "a view of {} × {} pixels at ({}, {}) in a picture of {} × {}", w, h, x, y, width(), height());
  }
  try {
    draw_frame(*state_, instant, passing);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return {};
}

Expected<void> Renderer::draw(FrameInput input, const std::vector<OverlayText>& passing) {
  if (state_->lit_environment != input.environment) {
    state_->light = std::make_shared<const SkyLight>(sky_light(input.environment));
    state_->lit_environment = input.environment;
  }
  return draw(instant::describe(std::move(input), state_->scene.summary, state_->light), passing);
}

Expected<image::Image> Renderer::read_back() {
  image::Image picture(state_->targets.width, state_->targets.height);
  if (!state_->drawn) return picture;
  try {
    read_picture(state_->targets, state_->device, state_->memory, picture.rgba);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  return picture;
}

Exposure Renderer::exposure() const { return state_->exposure; }

Expected<RadianceImage> Renderer::read_radiance() {
  RadianceImage result{state_->targets.width, state_->targets.height, {}};
  result.radiance.resize(std::size_t{result.width} * result.height, glm::vec3(0.0f));
  if (!state_->drawn) return result;
  std::vector<std::uint64_t> halves(result.radiance.size());
  try {
    render::read_radiance(state_->targets, state_->device, state_->memory, halves);
  } catch (const vulkan::Failure& refused) {
    return tl::unexpected(refused.error);
  }
  std::ranges::transform(halves, result.radiance.begin(),
                         [](std::uint64_t half) { return glm::vec3(glm::unpackHalf4x16(half)); });
  return result;
}

std::uint32_t Renderer::width() const { return state_->targets.width; }
std::uint32_t Renderer::height() const { return state_->targets.height; }
const RenderStatistics& Renderer::statistics() const { return state_->statistics; }
std::string_view Renderer::device_name() const { return state_->device.properties.deviceName; }

}  // namespace septet::render
