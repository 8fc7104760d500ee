#pragma once
/// An attendant of a drive: the list of allowed clients, the operator's desk, sound, log, console, … Each is one class
/// in a file of its own; the server's loop (serve.hpp) holds a list of them and knows none of them by name.
///
///     begin  →  (before_tick → wishes → after_tick) …  →  close
///
/// `begin` and `after_tick` run in the order of the list, `close` in the opposite order: an attendant may use those
/// before it. All calls come from the loop's thread, and none may wait for a device, a disk or a person.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/world/taken_snapshot.hpp"
#include "logging/session/drive_end.hpp"

namespace septet::server {

struct ServeResult;

/// The drive between two ticks.
struct Moment {
  std::shared_ptr<const TakenSnapshot> newest;  ///< Null before the first tick.
  std::string_view doing;                       ///< "driving", "paused", "waiting for 3 screens", …
  double now_s = 0.0;                           ///< By the loop's clock.
  /// Lockstep waits for screens to show the newest tick: until all have, its world stays as it is. A screen fetches a new
  /// node's content after the node; of a store that goes on meanwhile it would show neither tick's world.
  bool is_being_drawn = false;
};

/// Wishes of an attendant for the next tick. The first end in the list's order counts; of the others, any attendant's
/// wish counts.
struct Wishes {
  std::optional<logging::DriveEnd> end;
  bool stands_still = false;          ///< The world is to stand still.
  bool goes_without_missing = false;  ///< The drive is to begin without the screens that are missing.
  std::string word_to_driver;         ///< Text for the driver to read now; empty: none.
};

struct Message {
  std::string text;
  bool is_logged = false;  ///< The source of ticks logs its own.
};

struct Progress {
  /// Simulated time now and at the end. Total 0: the drive lasts until it is ended.
  double simulated_s = 0.0, total_s = 0.0;
  double wall_s = 0.0;  ///< Without pauses; it begins anew when the driver has taken the controls.
  std::string doing;
};

class Attendant {
 public:
  virtual ~Attendant() = default;
  /// The drive begins. Error: it does not, and nothing is left behind.
  virtual Expected<void> begin() { return {}; }
  /// Called before each tick, and again and again while the world stands still or lockstep waits for screens.
  virtual void before_tick(const Moment& /*moment*/) {}
  /// Asked after each `before_tick`.
  virtual Wishes wishes() { return {}; }
  /// `shaking_share`: as TickSource::shaking_share.
  virtual void after_tick(const std::shared_ptr<const TakenSnapshot>& /*tick*/, double /*shaking_share*/) {}
  /// Messages for the console and the log since the last call.
  virtual std::vector<std::string> take_messages() { return {}; }
  /// A message of the loop, the screens, the source of ticks or any attendant.
  virtual void hear(const Message& /*message*/) {}
  virtual void show(const Progress& /*progress*/) {}
  /// The drive has ended. An attendant that fails now may change the result.
  virtual void close(ServeResult& /*result*/) {}
};

using Attendants = std::vector<std::unique_ptr<Attendant>>;

}  // namespace septet::server
