#pragma once
/// A crash that is being recorded: plain data. The stage: crash_recording.hpp.

#include <cstdint>

#include "engine/physics/impact/body.hpp"
#include "engine/physics/impact/pulse.hpp"
#include "engine/world/crash_record.hpp"

namespace septet::simulation {

struct OpenCrash {
  CrashRecord record;                              ///< As far as it is known.
  std::uint32_t run = 0;                           ///< Of what stands (Obstacle::run).
  Tick last_push = 0;                              ///< Of the impact; at first the tick of the touch.
  Tick last_in_contact = 0;                        ///< Tick of the last push of all, the impact's or a later one.
  bool is_impact_over = false;                     ///< The record is whole but for how long the contact lasts.
  bool is_told = false;                            ///< They have not parted yet: no second record of them.
  impact::Body first_at, second_at;                ///< At the touch.
  impact::Body first, second;                      ///< As the last push has left them.
  impact::Ledger of_contact;                       ///< Sum of all pushes of this contact.
  double debris_j = 0.0, wheels_j = 0.0;           ///< Of the record's ledger so far.
  double deepest_m = 0.0;                          ///< Of the outlines so far, pushed or not.
  bool first_moves = false, second_moves = false;  ///< Its motion is known, and changes by pushes.
  bool has_ledger = false;                         ///< Every push has told its work.
};

}  // namespace septet::simulation
