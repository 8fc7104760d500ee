#pragma once
// Crashes that the scenarios beside this file stage.

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "tests/checkout.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {

/// A scenario, driven by a simulated driver: one beside this file by a novice, or any other.
struct StagedCrash {
  server::LoadedDrive loaded;
  State state;
  server::DriverSeat seat;
  Snapshot now;
  std::vector<Event> events;
  std::vector<DriverInput> inputs;

  explicit StagedCrash(const std::string& name) : StagedCrash(loaded_beside(name), "novice") {}
  StagedCrash(server::LoadedDrive drive, const std::string& driver) : loaded(std::move(drive)) {
    auto begun = initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 1));
    REQUIRE(begun.has_value());
    state = std::move(*begun);
    auto sits = server::open_driver_seat(rig::Car{.driver = driver}, 1, loaded.model);
    REQUIRE(sits.has_value());
    seat = std::move(*sits);
    now = capture_snapshot(*loaded.model, state);
  }
  static server::LoadedDrive loaded_beside(const std::string& name) {
    const std::string root = source_folder();
    auto drive = server::load_drive(server::DriveFiles{
        root + "/tests/engine/simulation/shipped_drives/" + name + ".xosc", root + "/rigs/seven-screens.toml", 1});
    REQUIRE_MESSAGE(drive.has_value(), why_not(drive));
    return std::move(*drive);
  }
  void step() {
    for (const auto& device : seat.devices) device->see(now, {});
    inputs.push_back(seat.car->poll(state.time_s()).input);
    now = server_step(*loaded.model, inputs.back(), state, events);
  }
  State restored() const {
    const auto bytes = save_state(*loaded.model, state);
    REQUIRE(bytes.has_value());
    auto again = restore_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 1), *bytes, "test");
    REQUIRE_MESSAGE(again.has_value(), why_not(again));
    return std::move(*again);
  }
  const Event* event(std::string_view kind) const {
    const auto found = std::ranges::find(events, kind, &Event::kind);
    return found == events.end() ? nullptr : &*found;
  }
  ParticipantId named(std::string_view name) const {
    const auto& entities = loaded.model->scenario.entities;
    const auto found = std::ranges::find(entities, name, &scenario::Entity::name);
    REQUIRE(found != entities.end());
    return first_scripted_participant + static_cast<ParticipantId>(found - entities.begin());
  }
  bool pressed() const {
    return std::ranges::any_of(state.bodies.contacts,
                               [](const BodyContact& contact) { return !contact.engagement.pulses.empty(); });
  }
};

}  // namespace septet::simulation
