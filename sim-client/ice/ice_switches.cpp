#include "sim-client/ice/ice_switches.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace septet::ice_viewer {
namespace {

constexpr float frost = 0.8f, wet = 1.0f, bump = 0.12f;
constexpr std::uint32_t cracks = 2, air_planes = 19, most_cracks = 100000;

/// Part of the drawing that is on or off.
struct Switch {
  Key key;
  const char* name;
  bool (*is_on)(const IceOptions&);
  void (*set)(IceOptions&, bool on);
};

constexpr std::array<Switch, 11> list{{
    {Key::q, "quality: light followed from face to face",
     [](const IceOptions& o) { return o.look.mode == ice::Mode::quality; },
     [](IceOptions& o, bool on) { o.look.mode = on ? ice::Mode::quality : ice::Mode::paper; }},
    {Key::s, "both sides refract", [](const IceOptions& o) { return o.look.two_sided; },
     [](IceOptions& o, bool on) { o.look.two_sided = on; }},
    {Key::l, "equation 1 as a lens", [](const IceOptions& o) { return o.look.back_sign == ice::BackSign::as_a_lens; },
     [](IceOptions& o, bool on) { o.look.back_sign = on ? ice::BackSign::as_a_lens : ice::BackSign::as_printed; }},
    {Key::e, "reflection", [](const IceOptions& o) { return o.look.reflects; },
     [](IceOptions& o, bool on) { o.look.reflects = on; }},
    {Key::x, "cracks", [](const IceOptions& o) { return o.cracks > 0; },
     [](IceOptions& o, bool on) { o.cracks = on ? cracks : 0; }},
    {Key::d, "cracks bend what is seen (quality)", [](const IceOptions& o) { return o.look.bent_by_cracks; },
     [](IceOptions& o, bool on) { o.look.bent_by_cracks = on; }},
    {Key::a, "air", [](const IceOptions& o) { return o.air_planes > 0; },
     [](IceOptions& o, bool on) { o.air_planes = on ? air_planes : 0; }},
    {Key::h, "bumps", [](const IceOptions& o) { return o.look.bump > 0.0f; },
     [](IceOptions& o, bool on) { o.look.bump = on ? bump : 0.0f; }},
    {Key::f, "frost", [](const IceOptions& o) { return o.look.roughness > 0.0f; },
     [](IceOptions& o, bool on) { o.look.roughness = on ? frost : 0.0f; }},
    {Key::w, "wet", [](const IceOptions& o) { return o.look.wetness > 0.0f; },
     [](IceOptions& o, bool on) { o.look.wetness = on ? wet : 0.0f; }},
    {Key::enter, "a second one behind it", [](const IceOptions& o) { return o.pair; },
     [](IceOptions& o, bool on) { o.pair = on; }},
}};

}  // namespace

bool press(IceOptions& options, Key key) {
  if (key == Key::comma || key == Key::full_stop) {
    const std::uint32_t before = options.cracks;
    options.cracks = key == Key::comma ? before / 2 : std::clamp(2 * before, 1u, most_cracks);
    return options.cracks != before;
  }
  for (const Switch& each : list)
    if (each.key == key) {
      each.set(options, !each.is_on(options));
      return true;
    }
  return false;
}

std::vector<std::string> switches(const IceOptions& options) {
  std::vector<std::string> lines;
  lines.reserve(list.size() + 2);
  for (const Switch& each : list)
    lines.push_back(fmt::format("{} {}  {}", each.is_on(options) ? "●" : "○", name_of(each.key), each.name));
  lines.push_back(fmt::format("{} cracks: comma halves, full stop doubles", options.cracks));
  lines.push_back("Space: stand or turn, arrows: turn, near, far, F1: these lines, Escape: end");
  return lines;
}

}  // namespace septet::ice_viewer
