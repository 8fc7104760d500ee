#pragma once
/// Participants of a script's overlay in its session: their numbers, names and ways, and the font.

#include <optional>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/image/font.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-client/film/overlay/overlay_content.hpp"

namespace septet::film {

struct OverlayCast {
  std::vector<OverlayPerson> people;
  std::vector<OverlayWay> ways;     ///< Ten places a second over all shots with paths; empty: no shot has them.
  std::optional<image::Font> font;  ///< Empty: no shot has an overlay.

  /// Error: no font, a participant whom the session does not know by name or number, or a session that cannot be read.
  static Expected<OverlayCast> of(const logging::SessionReader& session, const Script& script);
};

}  // namespace septet::film
