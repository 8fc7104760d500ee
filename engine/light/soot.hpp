#ifndef SEPTET_LIGHT_SOOT_HPP
#define SEPTET_LIGHT_SOOT_HPP
/// Soot of a fire on what stands around it, as a field of cells over the world.
///
/// A cell's value stands at its middle and is the share of a surface there that soot covers. It is black and lies on top: of all light that leaves the
/// surface, mirrored, scattered, sent back by beads or given off by a lamp, that share is lost. Between the eight cells around a place the share is
/// mixed by its distance to each; outside of their middles there is none.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// True where the eight cells from `low` on lie in a field of `size` cells.
LIGHT_FN bool in_soot(ivec3 low, ivec3 size) {
  return !any(lessThan(low, ivec3(0))) && !any(greaterThanEqual(low, size - 1));
}

/// Step from the first of the eight cells around a place to the n-th.
LIGHT_FN ivec3 soot_corner(int n) { return ivec3(n & 1, (n >> 1) & 1, n >> 2); }

LIGHT_FN int soot_index(ivec3 cell, ivec3 size) { return (cell.z * size.y + cell.y) * size.x + cell.x; }

/// Weight of that cell; `share`: of the way from the first of the eight to the last, along each axis.
LIGHT_FN float soot_weight(vec3 share, ivec3 corner) {
  const vec3 weight = mix(1.0f - share, share, vec3(corner));
  return weight.x * weight.y * weight.z;
}

LIGHT_END

#endif
