#include "sim-client/film/traced/layers.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "engine/instant/atmosphere.hpp"

namespace septet::film {
namespace {

using raytrace::TracedPixel;

constexpr std::array<std::pair<Layer, std::string_view>, 7> names{{{Layer::depth, "depth"},
                                                                   {Layer::object, "object"},
                                                                   {Layer::participant, "participant"},
                                                                   {Layer::normal, "normal"},
                                                                   {Layer::albedo, "albedo"},
                                                                   {Layer::motion, "motion"},
                                                                   {Layer::variance, "variance"}}};

std::string all_names() {
  std::string text;
  for (const auto& [layer, name] : names) text.append(text.empty() ? "" : ",").append(name);
  return text;
}

/// Channels of one picture, filled pixel by pixel.
class Channels {
 public:
  Channels(exr::Picture& picture, const raytrace::TracedPicture& traced) : picture_(picture), traced_(traced) {}

  template <class Value>
  void add(std::string name, exr::ChannelType type, const Value& value_of) {
    std::vector<decltype(value_of(std::declval<const TracedPixel&>()))> values;
    values.reserve(traced_.pixels.size());
    for (const TracedPixel& pixel : traced_.pixels) values.push_back(value_of(pixel));
    picture_.channels.push_back({std::move(name), type, std::move(values)});
  }
  /// Adds three numbers as LAYER.X, LAYER.Y, LAYER.Z, or with other letters.
  template <class Value>
  void add_three(const std::string& layer, const char* letters, exr::ChannelType type, const Value& value_of) {
    for (int n = 0; n < 3; ++n)
      add(layer + letters[n], type, [&](const TracedPixel& pixel) -> float { return value_of(pixel)[n]; });
  }

 private:
  exr::Picture& picture_;
  const raytrace::TracedPicture& traced_;
};

void put_camera(exr::Picture& picture, const instant::FrameView& view) {
  const instant::OffAxisView& p = view.projection;
  picture.screen_middle = glm::vec2(0.5 * (p.left_slope + p.right_slope), 0.5 * (p.bottom_slope + p.top_slope));
  picture.screen_width = static_cast<float>(p.right_slope - p.left_slope);
  const Quat turn = view.world_from_car.orientation;
  const Vec3 eye_m = instant::world_eye(view);
  const std::array<Vec3, 3> axes{turn * p.right, turn * p.up, turn * -p.back};
  for (int row = 0; row < 3; ++row) {
    const Vec3& axis = axes[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column) picture.camera_from_world[column][row] = axis[column];
    picture.camera_from_world[3][row] = -glm::dot(axis, eye_m);
  }
  picture.attributes["septet.eye_m"] = eye_m;
  picture.attributes["septet.right"] = axes[0];
  picture.attributes["septet.up"] = axes[1];
  picture.attributes["septet.ahead"] = axes[2];
}

}  // namespace

std::string read_layers(const std::string& text, std::set<Layer>& layers) {
  layers.clear();
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(',', from), text.size());
    const std::string_view name = std::string_view(text).substr(from, end - from);
    from = end + 1;
    bool known = name == "all";
    for (const auto& [layer, its_name] : names)
      if (name == its_name || name == "all") layers.insert(layer), known = true;
    if (!known) return "\"" + std::string(name) + "\" is no layer; write all, or some of " + all_names();
  }
  return {};
}

std::string layers_text(const std::set<Layer>& layers) {
  std::string text;
  for (const auto& [layer, name] : names)
    if (layers.contains(layer)) text.append(text.empty() ? "" : ",").append(name);
  return text;
}

exr::Picture exr_picture(const raytrace::TracedPicture& traced, const FrameFacts& facts, const ExrFacts& more,
                         ExrNumbers numbers, const std::set<Layer>& layers) {
  exr::Picture picture{.width = traced.width, .height = traced.height, .frames_per_second = more.frames_per_second};
  const instant::Exposure exposure{static_cast<float>(facts.ev100)};
  const float scale = exposure.scale();
  picture.white_luminance_cdpm2 = instant::luminance_unit_cdpm2 / scale;
  put_camera(picture, facts.view);
  picture.attributes["septet.version"] = more.septet;
  picture.attributes["septet.session"] = more.session;
  picture.attributes["septet.drive_seeds"] = more.drive_seeds;
  picture.attributes["septet.instant_s"] = facts.simulated_time_s;
  picture.attributes["septet.tick"] = facts.simulated_time_s * more.ticks_per_second;
  picture.attributes["septet.frame"] = static_cast<double>(more.frame);
  picture.attributes["septet.seed"] = std::to_string(more.frame);
  picture.attributes["septet.samples"] = static_cast<double>(more.samples);
  picture.attributes["septet.ev100"] = facts.ev100;

  const exr::ChannelType real =
      numbers == ExrNumbers::half_precision ? exr::ChannelType::half_precision : exr::ChannelType::single_precision;
  Channels channels(picture, traced);
  channels.add_three("", "RGB", real, [&](const TracedPixel& pixel) { return pixel.radiance * scale; });
  const auto has = [&](Layer layer) { return layers.contains(layer); };
  if (has(Layer::depth))
    channels.add("Z", exr::ChannelType::single_precision, [](const TracedPixel& pixel) {
      return pixel.object == 0 ? std::numeric_limits<float>::infinity() : pixel.depth_m;
    });
  if (has(Layer::object))
    channels.add("object", exr::ChannelType::number, [](const TracedPixel& pixel) { return pixel.object; });
  if (has(Layer::participant))
    channels.add("participant", exr::ChannelType::number, [](const TracedPixel& pixel) { return pixel.participant; });
  if (has(Layer::normal))
    channels.add_three("normal.", "XYZ", real, [](const TracedPixel& pixel) { return pixel.normal; });
  if (has(Layer::albedo))
    channels.add_three("albedo.", "RGB", real, [](const TracedPixel& pixel) { return pixel.albedo; });
  if (has(Layer::motion)) {
    picture.attributes["septet.motion"] = "pixels to the next frame, X to the right, Y down";
    channels.add("motion.X", exr::ChannelType::single_precision, [](const TracedPixel& p) { return p.motion_px.x; });
    channels.add("motion.Y", exr::ChannelType::single_precision, [](const TracedPixel& p) { return p.motion_px.y; });
  }
  if (has(Layer::variance))
    channels.add("variance", exr::ChannelType::single_precision,
                 [&](const TracedPixel& pixel) { return pixel.variance * scale * scale; });
  return picture;
}

}  // namespace septet::film
