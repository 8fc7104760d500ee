#pragma once
/// Ice at rest until warmth or an impact removes it: slabs on roofs, icicles, sheets on the road.
///
/// It is described by its place and its first thickness; the remaining thickness follows from the degree-hours since
/// then, one number for all of it. World frame, metres, except for ice on a vehicle. Pure functions.
///
/// Melting is that of a temperature index: a surface loses `melt_m_per_kh` for each kelvin above freezing and each hour
/// (R. Hock, "Temperature index melt modelling in mountain areas", J. Hydrology 282, 2003, describes the method; 8 mm a
/// day and kelvin is the default of the models of ice sheets PISM and PyPDD). With D = ∫ max(0, T − 273.15 K) dt,
///     sheet, slab:  h(D) = max(0, h₀ − kD)            one side: the other one is covered
///     icicle:       r(D) = max(0, r₀ − kD),  L(D) = L₀ r(D)/r₀      a cone keeps its slope

#include <cstdint>
#include <vector>

#include "engine/effects/ice/cracks.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::ice {

inline constexpr double freezing_k = 273.15;
inline constexpr double melt_m_per_kh = 0.008 / 24.0;

/// Degree-hours (K·h) of `time_s` at a temperature.
constexpr double degree_hours(double temperature_k, double time_s) {
  return temperature_k > freezing_k ? (temperature_k - freezing_k) * time_s / 3600.0 : 0.0;
}
/// Thickness that a surface has lost.
constexpr double melted_m(double thawed_kh) { return melt_m_per_kh * thawed_kh; }
/// Remaining thickness.
constexpr double left_m(double thickness_m, double thawed_kh) {
  const double left = thickness_m - melted_m(thawed_kh);
  return left > 0.0 ? left : 0.0;
}
/// Wetness of a surface, 0 to 1: a film stands on it from half a kelvin below freezing on, full at one above.
constexpr double film(double temperature_k) {
  const double share = (temperature_k - freezing_k + 0.5) / 1.5;
  return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}

/// A slab frozen to a vehicle.
struct LyingSlab {
  ParticipantId vehicle = 0;
  Vec3 foot_m{0.0};  ///< Middle of its underside, vehicle frame.
  Vec3 size_m{0.0};  ///< Before any melting.
};

/// A row of icicles below an edge.
struct IcicleRow {
  Vec3 from_m{0.0}, to_m{0.0};
  double longest_m = 0.8;
  std::uint32_t seed = 0;
};

/// One of a row: a cone that hangs down.
struct Icicle {
  Vec3 root_m{0.0};
  double radius_m = 0.0, length_m = 0.0;  ///< Radius of its root; length of all of it.
};

/// A sheet on the road: a band between two lines, point by point, along the ice.
struct Sheet {
  std::vector<Vec3> left_m, right_m;  ///< Edges on the road's surface.
  double thickness_m = 0.004;
};

struct StillIce {
  std::vector<LyingSlab> slabs;
  std::vector<IcicleRow> rows;
  std::vector<Sheet> sheets;
  double thawed_kh = 0.0;  ///< Since the stated thicknesses.

  bool empty() const { return slabs.empty() && rows.empty() && sheets.empty(); }
};

/// The remaining icicles of a row. Each falls when its root has become too thin for it, at a share of its first radius
/// that differs from one to the next. The same for the same row.
std::vector<Icicle> icicles_of(const IcicleRow& row, double thawed_kh);

/// A closed surface of triangles for one of them, uneven in rings as icicles are, relative to `origin_m`; `rest_m` is
/// the place in the row before any melting.
void append_icicle(std::vector<IceVertex>& surface, const Icicle& icicle, const Vec3& origin_m);

/// A box as a surface, its faces in cells along x and y; `rest_m` is the place in it.
std::vector<IceVertex> box_surface(const Vec3& low_m, const Vec3& high_m, int cells_x, int cells_y);

}  // namespace septet::ice
