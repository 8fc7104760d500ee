#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "engine/effects/debris/dent.hpp"

namespace septet::debris {
namespace {

constexpr std::uint8_t only_dents = 1, dents_and_torn = 2;
constexpr double per_m = 100.0, depths_per_m = 200.0, per_turn = 256.0;
constexpr std::int64_t furthest_cm = 5'000, widest_cm = 1'000;  ///< No vehicle is longer, or wider.
constexpr std::int64_t deepest_half_cm = static_cast<std::int64_t>(most_depth_m * depths_per_m);

std::int64_t quanta_of(double value, double per_unit, std::int64_t least, std::int64_t most) {
  if (!std::isfinite(value)) return least;
  return std::llround(std::clamp(value * per_unit, static_cast<double>(least), static_cast<double>(most)));
}

std::uint8_t turn_of(double heading_rad) {
  if (!std::isfinite(heading_rad)) return 0;
  const double turns = heading_rad / (2.0 * std::numbers::pi);
  return static_cast<std::uint8_t>(std::lround((turns - std::floor(turns)) * per_turn) % 256);
}

}  // namespace

Bytes encode_dents(std::span<const DentedVehicle> vehicles) {
  vehicles = vehicles.first(std::min(vehicles.size(), most_dented_vehicles));
  Bytes bytes;
  ByteWriter out(bytes);
  const bool any_torn = std::ranges::any_of(vehicles, [](const DentedVehicle& vehicle) { return vehicle.torn != 0; });
  out.put(any_torn ? dents_and_torn : only_dents);
  out.put_varint(vehicles.size());
  for (const DentedVehicle& vehicle : vehicles) {
    const std::size_t count = std::min(vehicle.dents.size(), most_dents);
    out.put_varint(vehicle.vehicle);
    if (any_torn) out.put_varint(vehicle.torn);
    out.put_varint(count);
    for (const Dent& dent : std::span(vehicle.dents).first(count)) {
      for (int c = 0; c < 2; ++c) out.put_signed_varint(quanta_of(dent.place_m[c], per_m, -furthest_cm, furthest_cm));
      out.put(turn_of(dent.heading_rad));
      out.put(static_cast<std::uint8_t>(quanta_of(dent.depth_m, depths_per_m, 0, deepest_half_cm)));
      out.put_varint(static_cast<std::uint64_t>(quanta_of(dent.half_width_m, per_m, 0, widest_cm)));
      out.put_varint(static_cast<std::uint64_t>(quanta_of(dent.top_m, per_m, 0, widest_cm)));
    }
  }
  return bytes;
}

Expected<std::vector<DentedVehicle>> decode_dents(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  const auto length = [&](std::uint64_t most) {
    const std::uint64_t value = in.get_varint();
    if (value > most) in.fail();
    return in.ok() ? static_cast<double>(value) / per_m : 0.0;
  };
  const auto version = in.get<std::uint8_t>();
  if (version < only_dents || version > dents_and_torn) in.fail();
  // Number of items of at least `bytes_each` bytes.
  const auto count_of = [&](std::size_t most, std::size_t bytes_each) {
    return in.get_count(std::min(most, in.remaining() / bytes_each));
  };
  std::vector<DentedVehicle> vehicles(count_of(most_dented_vehicles, 2));
  for (DentedVehicle& vehicle : vehicles) {
    const std::uint64_t id = in.get_varint();
    if (id > UINT32_MAX) in.fail();
    vehicle.vehicle = static_cast<ParticipantId>(id);
    if (version == dents_and_torn) {
      const std::uint64_t torn = in.get_varint();
      if (torn >= 1u << mount_count) in.fail();
      vehicle.torn = static_cast<Mounts>(torn);
    }
    vehicle.dents.resize(count_of(most_dents, 6));
    for (Dent& dent : vehicle.dents) {
      for (int c = 0; c < 2; ++c) {
        const std::int64_t value = in.get_signed_varint();
        if (value < -furthest_cm || value > furthest_cm) in.fail();
        dent.place_m[c] = in.ok() ? static_cast<double>(value) / per_m : 0.0;
      }
      dent.heading_rad = in.get<std::uint8_t>() * (2.0 * std::numbers::pi / per_turn);
      const auto depth = in.get<std::uint8_t>();
      if (depth > deepest_half_cm) in.fail();
      dent.depth_m = depth / depths_per_m;
      dent.half_width_m = length(widest_cm);
      dent.top_m = length(widest_cm);
    }
  }
  if (!in.ok() || !in.at_end())
    return failure("the bytes are of another kind, or damaged", "dent keyframe",
                   "send what the same version of Septet wrote");
  return vehicles;
}

}  // namespace septet::debris
