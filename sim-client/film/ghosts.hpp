#pragma once
/// Ghosts: who went another way in another session, shown in a film at the same simulated times.
///
/// A ghost is the driver's car, or anybody else, of a variant (`septet what-if`) or of another drive on the same roads,
/// painted in a colour of that session. It is shown while it is elsewhere: more than 0.3 m from the participant of
/// the same number in the film's own session, or where that one is missing.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"
#include "logging/session/records.hpp"

namespace septet::film {

/// Numbers of ghosts lie above all numbers of a drive, and below those of a scene's moving objects
/// (engine/scene/placed_objects.cpp): as many for each session as a drive may have.
inline constexpr ParticipantId first_ghost_number = 0x4000'0000u, numbers_a_ghost_session = 0x0100'0000u,
                               first_moving_object = 0x8000'0000u;
inline constexpr std::size_t most_ghost_sessions = (first_moving_object - first_ghost_number) / numbers_a_ghost_session;
/// In the overlay's list, one line each; those of 8 take 39 % of a picture's height. Later ones are shown unnamed.
inline constexpr std::size_t most_ghosts_named = 8;

/// Number in the film's world of a participant of the n-th other session.
constexpr ParticipantId ghost_number(std::size_t n, ParticipantId id) {
  return first_ghost_number + static_cast<ParticipantId>(n) * numbers_a_ghost_session + id;
}

/// One thread. Instants of one shot ascend; `begin_shot` begins anew.
class Ghosts {
 public:
  /// Errors: a session that cannot be read, or whose roads are not the film's.
  static Expected<Ghosts> open(const std::vector<std::filesystem::path>& sessions, const logging::SessionInfo& film);
  Ghosts(Ghosts&&) noexcept;
  Ghosts& operator=(Ghosts&&) noexcept;
  ~Ghosts();

  void begin_shot();
  /// Adds the ghosts of an instant to its world; sessions that do not hold the instant add nobody.
  Expected<void> add_to(Snapshot& world, double instant_s);
  /// Numbers of the driver's cars in the film's world, one a session.
  std::vector<ParticipantId> drivers() const;

 private:
  struct Other;
  explicit Ghosts(std::vector<std::unique_ptr<Other>> others);
  std::vector<std::unique_ptr<Other>> others_;
};

}  // namespace septet::film
