#pragma once
/// Traffic moved by SUMO, as a TrafficEngine: readers of participants see no difference.
///
/// SUMO runs one of its steps (50 ms) ahead of the drive; ticks in between are interpolated (interpolate.hpp). The
/// swarm is the one that Septet's own engine would set out: same places, same kinds of vehicles, same drivers with IDM;
/// vehicles that fall out of its radius enter at the other rim. A vehicle that SUMO cannot place where Septet would is
/// placed elsewhere in the swarm during the first second, at its rims later on; until then it is absent. Positions are
/// mapped by x and y; height and tilt are those of Septet's road, heading is that of the road with the vehicle's drift
/// across it, because SUMO's own turns in steps. Who stands behind another that does not move is helped round it, since
/// SUMO leaves him there (sumo_standing.cpp). Vehicles moved by others are sent to SUMO at each of its steps, with
/// their place after the step.

#include <memory>
#include <vector>

#include "engine/traffic/traffic_engine.hpp"
#include "sim-server/sumo/sumo_client.hpp"
#include "sim-server/sumo/sumo_network.hpp"

namespace septet::server {

inline constexpr double sumo_step_s = 0.05;

class SumoTraffic final : public traffic::TrafficEngine {
 public:
  /// `network` is made from `roads`, which outlive this.
  SumoTraffic(const road::RoadNetwork& roads, SumoNetwork network, std::shared_ptr<SumoClient> client,
              std::uint64_t seed);

  void start(const traffic::TrafficParameters& parameters, std::span<const traffic::ForeignVehicle> foreign) override;
  void stop() override;
  void advance(std::span<const traffic::ForeignVehicle> foreign, double dt_s) override;
  bool release(ParticipantId id) override;
  void append_participants(std::vector<Participant>& participants) const override;
  void add_to_hash(StateHash& hash) const override;
  std::optional<std::string> take_remark() override { return std::exchange(remark_, std::nullopt); }
  std::optional<Error> take_error() override { return std::exchange(error_, std::nullopt); }

 private:
  /// One vehicle of the swarm, on the road or waiting outside.
  struct Member {
    ParticipantId id = 0;
    ModelIndex model = 0;
    std::uint8_t paint = 0;
    std::size_t corridor = 0;
    double desired_speed_mps = 0.0, standstill_gap_m = 0.0;
    enum class Stay { outside, asked_for, on_road } stay = Stay::outside;
    int steps_waiting = 0;  ///< Since its request.
    /// How it gets away from behind one that does not move (sumo_standing.cpp).
    struct Standing {
      int steps = 0, steps_held = 0;
      bool held = false, close_up = false;  ///< Close up: it has the small gap of those who stand.
    } standing;
    std::optional<road::RoadPosition> place;
    double speed_mps = 0.0, lateral_mps = 0.0, rolled_m = 0.0;
    double slip_m = 0.0;  ///< Distance ahead of SUMO's place at which it is shown.
  };

  bool ok(const Expected<void>& outcome);
  void enter(Member& member, int lane, double x_m);
  void leave(Member& member);
  bool set_out_again(Member& member, double middle_x_m);
  void recycle(Member& member, const road::RoadPosition& middle, double middle_speed_mps);
  void place_foreign(std::span<const traffic::ForeignVehicle> foreign, double ahead_s);
  void step(std::span<const traffic::ForeignVehicle> foreign);
  void free_those_who_stand(std::span<const traffic::ForeignVehicle> foreign);
  void hold_standing(Member& member, bool hold);
  void make_remark();
  std::optional<Participant> participant_of(Member& member, const SumoVehicle& vehicle, bool is_new) const;
  Participant shown(const Participant& participant) const;

  const road::RoadNetwork& roads_;
  SumoNetwork network_;
  std::shared_ptr<SumoClient> client_;
  Random random_;
  traffic::TrafficParameters parameters_;
  std::vector<traffic::CorridorTraffic> corridors_;
  std::vector<Member> members_;      ///< Ascending id.
  std::vector<ParticipantId> told_;  ///< Foreign vehicles that SUMO knows.
  /// Given up since SUMO's last step: their numbers are taken there until its next one.
  std::vector<ParticipantId> given_up_;
  std::vector<Participant> before_, after_;  ///< At SUMO's last step and at the one ahead; ascending id.
  double phase_s_ = 0.0;                     ///< Since `before_`.
  double time_s_ = 0.0;
  bool running_ = false;
  int steps_ = 0;  ///< Since the swarm's request.
  std::optional<std::string> remark_;
  std::optional<Error> error_;
};

/// A participant's motion is the derivative of its shown place: SUMO's own speed is that along a lane as long as all
/// lanes of its edge are. `gained_mps`: its growth in the step.
void tell_sumo_motion(const Participant& before, double gained_mps, Participant& now);

}  // namespace septet::server
