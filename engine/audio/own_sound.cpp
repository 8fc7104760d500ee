#include "engine/audio/own_sound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/audio/engine_orders.hpp"
#include "engine/audio/horn.hpp"
#include "engine/audio/levels.hpp"

namespace septet::audio {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double line_profile_m = 0.3048, wheel_hop_hz = 13.0;

/// Spectrum of each layer's noise, computed once.
struct Shapes {
  Shape mechanical{Section::band_pass(900.0, 0.5), Section::low_pass(3000.0, 0.7)};
  Shape intake{Section::band_pass(350.0, 0.6), Section::low_pass(1200.0, 0.7)};
  // Heard through the body: airborne sound has its most at 1 kHz before it (CNOSSOS), structure-borne sound below 250
  // Hz.
  Shape tyre_air{Section::band_pass(1000.0, 0.6), Section::low_pass(400.0, 0.5)};
  Shape tyre_structure{Section::band_pass(110.0, 0.6), Section::low_pass(250.0, 0.7)};
  Shape spray{Section::high_pass(1800.0, 0.7), Section::low_pass(6000.0, 0.7)};
  Shape gravel{Section::band_pass(450.0, 0.5), Section::low_pass(2500.0, 0.7)};
  Shape skid{Section::band_pass(1050.0, 5.0), Section::band_pass(1200.0, 2.0)};
  Shape wind{Section::low_pass(260.0, 0.4), Section::high_pass(50.0, 0.7)};
  Shape rain_hiss{Section::high_pass(1000.0, 0.7), Section::low_pass(5000.0, 0.7)};
  Shape low_road{Section::low_pass(35.0, 0.7), Section::high_pass(8.0, 0.7)};
};
const Shapes& shapes() {
  static const Shapes all;
  return all;
}

double towards(double from, double to, double seconds) {
  return from + (to - from) * (1.0 - std::exp(-block_s / seconds));
}
double power_db(double level, double share) { return level + 10.0 * std::log10(share); }
/// 0 below `least` to 1 above `most`, smooth.
double rising(double value, double least, double most) {
  const double t = std::clamp((value - least) / (most - least), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Harmonics single(double pressure) {
  Harmonics harmonics{};
  harmonics[0] = static_cast<float>(std::numbers::sqrt2 * pressure);
  return harmonics;
}

void render_engine(OwnState& state, const CarSound& car, const OwnCar& heard, Block& front, Block& rear) {
  state.gain = towards(state.gain, heard.running ? 1.0 : 0.0, 0.05);
  if (state.gain < 1e-4) state.gain = heard.running ? 1e-4 : 0.0;
  // An engine that stops keeps its last tone while it fades.
  if (heard.running)
    state.engine_hz = state.engine_hz > 0.0 ? towards(state.engine_hz, heard.engine_hz, 0.01) : heard.engine_hz;
  if (state.gain == 0.0) state.engine_hz = 0.0;
  state.load = towards(state.load, heard.load, 0.08);
  state.fuel_cut = towards(state.fuel_cut, heard.fuel_cut ? 1.0 : 0.0, 0.08);
  const double hz = std::max(state.engine_hz, 3.0);
  const EngineOrders orders = engine_orders(car.cylinders, hz, state.load, state.fuel_cut, state.gain);
  add_harmonics({&state.front_orders, &state.rear_orders}, 0.5 * hz, {&orders.front, &orders.rear}, most_harmonics,
                {&front, &rear});
  const double noise_db = engine_noise_db(hz, state.load, state.fuel_cut > 0.5);
  add_noise(state.mechanical, shapes().mechanical, state.gain * shapes().mechanical.gain(noise_db), front);
  add_noise(state.intake, shapes().intake, state.gain * shapes().intake.gain(intake_db(hz, state.load)), front);

  // Twenty teeth before the final drive.
  const double mesh_hz = heard.wheel_hz * car.final_ratio * 20.0;
  const double speed = std::abs(heard.speed_mps);
  const double whine_db = gear_whine_at_100_kmh_db + 20.0 * std::log10(std::max(speed, 0.1) / reference_speed_mps) +
                          (heard.reversing ? reverse_whine_more_db : 0.0);
  add_harmonics(state.whine, std::max(mesh_hz, 1.0), single(std::min(1.0, speed) * pressure_pa(whine_db)), 1, front);
}

void render_tyres(OwnState& state, const OwnCar& heard, const std::array<Block*, 4>& out) {
  const Shapes& all = shapes();
  const double speed = std::abs(heard.speed_mps), moving = std::min(1.0, speed);
  const double paved = 1.0 - heard.looseness;
  const double level = power_db(rolling_inside_db(speed), 0.25) - 5.0 * heard.snow;
  const auto add = [&](NoiseLayer OwnState::Tyre::*layer, const Shape& shape, const std::array<double, 4>& gains) {
    std::array<NoisePart, 4> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = {&(state.tyres[i].*layer), gains[i], out[i]};
    add_noises(parts, shape);
  };
  const auto add_alike = [&](NoiseLayer OwnState::Tyre::*layer, const Shape& shape, double gain) {
    add(layer, shape, {gain, gain, gain, gain});
  };
  using Tyre = OwnState::Tyre;
  add_alike(&Tyre::air, all.tyre_air, moving * all.tyre_air.gain(power_db(level, 0.8) - 6.0 * heard.snow));
  add_alike(&Tyre::structure, all.tyre_structure,
            moving * all.tyre_structure.gain(power_db(level, 0.2) + 6.0 * heard.looseness));
  add_alike(&Tyre::spray, all.spray, moving * heard.wetness * all.spray.gain(level - 2.0));
  add_alike(&Tyre::gravel, all.gravel, moving * heard.looseness * all.gravel.gain(level + 7.0));
  // A tyre on dry asphalt has its most force at a slip of 0.1 to 0.17; beyond, it slides.
  const auto skidding = [&](double slip) {
    return rising(slip, 0.14, 0.40) * rising(speed, 1.0, 5.0) * paved * (1.0 - 0.7 * heard.wetness) *
           (1.0 - heard.snow) * all.skid.gain(power_db(skid_db, 0.25));
  };
  const double front = skidding(heard.front_slip), rear = skidding(heard.rear_slip);
  add(&Tyre::skid, all.skid, {front, front, rear, rear});
}

void render_wind(OwnState& state, const OwnCar& heard, std::size_t side, Block& out) {
  NoiseLayer& layer = state.wind[side];
  // Gusts: a slow wander of a decibel or two.
  double& gust = state.gust[side];
  gust += (layer.noise.next() - gust) * 0.02;
  const double calm = rising(heard.air_mps, 0.5, 3.0);
  const double level = power_db(wind_inside_db(heard.air_mps), 0.5) + std::clamp(8.0 * gust, -1.5, 1.5);
  add_noise(layer, shapes().wind, calm * shapes().wind.gain(level), out);
}

/// Drops of rain strike the roof at random instants and make its modes ring.
void render_rain(OwnState& state, const OwnCar& heard, Block& out) {
  static const std::array<Section, 3> modes{Section::band_pass(190.0, 6.0), Section::band_pass(340.0, 7.0),
                                            Section::band_pass(640.0, 8.0)};
  constexpr double drops_per_s_and_mm_per_h = 60.0;
  const double rate = heard.rain_mm_per_h * drops_per_s_and_mm_per_h / sample_rate_hz;
  const double share = std::min(1.0, heard.rain_mm_per_h / 0.5);
  const double level = rain_at_15_mm_per_h_db + 10.0 * std::log10(std::max(heard.rain_mm_per_h, 0.01) / 15.0);
  add_noise(state.rain_hiss, shapes().rain_hiss, share * shapes().rain_hiss.gain(level - 4.0), out);
  // Each drop's impulse has this size so that all together have the level.
  const double size = rate > 0.0 ? share * pressure_pa(level + 12.0) * std::sqrt(1.0 / std::max(rate, 1e-6)) : 0.0;
  if (rate == 0.0 && state.drop_rate == 0.0) return;
  state.drop_rate = rate;
  state.drop_pressure = size;
  for (float& sample : out) {
    const float chance = state.drops.next() * (0.5f / 1.7320508f) + 0.5f;
    const float impulse = double(chance) < rate ? static_cast<float>(size) * state.drops.next() * 0.3f : 0.0f;
    for (std::size_t i = 0; i < modes.size(); ++i) sample += state.roof[i].step(modes[i], impulse);
  }
}

void render_relay(OwnState& state, const OwnCar& heard, Block& out) {
  if (heard.indicator_lit != state.was_lit) {
    state.was_lit = heard.indicator_lit;
    state.relay.strike(2.0 * pressure_pa(relay_db));
    state.relay_hz = heard.indicator_lit ? 2300.0 : 1750.0;
  }
  if (state.relay.is_over()) return;
  static const float attack = attack_of(0.0006), decay = decay_of(0.003);
  for (float& sample : out) {
    state.relay_phase += state.relay_hz / sample_rate_hz;
    sample += state.relay.step(attack, decay) * static_cast<float>(std::sin(turn * state.relay_phase));
  }
  state.relay_phase -= std::floor(state.relay_phase);
}

void render_crash(OwnState& state, const OwnCar& heard, Block& out, Block& low) {
  static const Section body = Section::low_pass(1800.0, 0.7), glass = Section::band_pass(4500.0, 0.8),
                       clatter = Section::band_pass(1600.0, 1.5);
  static const Section thump = Section::low_pass(60.0, 0.8);
  if (heard.blow_mps > 0.0) {
    const double level = std::min(blow_at_1_mps_db + 20.0 * std::log10(heard.blow_mps), most_blow_db);
    state.blow.strike(4.0 * pressure_pa(level));  // White noise loses much of its power in the low pass.
    if (heard.blow_mps > 4.0) state.glass.strike(pressure_pa(level - 6.0));
  }
  if (heard.pieces > 0)
    state.pieces.strike(2.0 * pressure_pa(std::min(piece_db + 10.0 * std::log10(heard.pieces), 94.0)));
  if (state.blow.is_over() && state.glass.is_over() && state.pieces.is_over()) return;
  static const float attack = attack_of(0.003), blow_decay = decay_of(0.12), glass_attack = attack_of(0.012),
                     glass_decay = decay_of(0.25), piece_decay = decay_of(0.06);
  for (std::size_t i = 0; i < block_samples; ++i) {
    const float noise = state.sparks.next();
    const float blow = state.blow.step(attack, blow_decay) * noise;
    out[i] += state.blow_filter.step(body, blow);
    out[i] += state.glass_filter.step(glass, state.glass.step(glass_attack, glass_decay) * noise);
    out[i] += state.pieces_filter.step(clatter, state.pieces.step(attack, piece_decay) * noise);
    low[i] += 3.0f * state.low_blow.step(thump, blow);
  }
}

/// Vibration: the firing order, the wheels' turning, the road, below 120 Hz and above 5 Hz.
void render_low(OwnState& state, const CarSound& car, const OwnCar& heard, Block& out) {
  static const Section upper = Section::low_pass(120.0, 0.54), steeper = Section::low_pass(120.0, 1.31);
  const double firing =
      state.gain * pressure_pa(firing_order_db(std::max(state.engine_hz, 3.0), state.load, false) - 3.0);
  add_harmonics(state.low_orders, std::max(state.engine_hz * car.cylinders / 2.0, 1.0), single(firing), 1, out);
  const double speed = std::abs(heard.speed_mps);
  // A good road at 30 m/s is the reference; the worst that is played is ten times that.
  const double moving = std::min(speed, 60.0);
  const double unevenness = heard.looseness > 0.0 ? std::max(heard.ground.unevenness_m3, class_e_m3)
                                                  : std::clamp(heard.ground.unevenness_m3, 0.0, class_e_m3);
  const double rolling = std::min(
      ground_velocity_mps(unevenness, moving, 8.0, 35.0) / ground_velocity_mps(class_a_m3, 30.0, 8.0, 35.0), 10.0);
  add_harmonics(state.low_wheel, std::max(heard.wheel_hz, 1.0), single(0.02 * std::sqrt(moving / 30.0)), 1, out);
  add_noise(state.low_road, shapes().low_road, 2.0 * rolling, out);
  // Lines are profiled every 0.3 m (a milled strip's 12 inches).
  add_harmonics(state.low_line, std::max(moving / line_profile_m, 1.0),
                single(heard.ground.on_line ? 0.08 * std::min(1.0, moving / 5.0) : 0.0), 1, out);
  // A struck wheel hops on its tyre, at some 13 Hz.
  static const float attack = attack_of(0.003), decay = decay_of(0.09);
  if (heard.bump_mps > 0.0) {
    if (state.bump.is_over()) state.bump_phase = 0.0;
    state.bump.strike(std::min(1.2 * heard.bump_mps, 0.8));
  }
  if (!state.bump.is_over())
    for (float& sample : out) {
      state.bump_phase += wheel_hop_hz / sample_rate_hz;
      sample += state.bump.step(attack, decay) * static_cast<float>(std::sin(turn * state.bump_phase));
    }
  state.bump_phase -= std::floor(state.bump_phase);
  for (float& sample : out) sample = state.low_second.step(steeper, state.low_first.step(upper, sample));
}

}  // namespace

void render_own(OwnState& state, const CarSound& car, const OwnCar& heard, std::vector<Voice>& voices) {
  const Vec3 ear = car.ear_m;
  const double front_x = car.wheelbase_m - ear.x, rear_x = -ear.x, left_y = 0.75 - ear.y, right_y = -0.75 - ear.y,
               wheel_z = 0.2 - ear.z;
  const auto voice = [&](OwnVoice which, const Vec3& position_m, float echo) -> Block& {
    Voice& one = voices[static_cast<std::size_t>(which)];
    one = {.key = static_cast<std::uint64_t>(which), .position_m = position_m, .is_near = true, .echo = echo};
    return one.samples;
  };
  Block& engine = voice(OwnVoice::engine, {1.9, -ear.y, -0.4}, 0.2f);
  Block& exhaust = voice(OwnVoice::exhaust, {-2.4, -ear.y, -0.8}, 0.6f);
  render_engine(state, car, heard, engine, exhaust);
  render_wind(state, heard, 0, voice(OwnVoice::wind_left, {0.5, 0.5, 0.1}, 0.0f));
  render_wind(state, heard, 1, voice(OwnVoice::wind_right, {0.5, -1.1, 0.1}, 0.0f));
  render_tyres(state, heard,
               {&voice(OwnVoice::front_left, {front_x, left_y, wheel_z}, 0.5f),
                &voice(OwnVoice::front_right, {front_x, right_y, wheel_z}, 0.5f),
                &voice(OwnVoice::rear_left, {rear_x, left_y, wheel_z}, 0.5f),
                &voice(OwnVoice::rear_right, {rear_x, right_y, wheel_z}, 0.5f)});
  render_rain(state, heard, voice(OwnVoice::rain, {0.0, -ear.y, 0.5}, 0.0f));
  render_relay(state, heard, voice(OwnVoice::relay, {0.7, 0.0, -0.3}, 0.0f));
  add_horn(state.horn_low, state.horn_high, heard.horn ? horn_pressure(own_horn_db) : 0.0, 1.0,
           voice(OwnVoice::horn, {2.3, -ear.y, -0.6}, 1.0f));
  Block& crash = voice(OwnVoice::crash, {1.5, -ear.y, -0.3}, 0.3f);
  Block& low = voice(OwnVoice::low, {1.0, 0.0, 0.0}, 0.0f);
  voices[static_cast<std::size_t>(OwnVoice::low)].is_low = true;
  render_low(state, car, heard, low);
  render_crash(state, heard, crash, low);
  Ramp share(state.low_share, heard.low_share);
  for (float& sample : low) sample *= share.next();
  state.low_share = heard.low_share;
}

}  // namespace septet::audio
