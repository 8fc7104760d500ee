/// Each shipped scenario, saved in the middle and restored into a freshly loaded drive, goes on unchanged.

#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/hash.hpp"
#include "engine/core/random.hpp"
#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/physics/impact/pulse.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/world/vehicle_body.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "tests/checkout.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {
namespace {

/// A drive by its inputs: those of a simulated driver, which no state holds, are taken down while he drives.
struct Drive {
  server::LoadedDrive loaded;
  State state;
  std::vector<Event> events;

  Snapshot step(const DriverInput& input) { return server_step(*loaded.model, input, state, events); }
};

Drive begin(const std::string& scenario, std::uint64_t seed) {
  server::LoadedDrive loaded = server::shipped_drive(scenario, "seven-screens", seed);
  auto state = initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, seed));
  REQUIRE(state.has_value());
  return {std::move(loaded), std::move(*state), {}};
}

Expected<State> restored(const Model& model, std::span<const std::byte> bytes) {
  return restore_state(model, traffic::own_traffic(model.roads, model.seed), bytes, "test");
}

std::size_t keyframes(const Snapshot& snapshot, std::uint16_t kind) {
  return static_cast<std::size_t>(std::ranges::count(snapshot.effects, kind, &EffectKeyframe::kind));
}

struct SavedDrive {
  Tick at = 0;
  std::uint64_t hash = 0;  ///< Of its snapshot.
  Bytes bytes;
  std::size_t smoke = 0, debris = 0;  ///< Keyframes at that tick.
  std::vector<DriverInput> inputs;    ///< After it.
  std::vector<std::uint64_t> hashes;
  Bytes end;  ///< Saved after the last of them.
};

/// Saves at each of `at`; each is driven on for four seconds.
std::vector<SavedDrive> drive_and_save(const std::string& scenario, const std::string& driver, std::uint64_t seed,
                                       std::vector<Tick> at) {
  constexpr Tick further = 480;
  Drive drive = begin(scenario, seed);
  auto seat = server::open_driver_seat(rig::Car{.driver = driver}, seed, drive.loaded.model);
  REQUIRE(seat.has_value());
  std::vector<SavedDrive> saved;
  Snapshot now = capture_snapshot(*drive.loaded.model, drive.state);
  while (now.tick <= at.back() + further) {
    for (SavedDrive& each : saved)
      if (now.tick == each.at + further) each.end = *save_state(*drive.loaded.model, drive.state);
    if (std::ranges::find(at, now.tick) != at.end()) {
      auto bytes = save_state(*drive.loaded.model, drive.state);
      REQUIRE(bytes.has_value());
      MESSAGE(scenario << " tick " << now.tick << ": " << bytes->size() << " bytes");
      saved.push_back({now.tick, now.state_hash, std::move(*bytes), keyframes(now, smoke::keyframe_kind),
                       keyframes(now, debris::keyframe_kind)});
    }
    for (const auto& device : seat->devices) device->see(now, {});
    const DriverInput input = seat->car->poll(drive.state.time_s()).input;
    now = drive.step(input);
    for (SavedDrive& each : saved) {
      if (now.tick > each.at + further) continue;
      each.inputs.push_back(input);
      each.hashes.push_back(now.state_hash);
    }
  }
  return saved;
}

void check_that_it_goes_on(const std::string& scenario, std::uint64_t seed, const SavedDrive& saved) {
  INFO(scenario << " seed " << seed << " tick " << saved.at);
  const server::LoadedDrive fresh = server::shipped_drive(scenario, "seven-screens", seed);
  auto state = restored(*fresh.model, saved.bytes);
  REQUIRE_MESSAGE(state.has_value(), why_not(state));
  CHECK(*save_state(*fresh.model, *state) == saved.bytes);
  CHECK(hash_state(*state) == saved.hash);
  std::vector<Event> events;
  std::vector<std::uint64_t> hashes;
  for (const DriverInput& input : saved.inputs)
    hashes.push_back(server_step(*fresh.model, input, *state, events).state_hash);
  CHECK(hashes == saved.hashes);
  // More than the hash: everything that is kept.
  CHECK(*save_state(*fresh.model, *state) == saved.end);
}

/// With its last word made the hash of the rest again, as by an attacker.
void sign(Bytes& bytes) {
  StateHash hash;
  hash.add_bytes(std::span(bytes).first(bytes.size() - 8));
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + bytes.size() - 8, &value, 8);
}

}  // namespace

TEST_CASE("a drive on the motorway that is saved and restored goes on as if nothing had been") {
  for (const SavedDrive& saved : drive_and_save("behind-ambulance", "plain", 1, {0, 1, 1111}))
    check_that_it_goes_on("behind-ambulance", 1, saved);
  for (const SavedDrive& saved : drive_and_save("rescue-lane", "tired", 2, {1500}))
    check_that_it_goes_on("rescue-lane", 2, saved);
  for (const SavedDrive& saved : drive_and_save("first-lesson", "plain", 1, {1500}))
    check_that_it_goes_on("first-lesson", 1, saved);
  for (const SavedDrive& saved : drive_and_save("town", "plain", 1, {1500})) check_that_it_goes_on("town", 1, saved);
  for (const SavedDrive& saved : drive_and_save("hazards", "plain", 1, {4200}))
    check_that_it_goes_on("hazards", 1, saved);
}

TEST_CASE("a drive that is saved in the middle of smoke goes on as if nothing had been") {
  const auto drives = drive_and_save("tunnel-fire", "plain", 1, {1200, 1201});
  CHECK(drives.front().smoke > 2);
  for (const SavedDrive& saved : drives) check_that_it_goes_on("tunnel-fire", 1, saved);
}

TEST_CASE("a drive that is saved in the middle of breaking ice goes on as if nothing had been") {
  const auto drives = drive_and_save("winter-lorry", "plain", 1, {700, 951});
  CHECK(drives.front().debris > 8);
  for (const SavedDrive& saved : drives) check_that_it_goes_on("winter-lorry", 1, saved);
}

TEST_CASE("a staged crash that is saved in the middle of it goes on as if nothing had been") {
  for (const auto& [scenario, tick] :
       {std::pair("crossing-crash", 1424), std::pair("pile-up", 735), std::pair("walker-behind-van", 800)})
    for (const SavedDrive& saved : drive_and_save(scenario, "plain", 1, {static_cast<Tick>(tick)}))
      check_that_it_goes_on(scenario, 1, saved);
}

TEST_CASE("a game that is saved after its second level has begun goes on as if nothing had been") {
  for (const SavedDrive& saved : drive_and_save("motorway-ambulance", "experienced", 1, {1200, 5500}))
    check_that_it_goes_on("motorway-ambulance", 1, saved);
}

TEST_CASE("no shipped scenario is without a drive that is saved") {
  std::set<std::string> shipped;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(source_folder()) / "scenarios"))
    if (std::filesystem::exists(entry.path() / (entry.path().filename().string() + ".xosc")))
      shipped.insert(entry.path().filename().string());
  CHECK(shipped == std::set<std::string>{"behind-ambulance", "crossing-crash", "first-lesson", "hazards",
                                         "motorway-ambulance", "pile-up", "rescue-lane", "town", "tunnel-fire",
                                         "walker-behind-van", "winter-lorry"});
}

TEST_CASE(
    "a state of another drive, of another build and one that another program's traffic belongs to are refused, each in "
    "so many words") {
  Drive drive = begin("winter-lorry", 1);
  const Bytes bytes = *save_state(*drive.loaded.model, drive.state);
  const auto why_not = [](const Model& model, const Bytes& what) {
    const auto state = restored(model, what);
    REQUIRE(!state.has_value());
    return state.error().what;
  };
  CHECK(why_not(*begin("winter-lorry", 2).loaded.model, bytes).find("another drive") != std::string::npos);
  CHECK(why_not(*begin("rescue-lane", 1).loaded.model, bytes).find("another drive") != std::string::npos);
  Bytes other = bytes;
  other[20] ^= std::byte{1};  // Behind the word and the format comes the build's name: its length, then itself.
  sign(other);
  CHECK(why_not(*drive.loaded.model, other).find("another build") != std::string::npos);
  CHECK(why_not(*drive.loaded.model, Bytes(100, std::byte{7})).find("no saved state") != std::string::npos);

  struct Elsewhere final : traffic::TrafficEngine {
    void start(const traffic::TrafficParameters&, std::span<const traffic::ForeignVehicle>) override {}
    void stop() override {}
    void advance(std::span<const traffic::ForeignVehicle>, double) override {}
    void append_participants(std::vector<Participant>&) const override {}
    void add_to_hash(StateHash&) const override {}
  };
  auto with_other = initial_state(*drive.loaded.model, std::make_unique<Elsewhere>());
  REQUIRE(with_other.has_value());
  CHECK(save_state(*drive.loaded.model, *with_other).error().what.find("another program moves the traffic") !=
        std::string::npos);
  CHECK(restore_state(*drive.loaded.model, std::make_unique<Elsewhere>(), bytes, "test")
            .error()
            .what.find("another program") != std::string::npos);
}

TEST_CASE("two states that are the same but for what only a later tick will show hash differently") {
  Drive drive = begin("winter-lorry", 1);
  const DriverInput input{.accelerator = 0.3};
  while (drive.state.tick < 700) drive.step(input);
  State& state = drive.state;
  const std::uint64_t before = hash_state(state);
  const auto differs_with = [&](auto& member, const auto& other) {
    const auto kept = std::exchange(member, other);
    const bool differs = hash_state(state) != before;
    member = kept;
    return differs && hash_state(state) == before;
  };
  CHECK(differs_with(state.car.wheels[1].force_n.y, 1234.5));  // Bends the suspension in the next step.
  CHECK(differs_with(state.touching, std::vector<ParticipantId>{9999}));
  CHECK(differs_with(state.kerbs[2], KerbTouch{0.1, 1.0}));
  CHECK(differs_with(state.effects.crashes.struck_vehicles, std::vector<VehicleCrash>{{.first = {.id = 9999}}}));
  CHECK(differs_with(state.impacts, std::vector<CarImpact>{{.vehicle = 9999}}));
  CHECK(differs_with(state.bodies.bodies, std::vector<LooseBody>{{.id = 9999}}));
  CHECK(differs_with(state.bodies.contacts, std::vector<BodyContact>{{.first = 1, .second = 9999}}));
  CHECK(differs_with(state.hull.touches, std::vector<vehicle::HullTouch>{{.run = 9999}}));
  CHECK(differs_with(state.effects.random, Random(77)));
  scenario::EntityState& lorry = state.scenario.entities.back();
  CHECK(differs_with(lorry.acceleration_mps2, -1.5));
  CHECK(differs_with(lorry.lateral_control.left_way_m, std::optional(0.5)));
  CHECK(differs_with(state.scenario.friction_scale, 0.5));
  CHECK(differs_with(state.scenario.elements.back().initialised, !state.scenario.elements.back().initialised));
  CHECK_FALSE(differs_with(state.input.accelerator, 0.9));  // Its effect is in the car.
}

TEST_CASE("a state that was cut off or in which a bit was turned is refused") {
  Drive drive = begin("winter-lorry", 1);
  const DriverInput input{.accelerator = 0.3};
  while (drive.state.tick < 700) drive.step(input);
  const Bytes bytes = *save_state(*drive.loaded.model, drive.state);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 97)
    CHECK(!restored(*drive.loaded.model, std::span(bytes).first(length)).has_value());
  for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 97) {
    Bytes turned = bytes;
    turned[at] ^= std::byte{0x10};
    CHECK(!restored(*drive.loaded.model, turned).has_value());
  }
}

TEST_CASE("a state that was changed with care is refused or is one that can be driven on with") {
  Drive drive = begin("winter-lorry", 1);
  const DriverInput input{.accelerator = 0.3};
  while (drive.state.tick < 700) drive.step(input);
  // In the middle of impacts, too: enough of them for changes to meet one.
  const impact::Body car{1752.0, 2900.0, {0.0, 0.0}, {10.0, 0.0}}, other{1500.0, 2500.0, {4.0, 0.5}, {0.0, 0.0}};
  const auto impulse = impact::impulse_at(car, other, {{2.0, 0.0}, {1.0, 0.0}}, {});
  REQUIRE(impulse.has_value());
  const impact::CrushCurve curve =
      impact::crush_curve({car.mass_kg, passenger_car_crush()}, {other.mass_kg, passenger_car_crush()});
  for (ParticipantId id = 7; id < 27; ++id)
    drive.state.impacts.push_back({id, impact::pulse_of(*impulse, {1.0, 0.0}, curve, 0.1), other});
  for (ParticipantId id = 2000; id < 2020; ++id) {
    LooseBody& loose = drive.state.bodies.bodies.emplace_back();
    loose.id = id;
    loose.body = other;
    loose.body.mass_centre_m += Vec2(30.0 * id, 0.0);
    BodyContact& contact = drive.state.bodies.contacts.emplace_back();
    contact.first = driver_participant;
    contact.second = id;
    contact.engagement.pulses.push_back(impact::pulse_of(*impulse, {1.0, 0.0}, curve, 0.1));
  }
  for (std::uint32_t run = 0; run < 20; ++run) {
    vehicle::HullTouch& touch = drive.state.hull.touches.emplace_back();
    touch.run = run;
    touch.mass_kg = car.mass_kg;
    touch.engagement.pulses.push_back(impact::pulse_of(*impulse, {1.0, 0.0}, curve, 0.1));
    touch.engagement.first.each[0] = {{1.0, 0.0}, 1.9};
    touch.engagement.first.count = 1;
  }
  const Bytes bytes = *save_state(*drive.loaded.model, drive.state);
  Random random(5);
  int accepted = 0;
  for (int round = 0; round < 1000; ++round) {
    Bytes changed = bytes;
    const std::size_t at = 40 + random.below(changed.size() - 60);
    for (std::size_t n = 0; n < 1 + random.below(8); ++n) changed[at + n] = static_cast<std::byte>(random.below(256));
    sign(changed);
    const Model& model = *drive.loaded.model;
    auto state = restore_altered_state(model, traffic::own_traffic(model.roads, model.seed), changed, "test");
    if (!state) continue;
    ++accepted;
    for (int tick = 0; tick < 2; ++tick) server_step(*drive.loaded.model, input, *state, drive.events);
  }
  MESSAGE(accepted << " of 1,000 altered states are driven on with");
  CHECK(accepted > 0);
  CHECK(accepted < 1000);
}

}  // namespace septet::simulation
