#include "engine/world/wire_snapshot.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "engine/core/check.hpp"
#include "engine/world/participant_quantisation.hpp"
#include "engine/world/world_members.hpp"

namespace septet {
namespace {

constexpr std::uint8_t format_version = 2;
enum Flags : std::uint8_t { flag_has_baseline = 1, flag_environment = 2, flag_game = 4, flag_head = 8 };

// The doubles of the environment and of the driver's car, in the order of SNAPSHOT.md.
template <class Env, class Visit>
void visit_environment(Env& environment, Visit visit) {
  std::apply([&](auto&... values) { (visit(values), ...); }, members(environment));
}
template <class Car, class Visit>
void visit_driver_car(Car& c, Visit visit) {
  visit(c.speed_mps);
  visit(c.engine_radps);
  visit(c.steering_wheel_rad);
  visit(c.steering_torque_nm);
  visit(c.accelerator);
  visit(c.brake);
  visit(c.clutch);
  visit(c.yaw_rate_radps);
  visit(c.gaze_heading_rad);
  visit(c.road_s_m);
  visit(c.lateral_position_m);
  visit(c.lane_width_m);
}

double get_finite(ByteReader& reader) {
  const double value = reader.get_double();
  if (!std::isfinite(value)) reader.fail();
  return value;
}

void put_game(ByteWriter& writer, const GameStanding& game) {
  writer.put_varint(game.level);
  writer.put(static_cast<std::uint8_t>(game.end));
  for (const double value : {game.points, game.survived_s, game.leader_m, game.away_s}) writer.put(value);
}
GameStanding get_game(ByteReader& reader) {
  GameStanding game;
  game.level = static_cast<std::uint32_t>(reader.get_count(0xffffffffu));
  game.end = static_cast<GameEnd>(reader.get<std::uint8_t>());
  if (game.end > GameEnd::time) reader.fail();
  for (double* value : {&game.points, &game.survived_s, &game.leader_m, &game.away_s}) *value = get_finite(reader);
  return game;
}

void put_head(ByteWriter& writer, const Head& head) {
  for (const double value : {head.from_rest_m.x, head.from_rest_m.y, head.from_rest_m.z, head.turn_rad})
    writer.put(value);
}
/// A head beyond the limit fails the reader: its picture would show nothing.
Head get_head(ByteReader& reader) {
  Head head;
  for (double* value : {&head.from_rest_m.x, &head.from_rest_m.y, &head.from_rest_m.z, &head.turn_rad})
    *value = get_finite(reader);
  for (int i = 0; i < 3; ++i)
    if (std::abs(head.from_rest_m[i]) > farthest_head_m) reader.fail();
  if (std::abs(head.turn_rad) > std::numbers::pi) reader.fail();
  return head;
}

/// Ascending ids as first id, then gaps.
class IdGaps {
 public:
  std::uint32_t before(std::uint32_t id) { return id - std::exchange(next_, id + 1); }

 private:
  std::uint32_t next_ = 0;
};
class IdReader {
 public:
  std::uint32_t get(ByteReader& reader) {
    const std::uint64_t gap = reader.get_varint();
    const std::uint64_t id = first_ ? gap : previous_ + 1 + gap;
    if (gap > 0xffffffffu || id > 0xffffffffu) reader.fail();
    previous_ = id;
    first_ = false;
    return static_cast<std::uint32_t>(id);
  }

 private:
  std::uint64_t previous_ = 0;
  bool first_ = true;
};

/// Ids of `from` that `to` lacks; both ascending by id.
template <class Item>
std::vector<std::uint32_t> removed_ids(const std::vector<Item>& from, const std::vector<Item>& to) {
  std::vector<std::uint32_t> removed;
  std::size_t j = 0;
  for (const Item& item : from) {
    while (j < to.size() && to[j].id < item.id) ++j;
    if (j == to.size() || to[j].id != item.id) removed.push_back(item.id);
  }
  return removed;
}

void put_ids(ByteWriter& writer, const std::vector<std::uint32_t>& ids) {
  writer.put_varint(ids.size());
  IdGaps gaps;
  for (const auto id : ids) writer.put_varint(gaps.before(id));
}

template <class Item>
void remove_ids(ByteReader& reader, std::vector<Item>& items, std::size_t limit) {
  const std::size_t count = reader.get_count(limit);
  IdReader ids;
  auto next = items.begin();
  std::vector<Item> kept;
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    const auto id = ids.get(reader);
    while (next != items.end() && next->id < id) kept.push_back(std::move(*next++));
    if (next == items.end() || next->id != id) return reader.fail();
    ++next;
  }
  kept.insert(kept.end(), std::make_move_iterator(next), std::make_move_iterator(items.end()));
  items = std::move(kept);
}

/// Participants that a receiver expects at an instant from the baseline alone.
std::vector<WireParticipant> expected_participants(const WireSnapshot* baseline, double time_s) {
  std::vector<WireParticipant> expected;
  if (!baseline) return expected;
  expected.reserve(baseline->participants.size());
  const double seconds = seconds_since(*baseline, time_s);
  for (const auto& participant : baseline->participants) expected.push_back(extrapolate(participant, seconds));
  return expected;
}

/// Bit f is set where field f differs.
std::uint32_t changed_fields(const WireParticipant& now, const WireParticipant& reference) {
  std::uint32_t mask = 0;
  for (std::size_t f = 0; f < participant_field_count; ++f)
    mask |= static_cast<std::uint32_t>(now.fields[f] != reference.fields[f]) << f;
  return mask;
}

void put_participants(ByteWriter& writer, const WireSnapshot* baseline, const WireSnapshot& wire) {
  static const std::vector<WireParticipant> nobody;
  const auto& before = baseline ? baseline->participants : nobody;
  const double seconds = baseline ? seconds_since(*baseline, wire.rest.simulated_time_s) : 0.0;
  put_ids(writer, removed_ids(before, wire.participants));
  std::size_t count = 0;
  Bytes changes;
  changes.reserve(16 * wire.participants.size());
  IdGaps gaps;
  auto old = before.begin();
  for (const auto& participant : wire.participants) {
    while (old != before.end() && old->id < participant.id) ++old;
    const bool known = old != before.end() && old->id == participant.id;
    const WireParticipant reference = known ? extrapolate(*old, seconds) : WireParticipant{};
    const std::uint32_t mask = changed_fields(participant, reference);
    if (known && mask == 0) continue;
    std::byte bytes[5 * (2 + participant_field_count)];  // No varint of 33 bits or less is longer.
    std::byte* end = write_varint(write_varint(bytes, gaps.before(participant.id)), mask);
    for (std::uint32_t left = mask; left != 0; left &= left - 1) {
      const auto f = static_cast<std::size_t>(std::countr_zero(left));
      end = write_varint(end, zigzag(std::int64_t{participant.fields[f]} - reference.fields[f]));
    }
    changes.insert(changes.end(), bytes, end);
    ++count;
  }
  writer.put_varint(count);
  writer.put_bytes(changes);
}

void read_participants(ByteReader& reader, std::vector<WireParticipant>& participants) {
  remove_ids(reader, participants, max_wire_participants);
  const std::size_t count = reader.get_count(max_wire_participants);
  IdReader ids;
  std::vector<WireParticipant> added;
  std::size_t j = 0;
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    const auto id = ids.get(reader);
    while (j < participants.size() && participants[j].id < id) ++j;
    const bool known = j < participants.size() && participants[j].id == id;
    WireParticipant fresh;
    fresh.id = id;
    WireParticipant& target = known ? participants[j] : fresh;
    const std::uint64_t mask = reader.get_varint();
    if (mask >> participant_field_count) reader.fail();
    for (std::size_t f = 0; f < participant_field_count; ++f) {
      if (!(mask & (1ull << f))) continue;
      // Unsigned addition wraps where a hostile difference would overflow; the limits then refuse the sum.
      const auto sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(std::int64_t{target.fields[f]}) +
                                                 static_cast<std::uint64_t>(reader.get_signed_varint()));
      const auto [low, high] = participant_field_limits(f);
      if (sum < low || sum > high) return reader.fail();
      target.fields[f] = static_cast<std::int32_t>(sum);
    }
    if (static_cast<std::size_t>(target.fields[field_model]) >= vehicle_models().size()) return reader.fail();
    if (!known) added.push_back(fresh);
  }
  if (participants.size() + added.size() > max_wire_participants) return reader.fail();
  const auto middle = participants.insert(participants.end(), added.begin(), added.end());
  std::inplace_merge(participants.begin(), middle, participants.end(),
                     [](const auto& a, const auto& b) { return a.id < b.id; });
}

void put_effects(ByteWriter& writer, const std::vector<EffectKeyframe>& before, const std::vector<EffectKeyframe>& now,
                 Tick tick) {
  put_ids(writer, removed_ids(before, now));
  std::vector<const EffectKeyframe*> changed;
  for (const auto& effect : now) {
    const auto old = std::ranges::lower_bound(before, effect.id, {}, &EffectKeyframe::id);
    if (old == before.end() || !(*old == effect)) changed.push_back(&effect);
  }
  writer.put_varint(changed.size());
  IdGaps gaps;
  for (const auto* effect : changed) {
    writer.put_varint(gaps.before(effect->id));
    writer.put(effect->kind);
    writer.put_varint(tick + max_effect_lead_ticks - effect->tick);
    writer.put_varint(effect->data.size());
    writer.put_bytes(effect->data);
  }
}

void read_effects(ByteReader& reader, std::vector<EffectKeyframe>& effects, Tick tick) {
  remove_ids(reader, effects, max_wire_effects);
  const std::size_t count = reader.get_count(max_wire_effects);
  IdReader ids;
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    EffectKeyframe effect;
    effect.id = ids.get(reader);
    effect.kind = reader.get<std::uint16_t>();
    const Tick newest = tick + max_effect_lead_ticks, age = reader.get_varint();
    if (newest < tick || age > newest) return reader.fail();
    effect.tick = newest - age;
    const auto data = reader.take(reader.get_count(max_wire_effect_bytes));
    effect.data.assign(data.begin(), data.end());
    const auto place = std::ranges::lower_bound(effects, effect.id, {}, &EffectKeyframe::id);
    if (place != effects.end() && place->id == effect.id)
      *place = std::move(effect);
    else
      effects.insert(place, std::move(effect));
  }
  std::size_t bytes = 0;
  for (const auto& effect : effects) bytes += effect.data.size();
  if (effects.size() > max_wire_effects || bytes > max_wire_effect_bytes) reader.fail();
}

SnapshotHeader read_header(ByteReader& reader, std::uint8_t& flags) {
  if (reader.get<std::uint8_t>() != format_version) reader.fail();
  flags = reader.get<std::uint8_t>();
  if (flags & ~(flag_has_baseline | flag_environment | flag_game | flag_head)) reader.fail();
  SnapshotHeader header;
  header.tick = reader.get_varint();
  if (flags & flag_has_baseline) {
    const std::uint64_t age = reader.get_varint();
    if (age == 0 || age > header.tick) reader.fail();
    header.baseline = header.tick - age;
  }
  return header;
}

auto refused(std::string what) {
  return failure(std::move(what), "snapshot", "the sender runs another version of Septet, or the bytes are damaged");
}

}  // namespace

double seconds_since(const WireSnapshot& baseline, double time_s) {
  return std::clamp(time_s - baseline.rest.simulated_time_s, 0.0, 1.0);
}

WireSnapshot to_wire(const Snapshot& snapshot, WireSnapshot old) {
  SEPTET_CHECK(snapshot.participants.size() <= max_wire_participants, "{} participants", snapshot.participants.size());
  WireSnapshot wire = std::move(old);
  wire.participants.clear();
  wire.participants.reserve(snapshot.participants.size());
  for (std::size_t i = 0; i < snapshot.participants.size(); ++i) {
    const Participant& participant = snapshot.participants[i];
    SEPTET_CHECK(i == 0 || snapshot.participants[i - 1].id < participant.id, "participant {} after {}", participant.id,
                 snapshot.participants[i - 1].id);
    quantise(participant, wire.participants.emplace_back());
  }
  wire.rest.tick = snapshot.tick;
  wire.rest.simulated_time_s = snapshot.simulated_time_s;
  wire.rest.state_hash = snapshot.state_hash;
  wire.rest.environment = snapshot.environment;
  wire.rest.driver_car = snapshot.driver_car;
  for (const EffectKeyframe& effect : snapshot.effects)
    SEPTET_CHECK(effect.tick <= snapshot.tick + max_effect_lead_ticks, "effect {} of tick {} at tick {}", effect.id,
                 effect.tick, snapshot.tick);
  wire.rest.effects = snapshot.effects;
  wire.rest.diagnostics = snapshot.diagnostics;
  wire.rest.game = snapshot.game;
  return wire;
}

Snapshot from_wire(const WireSnapshot& wire) {
  Snapshot snapshot = wire.rest;
  snapshot.participants.reserve(wire.participants.size());
  for (const auto& participant : wire.participants) snapshot.participants.push_back(dequantise(participant));
  return snapshot;
}

namespace {
enum class Participants : std::uint8_t { told, as_expected };

void encode(const WireSnapshot& wire, const WireSnapshot* baseline, Participants participants, Bytes& out) {
  SEPTET_CHECK(!baseline || baseline->rest.tick < wire.rest.tick, "tick {} against {}", wire.rest.tick,
               baseline ? baseline->rest.tick : 0);
  const Snapshot& rest = wire.rest;
  const bool environment = !baseline || !(baseline->rest.environment == rest.environment);
  ByteWriter writer(out);
  writer.put(format_version);
  writer.put(static_cast<std::uint8_t>((baseline ? flag_has_baseline : 0) | (environment ? flag_environment : 0) |
                                       (rest.game ? flag_game : 0) | (rest.driver_car.head != Head{} ? flag_head : 0)));
  writer.put_varint(rest.tick);
  if (baseline) writer.put_varint(rest.tick - baseline->rest.tick);
  writer.put(rest.simulated_time_s);
  writer.put(rest.state_hash);
  if (environment) visit_environment(rest.environment, [&](double value) { writer.put(value); });

  const DriverCar& car = rest.driver_car;
  writer.put_varint(car.participant);
  writer.put_signed_varint(car.gear);
  writer.put_varint(car.road);
  writer.put_signed_varint(car.lane);
  visit_driver_car(car, [&](double value) { writer.put(value); });
  writer.put_varint(rest.diagnostics.bad_numbers);
  writer.put_varint(rest.diagnostics.collisions);
  writer.put_varint(rest.diagnostics.input_stale_ticks);
  if (rest.game) put_game(writer, *rest.game);
  if (car.head != Head{}) put_head(writer, car.head);

  if (participants == Participants::told)
    put_participants(writer, baseline, wire);
  else
    writer.put_bytes(std::array<std::byte, 2>{});  // No participant removed, none changed.
  static const std::vector<EffectKeyframe> no_effects;
  put_effects(writer, baseline ? baseline->rest.effects : no_effects, rest.effects, rest.tick);
}
}  // namespace

void encode_snapshot(const WireSnapshot& wire, const WireSnapshot* baseline, Bytes& out) {
  encode(wire, baseline, Participants::told, out);
}

void encode_without_participants(const WireSnapshot& wire, const WireSnapshot* baseline, Bytes& out) {
  encode(wire, baseline, Participants::as_expected, out);
}

Expected<SnapshotHeader> read_snapshot_header(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  std::uint8_t flags = 0;
  const SnapshotHeader header = read_header(reader, flags);
  if (!reader.ok()) return refused("unreadable header");
  return header;
}

Expected<WireSnapshot> decode_snapshot(std::span<const std::byte> bytes, const WireSnapshot* baseline) {
  ByteReader reader(bytes);
  std::uint8_t flags = 0;
  const SnapshotHeader header = read_header(reader, flags);
  if (!reader.ok()) return refused("unreadable header");
  if (header.baseline.has_value() != (baseline != nullptr) || (baseline && baseline->rest.tick != *header.baseline))
    return refused("the difference refers to a snapshot that is not at hand");

  WireSnapshot wire;
  Snapshot& rest = wire.rest;
  rest.tick = header.tick;
  rest.simulated_time_s = get_finite(reader);
  rest.state_hash = reader.get<std::uint64_t>();
  if (flags & flag_environment)
    visit_environment(rest.environment, [&](double& value) { value = get_finite(reader); });
  else if (baseline)
    rest.environment = baseline->rest.environment;
  else
    return refused("a keyframe without an environment");

  DriverCar& car = rest.driver_car;
  car.participant = static_cast<ParticipantId>(reader.get_count(0xffffffffu));
  car.gear = static_cast<std::int8_t>(std::clamp<std::int64_t>(reader.get_signed_varint(), -1, 20));
  car.road = static_cast<std::uint32_t>(reader.get_count(0xffffffffu));
  car.lane = static_cast<std::int32_t>(std::clamp<std::int64_t>(reader.get_signed_varint(), -1000, 1000));
  visit_driver_car(car, [&](double& value) { value = get_finite(reader); });
  rest.diagnostics.bad_numbers = static_cast<std::uint32_t>(reader.get_count(0xffffffffu));
  rest.diagnostics.collisions = static_cast<std::uint32_t>(reader.get_count(0xffffffffu));
  rest.diagnostics.input_stale_ticks = static_cast<std::uint32_t>(reader.get_count(0xffffffffu));
  if (flags & flag_game) rest.game = get_game(reader);
  if (flags & flag_head) car.head = get_head(reader);

  wire.participants = expected_participants(baseline, rest.simulated_time_s);
  read_participants(reader, wire.participants);
  if (baseline) rest.effects = baseline->rest.effects;
  read_effects(reader, rest.effects, rest.tick);
  if (!reader.ok() || !reader.at_end()) return refused(fmt::format("malformed contents of tick {}", header.tick));
  return wire;
}

}  // namespace septet
