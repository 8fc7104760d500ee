#ifndef SEPTET_LIGHT_RUTS_HPP
#define SEPTET_LIGHT_RUTS_HPP
/// The two tracks of a lane where wheels run: they are worn, water stands in them, and snow does not stay.
///
/// `u` goes across a lane's image, from 0 at one edge to 1 at the other.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// From the middle of the nearer track, lanes.
LIGHT_FN float from_rut(float u) { return abs(abs(u - 0.5f) - 0.23f); }

/// 1 where wheels run.
LIGHT_FN float rut_at(float u) { return 1.0f - smoothstep(0.05f, 0.12f, from_rut(u)); }

LIGHT_END

#endif
