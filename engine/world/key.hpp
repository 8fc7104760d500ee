#pragma once
/// The keys of a keyboard that Septet reads, by their place on a US keyboard.

#include <cstdint>
#include <string_view>

namespace septet {

enum class Key : std::uint8_t {
  arrow_up,
  arrow_down,
  arrow_left,
  arrow_right,
  space,
  comma,
  full_stop,
  a,
  b,
  d,
  e,
  f,
  g,
  h,
  l,
  m,
  p,
  q,
  r,
  s,
  v,
  w,
  x,
  f1,
  enter,
  escape,
};
inline constexpr std::size_t key_count = static_cast<std::size_t>(Key::escape) + 1;

/// Common name: "Arrow up", "Full stop", "W".
std::string_view name_of(Key key);

}  // namespace septet
