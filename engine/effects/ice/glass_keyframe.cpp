#include "engine/effects/ice/glass_keyframe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace septet::ice {
namespace {

constexpr std::uint8_t glass_version = 1;
constexpr double per_m = 1000.0, per_kgpm2 = 1000.0, of_one = 255.0;
constexpr std::uint64_t longest = 20'000, most_of_one = 255,
                        most_frost = static_cast<std::uint64_t>(most_frost_kgpm2 * per_kgpm2);

/// Returns the written integer.
std::uint64_t put(ByteWriter& out, double value, double quanta, std::uint64_t most) {
  const double scaled = std::clamp(std::isfinite(value) ? value * quanta : 0.0, 0.0, static_cast<double>(most));
  const auto rounded = static_cast<std::uint64_t>(std::lround(scaled));
  out.put_varint(rounded);
  return rounded;
}

double get(ByteReader& in, double quanta, std::uint64_t most) {
  const std::uint64_t value = in.get_varint();
  if (value > most) in.fail();
  return value > most ? 0.0 : static_cast<double>(value) / quanta;
}

std::uint32_t get_number(ByteReader& in) {
  const std::uint64_t value = in.get_varint();
  if (value > UINT32_MAX) in.fail();
  return static_cast<std::uint32_t>(value);
}

}  // namespace

Bytes encode_glass(const std::vector<Pane>& panes) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(glass_version);
  const std::size_t count = std::min(panes.size(), most_panes);
  out.put_varint(count);
  for (const Pane& pane : std::span(panes).first(count)) {
    out.put_varint(pane.vehicle);
    if (put(out, pane.frost.thickness_kgpm2, per_kgpm2, most_frost) > 0) {
      out.put_varint(pane.frost.seed);
      for (const double melted : pane.frost.melted_kgpm2) put(out, melted, per_kgpm2, most_frost);
    }
    const std::size_t stars = std::min(pane.stars.size(), most_stars);
    out.put_varint(stars);
    for (const Star& star : std::span(pane.stars).first(stars)) {
      put(out, star.across, of_one, most_of_one);
      put(out, star.up, of_one, most_of_one);
      put(out, star.reach_m, per_m, longest);
      out.put_varint(star.seed);
    }
  }
  return bytes;
}

Expected<std::vector<Pane>> decode_glass(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != glass_version) in.fail();
  // Number of items of at least `bytes_each` bytes.
  const auto count_of = [&](std::size_t most, std::size_t bytes_each) {
    return in.get_count(std::min(most, in.remaining() / bytes_each));
  };
  std::vector<Pane> panes(count_of(most_panes, 3));
  for (Pane& pane : panes) {
    pane.vehicle = get_number(in);
    pane.frost.thickness_kgpm2 = get(in, per_kgpm2, most_frost);
    if (pane.frost.thickness_kgpm2 > 0.0) {
      pane.frost.seed = get_number(in);
      for (double& melted : pane.frost.melted_kgpm2) melted = get(in, per_kgpm2, most_frost);
    }
    pane.stars.resize(count_of(most_stars, 4));
    for (Star& star : pane.stars) {
      star.across = get(in, of_one, most_of_one);
      star.up = get(in, of_one, most_of_one);
      star.reach_m = get(in, per_m, longest);
      star.seed = get_number(in);
    }
  }
  if (!in.ok() || !in.at_end())
    return failure("the bytes are of another kind, or damaged", "glass keyframe",
                   "send what the same version of Septet wrote");
  return panes;
}

}  // namespace septet::ice
