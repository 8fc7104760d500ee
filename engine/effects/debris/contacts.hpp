#pragma once
/// Contacts of debris with the ground, with boxes and with other pieces. The law of the first two is derived at the head
/// of contacts.cpp, that of pieces among themselves in piece_impulses.cpp.

#include <vector>

#include <Eigen/Geometry>

#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/step.hpp"

namespace septet::debris {

struct FoundContact {
  elastic::NodeContact contact;
  int box = -1;  ///< Index of the box, −1 for the ground.
};

/// Nodes of the piece that touch ground or boxes or may do so within the step. The boxes are moved by their velocity
/// for `ahead_s`.
std::vector<FoundContact> find_contacts(const Piece& piece, const ContactWorld& world, double step_s,
                                        double ahead_s = 0.0);

/// True where a box moves close to the piece.
bool box_near(const Piece& piece, const ContactWorld& world, double step_s);

/// Around all nodes, world frame.
Eigen::AlignedBox3d bounds_of(const Piece& piece);

/// Inelastic impulses with friction between nodes of one piece inside elements of another; equal
/// and opposite, so that momentum stays. Wakes a sleeper that is hit.
void exchange_impulses(std::vector<Piece>& pieces, double step_s, EnergyLedger* ledger = nullptr);

/// A point against a box and its cuts: the gap and the outward normal, world frame. Beyond an edge between a cut and a
/// face the gap is that to the further of their planes, which is never more than the distance.
struct BoxGap {
  double gap_m;
  Vec3 normal;
};
BoxGap gap_to_box(const Box& box, const Vec3& point_m);

}  // namespace septet::debris
