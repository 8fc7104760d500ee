#include "engine/world/participant_quantisation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <glm/gtc/constants.hpp>

namespace septet {
namespace {

// Steps are powers of two, so that an integer and its value convert to each other exactly.
constexpr double position_per_m = 4096.0;
constexpr double velocity_per_mps = 1024.0;
constexpr double acceleration_per_mps2 = 256.0;
constexpr double angular_velocity_per_radps = 16384.0;
constexpr double angle_per_rad = 16384.0;
constexpr double spin_rate_per_radps = 64.0;
constexpr double spin_steps = 65536.0;                 // of one turn
constexpr double orientation_steps = (1 << 19) - 1.0;  // of 1/√2, either sign

/// Rounds half away from zero as llround, without the call: the largest number below one half does not carry an integer
/// over. Empty for NaN, or a value beyond every field of the wire.
std::int64_t rounded(double value) {
  if (!(std::abs(value) < 0x1p62)) return 0;
  return static_cast<std::int64_t>(value + std::copysign(0.49999999999999994, value));
}

/// Magnitude at which doubles lie one apart: a number added to it is rounded to an integer (half to even) in the sum's
/// last 32 bits.
constexpr double unit_steps = 0x1.8p52;

constexpr std::int32_t limit(double value) { return static_cast<std::int32_t>(value); }

constexpr std::array<FieldLimits, participant_field_count> make_limits() {
  std::array<FieldLimits, participant_field_count> limits{};
  const auto set = [&](std::size_t first, std::size_t last, std::int32_t low, std::int32_t high) {
    for (std::size_t i = first; i <= last; ++i) limits[i] = {low, high};
  };
  set(field_model, field_model, 0, 65535);
  set(field_paint, field_paint, 0, 255);
  set(field_lamps, field_lamps, 0, 65535);
  set(field_position_x, field_position_z, -limit(524288.0 * position_per_m - 1.0),
      limit(524288.0 * position_per_m - 1.0));
  set(field_largest, field_largest, 0, 3);
  set(field_orientation_a, field_orientation_c, -limit(orientation_steps), limit(orientation_steps));
  set(field_velocity_x, field_velocity_z, -limit(1024.0 * velocity_per_mps), limit(1024.0 * velocity_per_mps));
  set(field_acceleration_x, field_acceleration_z, -limit(8192.0 * acceleration_per_mps2),
      limit(8192.0 * acceleration_per_mps2));
  set(field_angular_velocity_x, field_angular_velocity_z, -limit(1024.0 * angular_velocity_per_radps),
      limit(1024.0 * angular_velocity_per_radps));
  set(field_front_steer, field_front_steer, -limit(4.0 * angle_per_rad), limit(4.0 * angle_per_rad));
  set(field_wheel_spin, field_wheel_spin, 0, limit(spin_steps) - 1);
  set(field_wheel_spin_rate, field_wheel_spin_rate, -limit(4096.0 * spin_rate_per_radps),
      limit(4096.0 * spin_rate_per_radps));
  set(field_lift_front_left, field_lift_rear_right, -limit(16.0 * position_per_m), limit(16.0 * position_per_m));
  return limits;
}
constexpr auto limits_of_field = make_limits();

/// Fields in a row: steps per unit, and the limits as doubles.
template <std::size_t count>
struct FieldRow {
  std::array<double, count> steps, lowest, highest;
};
template <std::size_t count>
constexpr FieldRow<count> make_row(std::size_t first, const std::array<double, count>& steps) {
  FieldRow<count> row{.steps = steps};
  for (std::size_t i = 0; i < count; ++i) {
    row.lowest[i] = static_cast<double>(limits_of_field[first + i].low);
    row.highest[i] = static_cast<double>(limits_of_field[first + i].high);
  }
  return row;
}
/// Four are as cheap as three: the fourth value is overwritten by the field that follows.
constexpr auto position_row = make_row<4>(field_position_x, {position_per_m, position_per_m, position_per_m, 0.0});
/// All four components, of which three travel; scaled with the sign of the largest already.
constexpr FieldRow<4> orientation_row{
    .steps = {1.0, 1.0, 1.0, 1.0},
    .lowest = {-orientation_steps, -orientation_steps, -orientation_steps, -orientation_steps},
    .highest = {orientation_steps, orientation_steps, orientation_steps, orientation_steps}};
/// Fields from the velocity on; the wheels' angle is written separately.
constexpr auto motion_row = make_row<participant_field_count - field_velocity_x>(
    field_velocity_x,
    {velocity_per_mps, velocity_per_mps, velocity_per_mps, acceleration_per_mps2, acceleration_per_mps2,
     acceleration_per_mps2, angular_velocity_per_radps, angular_velocity_per_radps, angular_velocity_per_radps,
     angle_per_rad, 0.0, spin_rate_per_radps, position_per_m, position_per_m, position_per_m, position_per_m});

/// Rounds doubles in a row at `numbers`. A value out of bounds is clamped, NaN is sent as zero: the drive goes on,
/// Diagnostics counts it at its source. Branch-free, so that the compiler vectorises it.
template <std::size_t count>
inline void put_fields(const std::byte* numbers, const FieldRow<count>& row, std::int32_t* fields) {
  for (std::size_t i = 0; i < count; ++i) {
    double value;
    std::memcpy(&value, numbers + i * sizeof value, sizeof value);
    const double scaled = value * row.steps[i];
    const double finite = scaled - scaled == 0.0 ? scaled : 0.0;
    const double above = finite > row.lowest[i] ? finite : row.lowest[i];
    const double bounded = above < row.highest[i] ? above : row.highest[i];
    fields[i] = static_cast<std::int32_t>(std::bit_cast<std::int64_t>(bounded + unit_steps));
  }
}

// A participant's numbers lie in memory as their fields do on the wire. They are read in place: a copy made of single
// numbers and read as vectors would have to wait for the copy.
static_assert(offsetof(Participant, velocity_mps) + sizeof motion_row.steps ==
              offsetof(Participant, wheel_lift_m) + sizeof(Participant::wheel_lift_m));
static_assert(offsetof(Participant, velocity_mps) + (field_front_steer - field_velocity_x) * sizeof(double) ==
              offsetof(Participant, front_steer_rad));

}  // namespace

const FieldLimits& participant_field_limits(std::size_t field) { return limits_of_field[field]; }

void quantise(const Participant& participant, WireParticipant& wire) {
  std::int32_t* fields = wire.fields.data();
  wire.id = participant.id;
  fields[field_model] = participant.model;
  fields[field_paint] = participant.paint;
  fields[field_lamps] = participant.lamps.bits;
  const auto* bytes = reinterpret_cast<const std::byte*>(&participant);
  put_fields(bytes + offsetof(Participant, world_from_vehicle), position_row, fields + field_position_x);

  // Smallest three: the largest component follows from the unit length and is made positive.
  const Quat& orientation = participant.world_from_vehicle.orientation;
  const double q[] = {orientation.w, orientation.x, orientation.y, orientation.z};
  const int first = std::abs(q[1]) > std::abs(q[0]) ? 1 : 0, second = std::abs(q[3]) > std::abs(q[2]) ? 3 : 2;
  const int largest = std::abs(q[second]) > std::abs(q[first]) ? second : first;
  const double scale = std::copysign(glm::root_two<double>() * orientation_steps, q[largest]);
  fields[field_largest] = largest;
  const double scaled[] = {scale * q[0], scale * q[1], scale * q[2], scale * q[3]};
  std::int32_t components[4];
  put_fields(reinterpret_cast<const std::byte*>(scaled), orientation_row, components);
  for (int i = 0; i < 3; ++i)
    fields[field_orientation_a + static_cast<std::size_t>(i)] = components[i + (i >= largest ? 1 : 0)];

  put_fields(bytes + offsetof(Participant, velocity_mps), motion_row, fields + field_velocity_x);
  const double turns = participant.wheel_spin_rad * (0.5 / glm::pi<double>());
  // A hair below a whole turn rounds to one.
  const double steps = std::floor((turns - std::floor(turns)) * spin_steps);
  fields[field_wheel_spin] = steps < spin_steps ? static_cast<std::int32_t>(steps) : 0;
}

Participant dequantise(const WireParticipant& wire) {
  const auto value = [&](std::size_t field, double scale) { return static_cast<double>(wire.fields[field]) / scale; };
  const auto vector = [&](std::size_t field, double scale) {
    return Vec3(value(field, scale), value(field + 1, scale), value(field + 2, scale));
  };
  Participant participant;
  participant.id = wire.id;
  participant.model = static_cast<ModelIndex>(wire.fields[field_model]);
  participant.paint = static_cast<std::uint8_t>(wire.fields[field_paint]);
  participant.lamps.bits = static_cast<std::uint16_t>(wire.fields[field_lamps]);
  participant.world_from_vehicle.position_m = vector(field_position_x, position_per_m);
  participant.velocity_mps = vector(field_velocity_x, velocity_per_mps);
  participant.acceleration_mps2 = vector(field_acceleration_x, acceleration_per_mps2);
  participant.angular_velocity_radps = vector(field_angular_velocity_x, angular_velocity_per_radps);
  participant.front_steer_rad = value(field_front_steer, angle_per_rad);
  participant.wheel_spin_rad = value(field_wheel_spin, spin_steps) * 2.0 * glm::pi<double>();
  participant.wheel_spin_radps = value(field_wheel_spin_rate, spin_rate_per_radps);
  for (std::size_t i = 0; i < 4; ++i) participant.wheel_lift_m[i] = value(field_lift_front_left + i, position_per_m);

  const Vec3 small = vector(field_orientation_a, orientation_steps * glm::root_two<double>());
  const double large = std::sqrt(std::max(0.0, 1.0 - glm::dot(small, small)));
  std::array<double, 4> q{};
  int next = 0;
  for (std::size_t i = 0; i < 4; ++i)
    q[i] = i == static_cast<std::size_t>(wire.fields[field_largest]) ? large : small[next++];
  participant.world_from_vehicle.orientation = glm::normalize(Quat(q[0], q[1], q[2], q[3]));
  return participant;
}

WireParticipant extrapolate(const WireParticipant& wire, double seconds) {
  WireParticipant result = wire;
  const double half_square = 0.5 * seconds * seconds;
  const auto advance = [&](std::size_t field, double step) {
    const auto [low, high] = limits_of_field[field];
    result.fields[field] =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(wire.fields[field] + rounded(step), low, high));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto velocity = static_cast<double>(wire.fields[field_velocity_x + i]);
    const auto acceleration = static_cast<double>(wire.fields[field_acceleration_x + i]);
    advance(field_position_x + i, velocity * seconds * (position_per_m / velocity_per_mps) +
                                      acceleration * half_square * (position_per_m / acceleration_per_mps2));
    advance(field_velocity_x + i, acceleration * seconds * (velocity_per_mps / acceleration_per_mps2));
  }
  const auto spin_rate = static_cast<double>(wire.fields[field_wheel_spin_rate]) / spin_rate_per_radps;
  const auto turned = rounded(spin_rate * seconds / (2.0 * glm::pi<double>()) * spin_steps);
  // A turn is a power of two: the low bits are the remainder, of negative sums too.
  result.fields[field_wheel_spin] =
      static_cast<std::int32_t>((wire.fields[field_wheel_spin] + turned) & (static_cast<std::int64_t>(spin_steps) - 1));
  return result;
}

}  // namespace septet
