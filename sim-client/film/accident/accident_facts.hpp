#pragma once
/// Facts of a session that the film of an accident is planned from, read from its log.
///
/// World frame, metres, seconds of simulated time.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/world/crash_record.hpp"
#include "engine/world/vehicle_model.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::film {

/// How a participant's motion came about.
enum class MovedBy : std::uint8_t {
  person,            ///< The driver's car, by the logged controls of a person.
  simulated_driver,  ///< The driver's car, by a simulated driver.
  table,             ///< The driver's car, by a path or a recorder's table (docs/given-motion.md).
  scenario,          ///< By what the scenario's storyboard tells it.
  traffic,           ///< By the traffic model.
  editor,            ///< A solid (engine/world/solid.hpp).
};

/// A contact, as the log's event `collision` or `crash_of_others` tells it.
struct Contact {
  double time_s = 0.0;
  ParticipantId first = 0;
  std::optional<ParticipantId> second;             ///< Empty: something that stands, which is `stands`.
  std::string stands;                              ///< "guard rail", "tree", …; of a solid its name.
  std::optional<double> closing_mps, delta_v_mps;  ///< The latter of the first. Empty: the event does not tell it.
  std::optional<CrashRecord> crash = {};           ///< What it came to, where the log has that.
};

/// A participant at an instant.
struct WayPoint {
  double time_s = 0.0;
  Vec3 position_m{0.0};  ///< Origin: on the ground below the middle of the rear axle.
  double heading_rad = 0.0;
  double speed_mps = 0.0;  ///< Of the origin, in plan.
};

struct Involved {
  ParticipantId number = 0;
  std::string name;  ///< Of the scenario or the editor's thing; empty: it has none.
  ModelIndex model = 0;
  std::optional<Vec3> box_size_m = {};  ///< Of a box (engine/world/participant_shape.hpp).
  MovedBy moved_by = MovedBy::traffic;
  std::vector<WayPoint>
      way;  ///< Every tick of the window in which they are there; the rider's once he has left the machine.
};

struct AccidentFacts {
  std::pair<double, double> session_s;  ///< What the session holds.
  std::pair<double, double> window_s;   ///< What the film is about.
  std::vector<Contact> contacts;        ///< All of the session, by time.
  std::optional<std::size_t> chosen;    ///< Index of the film's contact; empty: there is none.
  std::optional<double> nearest_s;      ///< Without a contact: when two came nearest to each other,
  double nearest_m = 0.0;               ///< and the distance of their outlines; 0: they overlap.
  std::vector<Involved> involved;       ///< One or two, the contact's first before its second.
  std::vector<Involved> bystanders;     ///< Everybody else who comes within `bystanders_within_m` of the first.
  std::string driver;                   ///< Kind of the simulated driver; empty: a person, or nobody.
  std::string table;                    ///< Name of the table by which the driver's car goes; empty: none.
  std::string changes;                  ///< Of a variant of another session: what was changed of its driver's inputs.
};

inline constexpr double before_contact_s = 5.0, after_contact_s = 3.0, bystanders_within_m = 60.0;

/// The two of such an event. The event's participant is one of them; the other is named by `with=NUMBER` in its
/// detail, and is the driver's car where the event names nobody else.
Contact contact_of(const logging::Event& event, ParticipantId driver);

/// What people call them: their name, else their number.
std::string name_of(const Involved& involved);

/// `event`: the contact's number, counted from 1; empty: the first. Error: there is no such contact, the session cannot
/// be read, or it holds no world.
Expected<AccidentFacts> read_accident(const logging::SessionReader& session, std::optional<std::size_t> event);

}  // namespace septet::film
