#pragma once
/// Faces of the static signals of a road file.
///
/// Tables: the German StVO (also for the country "OpenDRIVE" and for signals without a country), the Swedish
/// Vägmärkesförordning (letters as type, numbers as subtype), and of the United States' MUTCD the signs that stop and
/// slow. Other countries' signs follow from their names and units, else they are blank boards: a wrong sign would be
/// worse.

#include <cstdint>
#include <string>

#include "engine/road/road_furniture.hpp"

namespace septet::scenery {

enum class SignStyle : std::uint8_t {
  blank,
  prohibition,      ///< Red ring.
  prohibition_end,  ///< Grey bars across.
  no_entry,
  no_stopping,
  mandatory,  ///< Blue disc.
  warning,    ///< Triangle.
  yield,
  stop,
  priority,  ///< Yellow diamond.
  priority_end,
  information,  ///< Blue board.
  place,        ///< Yellow board with a name.
  white_board,
  rail_cross,
};

enum class SignSymbol : std::uint8_t {
  none,
  text,
  exclamation,
  crossroads,
  arrow_up,
  arrow_left,
  arrow_right,
  bend_left,
  bend_right,
  roundabout,
  walker,
  walkers,
  bicycle,
  works,
  lights,
  narrow,
  two_cars,
  lorry,
  walker_on_stripes,
};

struct SignFace {
  SignStyle style = SignStyle::blank;
  SignSymbol symbol = SignSymbol::none;
  std::string text;
  bool yellow = false;  ///< True for Swedish signs: yellow where others are white.

  bool operator==(const SignFace&) const = default;
};

SignFace sign_face(const road::Signal& signal);

}  // namespace septet::scenery
