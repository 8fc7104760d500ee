#pragma once
/// Text that the driver reads on a screen where no real car shows it: speed, gear, indicators; and the table of driving
/// keys.
///
/// Pure: lines of text for a frame's overlay, in pixels of the screen.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/instant/frame_input.hpp"
#include "engine/rig/rig.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::frame {

/// Speed and gear below the driver's look ahead and indicators at both sides, unless the screen shows a cockpit with
/// dials of its own; a stalled engine underneath. Empty on a screen whose rig does not ask for it.
std::vector<instant::OverlayText> instruments(const Snapshot& shown, const rig::Rig& rig, const rig::Screen& screen);

/// Guidance of the driver, high on the screen ahead: the next turn with its distance, and for a while the sentence that
/// was told last. Empty where nobody guides him.
std::vector<instant::OverlayText> guidance_texts(const Snapshot& shown, const rig::Rig& rig, const rig::Screen& screen);

/// Standing of a game, high on the screen ahead: level, points, time; a leader who gets away; the outcome. Empty if the
/// scenario is not a game.
std::vector<instant::OverlayText> game_standing(const Snapshot& shown, const rig::Rig& rig, const rig::Screen& screen);

/// What a replay at somebody's eyes shows.
enum class EyesSeen : std::uint8_t {
  drivers,  ///< The driver's, as logged.
  others,   ///< Somebody else's, of whom no gaze is logged.
  absent,   ///< Somebody who is not there at this instant.
};

/// Caption high on the screen ahead: whose eyes these are, and what is known of where they looked. Empty on the others.
std::vector<instant::OverlayText> eyes_caption(const std::string& name, EyesSeen seen, const rig::Rig& rig,
                                               const rig::Screen& screen);

/// Notice to the driver, in the middle of the screen: its first line large, the others below it, wrapped where too
/// long.
std::vector<instant::OverlayText> notice(const std::string& text, const rig::Screen& screen);

/// Table of keys in the middle of the screen, under such a notice ("Press any key to start"; empty: no notice).
std::vector<instant::OverlayText> key_table(const std::string& headline, const rig::Screen& screen);

/// Modest line near the lower left corner of the screen: below mirrors and dials.
instant::OverlayText low_line(std::string text, const rig::Screen& screen);

}  // namespace septet::frame
