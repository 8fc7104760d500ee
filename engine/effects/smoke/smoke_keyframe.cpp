#include "engine/effects/smoke/smoke_keyframe.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/effects/smoke/bit_packing.hpp"

namespace septet::smoke {
namespace {

constexpr std::uint8_t version = 2;
constexpr std::int32_t furthest = max_cells_along * steps_per_cell;
constexpr int most_bits = 17;
constexpr float endless_age_step_s = 0.25f;
using Place = std::array<std::int32_t, 3>;

struct Range {
  std::int32_t low = 0;
  int bits = 0;
};

float age_step_s(float lifetime_s) { return lifetime_s > 0.0f ? lifetime_s / 255.0f : endless_age_step_s; }

std::uint8_t in_255ths(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

struct Entry {
  std::size_t slot;      ///< Within the chunk.
  std::size_t particle;  ///< Its place in the state.
  Place from, to;
  std::int32_t births;
  bool newborn;
};

/// Three coordinates, the three changes to them, and the births.
constexpr int packed_numbers = 7;
std::int32_t number_of(const Entry& e, int n) {
  return n < 3 ? e.to[n] : n < 6 ? e.from[n - 3] - e.to[n - 3] : e.births;
}

std::array<Range, packed_numbers> ranges_of(const std::vector<Entry>& entries) {
  std::array<Range, packed_numbers> ranges;
  for (int n = 0; n < packed_numbers; ++n) {
    const auto value = [&](const Entry& e) { return number_of(e, n); };
    std::int32_t low = value(entries.front()), high = low;
    for (const Entry& e : entries) low = std::min(low, value(e)), high = std::max(high, value(e));
    ranges[n] = {low, static_cast<int>(std::bit_width(static_cast<std::uint32_t>(high - low)))};
  }
  return ranges;
}

void put_header(ByteWriter& writer, const State& state, std::uint32_t chunk, double duration_s) {
  const Grid& grid = state.grid;
  writer.put(version);
  writer.put(chunk);
  for (int c = 0; c < 3; ++c) writer.put(grid.world_from_grid.position_m[c]);
  const Quat& q = grid.world_from_grid.orientation;
  for (const double part : {q.w, q.x, q.y, q.z}) writer.put(part);
  writer.put(static_cast<float>(grid.cell_m));
  writer.put(state.time_s);
  writer.put(static_cast<float>(duration_s));
  writer.put_varint(state.emitters.size());
  for (const Emitter& emitter : state.emitters) {
    for (const float part : emitter.albedo) writer.put(in_255ths(part));
    writer.put(in_255ths(emitter.glow));
    writer.put(static_cast<float>(emitter.extinction_area_m2));
    writer.put(static_cast<float>(emitter.lifetime_s));
  }
}

Bytes encode(const State& state, std::uint32_t chunk, double duration_s, const std::vector<Entry>& entries) {
  Bytes bytes;
  ByteWriter writer(bytes);
  put_header(writer, state, chunk, duration_s);
  const auto ranges = ranges_of(entries);
  for (const Range& range : ranges) {
    writer.put_signed_varint(range.low);
    writer.put(static_cast<std::uint8_t>(range.bits));
  }
  std::array<std::uint8_t, chunk_slots / 8> alive{};
  for (const Entry& e : entries) {
    alive[e.slot / 8] = static_cast<std::uint8_t>(alive[e.slot / 8] | (1 << (e.slot % 8)));
  }
  for (const std::uint8_t byte : alive) writer.put(byte);
  const int look_bits = std::bit_width(state.emitters.size() - 1);
  BitWriter packed(bytes);
  for (const Entry& e : entries) {
    for (int n = 0; n < packed_numbers; ++n)
      packed.put(static_cast<std::uint32_t>(number_of(e, n) - ranges[n].low), ranges[n].bits);
    const std::uint8_t look = state.particles.emitter[e.particle];
    const float step = age_step_s(static_cast<float>(state.emitters[look].lifetime_s));
    packed.put(look, look_bits);
    packed.put(static_cast<std::uint32_t>(std::min(255.0f, std::round(state.particles.age_s[e.particle] / step))), 8);
    packed.put(e.newborn, 1);
  }
  return bytes;
}

constexpr std::uint32_t nobody = 0xffffffff;

/// `particle_of` maps each number to the place of its particle, or to `nobody`.
void renew(KeyframeTrack& track, const State& state, std::size_t number, std::span<const std::uint32_t> particle_of) {
  const Particles& particles = state.particles;
  KeyframeTrack::Chunk& chunk = track.chunks[number];
  const std::size_t first = number * chunk_slots;
  const double duration_s = state.time_s - chunk.time_s;
  chunk.place.resize(chunk_slots);
  chunk.known.resize(chunk_slots);
  std::vector<Entry> entries;
  for (std::size_t slot = 0; slot < std::min(chunk_slots, particle_of.size() - first); ++slot) {
    const std::uint32_t n = particle_of[first + slot];
    const bool known = chunk.known[slot] != 0;
    chunk.known[slot] = n != nobody;
    if (n == nobody) continue;
    const auto quantised = [](float value) { return static_cast<std::int32_t>(std::lround(value * steps_per_cell)); };
    Entry e{slot,
            n,
            {},
            {quantised(particles.x[n]), quantised(particles.y[n]), quantised(particles.z[n])},
            particles.births[n],
            !known || particles.age_s[n] < duration_s};
    e.from = e.newborn ? e.to : chunk.place[slot];
    chunk.place[slot] = e.to;
    entries.push_back(e);
  }
  chunk.time_s = state.time_s;
  chunk.data = entries.empty()
                   ? Bytes{}
                   : encode(state, track.first_chunk + static_cast<std::uint32_t>(number), duration_s, entries);
}

tl::unexpected<Error> refuse(const char* what) {
  return failure(what, "smoke keyframe", "send what the same version of Septet wrote");
}

bool within(double value, double low, double high) { return value >= low && value <= high; }

Expected<void> read_header(ByteReader& reader, Keyframe& keyframe) {
  if (reader.get<std::uint8_t>() != version) return refuse("unknown version");
  keyframe.chunk = reader.get<std::uint32_t>();
  bool good = keyframe.chunk < max_chunks;
  for (int c = 0; c < 3; ++c) {
    keyframe.world_from_grid.position_m[c] = reader.get_double();
    good = good && within(keyframe.world_from_grid.position_m[c], -1e7, 1e7);
  }
  Quat& q = keyframe.world_from_grid.orientation;
  for (double* part : {&q.w, &q.x, &q.y, &q.z}) *part = reader.get_double();
  good = good && within(glm::length(q), 0.999, 1.001);
  keyframe.cell_m = reader.get_float();
  keyframe.time_s = reader.get_double();
  keyframe.duration_s = reader.get_float();
  good = good && within(keyframe.cell_m, 1e-3, 1e3) && within(keyframe.time_s, 0.0, 1e9) &&
         within(keyframe.duration_s, 0.0, 1e9);
  const std::size_t looks = reader.get_count(max_emitters);
  for (std::size_t n = 0; n < looks; ++n) {
    Keyframe::Look look;
    for (float& part : look.albedo) part = static_cast<float>(reader.get<std::uint8_t>()) / 255.0f;
    look.glow = static_cast<float>(reader.get<std::uint8_t>()) / 255.0f;
    look.extinction_area_m2 = reader.get_float();
    look.lifetime_s = reader.get_float();
    good = good && within(look.extinction_area_m2, 0.0, 1e4) && within(look.lifetime_s, 0.0, 1e6);
    keyframe.looks.push_back(look);
  }
  if (!reader.ok() || !good || looks == 0) return refuse("header out of bounds");
  return {};
}

}  // namespace

std::vector<EffectKeyframe> advance_keyframes(KeyframeTrack& track, const State& state) {
  const std::size_t count = (state.particles.numbers + chunk_slots - 1) / chunk_slots;
  SEPTET_CHECK(track.first_chunk + count <= max_chunks, "{} chunks", count);
  while (track.chunks.size() < count) track.chunks.emplace_back().time_s = state.time_s;
  std::vector<std::uint32_t> particle_of(state.particles.numbers, nobody);
  for (std::size_t n = 0; n < state.particles.size(); ++n)
    particle_of[state.particles.number[n]] = static_cast<std::uint32_t>(n);
  for (std::size_t n = 0; n < count; ++n)
    // 7 and 30 have no common divisor: neighbouring chunks, which are filled together, go on different ticks.
    if ((state.tick + 7 * n) % keyframe_ticks == 0) renew(track, state, n, particle_of);
  std::vector<EffectKeyframe> effects;
  for (std::size_t n = 0; n < count; ++n)
    if (!track.chunks[n].data.empty())
      effects.push_back(
          {first_effect_id + track.first_chunk + static_cast<std::uint32_t>(n), keyframe_kind, track.chunks[n].data});
  return effects;
}

Expected<Keyframe> decode(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  Keyframe keyframe;
  if (auto header = read_header(reader, keyframe); !header) return tl::unexpected(std::move(header).error());
  std::array<Range, packed_numbers> ranges;
  for (Range& range : ranges) {
    const std::int64_t low = reader.get_signed_varint();
    range.bits = reader.get<std::uint8_t>();
    if (!within(static_cast<double>(low), -furthest, furthest) || range.bits > most_bits)
      return refuse("coordinate out of bounds");
    range.low = static_cast<std::int32_t>(low);
  }
  std::array<std::uint8_t, chunk_slots / 8> alive{};
  std::size_t count = 0;
  for (std::uint8_t& byte : alive) count += std::popcount(byte = reader.get<std::uint8_t>());
  const int look_bits = std::bit_width(keyframe.looks.size() - 1);
  std::size_t bits = look_bits + 8 + 1;
  for (const Range& range : ranges) bits += range.bits;
  if (!reader.ok() || reader.remaining() != (count * bits + 7) / 8) return refuse("length does not fit");
  BitReader packed(reader.take(reader.remaining()));
  keyframe.particles.reserve(count);
  for (std::size_t slot = 0; slot < chunk_slots; ++slot) {
    if ((alive[slot / 8] >> (slot % 8) & 1) == 0) continue;
    std::array<std::int32_t, packed_numbers> value;
    for (int n = 0; n < packed_numbers; ++n)
      value[n] = ranges[n].low + static_cast<std::int32_t>(packed.get(ranges[n].bits));
    Keyframe::Particle particle;
    particle.slot = static_cast<std::uint16_t>(slot);
    particle.look = static_cast<std::uint8_t>(packed.get(look_bits));
    if (particle.look >= keyframe.looks.size()) return refuse("look out of bounds");
    particle.age_s = static_cast<float>(packed.get(8)) * age_step_s(keyframe.looks[particle.look].lifetime_s);
    particle.newborn = packed.get(1) != 0;
    if (!within(value[6], 1, 0xffff)) return refuse("births out of bounds");
    particle.births = static_cast<std::uint16_t>(value[6]);
    for (int c = 0; c < 3; ++c) {
      particle.to[c] = static_cast<float>(value[c]) / steps_per_cell;
      particle.from[c] = static_cast<float>(value[c] + value[c + 3]) / steps_per_cell;
    }
    keyframe.particles.push_back(particle);
  }
  return keyframe;
}

}  // namespace septet::smoke
