#include "engine/effects/debris/save_debris.hpp"

#include <algorithm>
#include <cmath>

#include "engine/effects/debris/laminate.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/save_elastic.hpp"

namespace septet::debris {

SEPTET_MEMBERS(Shard, position_m, velocity_mps, angular_velocity_radps, orientation, size_m, mass_kg, shade_m2)

SEPTET_MEMBERS(FaceCrack, first, second, reach)
// Left out are data of its part, of its picture, and its body, which has a reader of its own; kept is its look; its melting shows in the hashed body.
SEPTET_MEMBER_GROUPS(Piece, hashed(id, part), kept(origin), left_out(material, body), kept(splinter),
                     hashed(plastic_strain, cracks), left_out(surface), kept(height_m, melted_m),
                     hashed(calm_s, asleep))
// Pieces and, in the hash, shards are taken one by one.
SEPTET_MEMBER_GROUPS(State, left_out(pieces), kept(shards), hashed(next_id, bad_numbers))

namespace {

constexpr std::uint32_t most_ids = 1 << 23;  // Effects have room for twice as many.

void restore_piece(StateReader& reader, Piece& piece) {
  constexpr auto wrong = "debris in it does not fit together";
  transfer(reader, piece);
  if (!reader.require(static_cast<int>(piece.part) < part_count, "debris in it is of no known part")) return;
  if (piece.origin)
    reader.require(static_cast<int>(piece.origin->mount) < mount_count && piece.origin->model < vehicle_models().size(),
                   "debris in it is of no known vehicle");
  const PartRecipe& recipe = part_recipe(piece.part);
  reader.require(piece.height_m > 0.0 && piece.height_m <= recipe.size_m.z && piece.melted_m >= 0.0 &&
                     piece.melted_m < piece.height_m,
                 wrong);
  piece.material = spread_material(recipe);
  piece.body.material = present_elastic(piece);
  piece.body.shell = shell_of(recipe);
  elastic::restore_body(
      reader, static_cast<std::size_t>(recipe.cells.x * recipe.cells.y * recipe.cells.z * elastic::tetrahedra_per_cell),
      piece.body);
  const std::size_t elements = piece.body.elements.size();
  reader.require(piece.splinter.size() == elements && piece.plastic_strain.size() == elements, wrong);
  for (const int splinter : piece.splinter) reader.require(splinter >= 0 && splinter < recipe.splinters, wrong);
  for (const FaceCrack& crack : piece.cracks)
    reader.require(crack.first >= 0 && crack.first < crack.second &&
                       static_cast<std::size_t>(crack.second) < elements && crack.reach > 0.0 && crack.reach < 1.0,
                   wrong);
  if (!reader.ok()) return;
  std::vector<elastic::Tetrahedron> tetrahedra;
  for (const auto& element : piece.body.elements) tetrahedra.push_back(element.nodes);
  piece.surface = elastic::surface_triangles(piece.body.rest_position_m, tetrahedra);
}

}  // namespace

void save_debris(const State& state, StateWriter& writer) {
  transfer(writer, state);
  const std::uint64_t pieces = state.pieces.size();
  transfer(writer, pieces);
  for (const Piece& piece : state.pieces) {
    transfer(writer, piece);
    elastic::save_body(piece.body, writer);
  }
}

void add_to_hash(const State& state, StateHash& hash) {
  hash_members(hash, state);
  for (const Piece& piece : state.pieces) {
    hash.add(piece.id);
    if (piece.asleep) continue;  // Hashed when it last moved.
    hash_members(hash, piece);
    elastic::add_to_hash(piece.body, hash);
  }
  for (const Shard& shard : state.shards)
    if (shard.velocity_mps != Vec3(0.0)) hash_members(hash, shard);
}

void restore_debris(StateReader& reader, State& state) {
  constexpr auto wrong = "debris in it does not fit together";
  transfer(reader, state);
  for (const Shard& shard : state.shards) {
    for (const Vec3* vector : {&shard.position_m, &shard.velocity_mps, &shard.angular_velocity_radps})
      reader.require(std::max({std::abs(vector->x), std::abs(vector->y), std::abs(vector->z)}) < 1e7, wrong);
    reader.require(shard.size_m > 0.0 && shard.size_m < 100.0 && shard.mass_kg >= 0.0 && shard.mass_kg < 1e4 &&
                       shard.shade_m2 >= 0.0 && shard.shade_m2 < 1e4,
                   wrong);
  }
  const std::size_t pieces = transfer_count(reader);
  state.pieces.clear();
  for (std::size_t i = 0; i < pieces && reader.take_memory(sizeof(Piece)); ++i) {
    Piece& piece = state.pieces.emplace_back();
    restore_piece(reader, piece);
    reader.require(piece.id < state.next_id && (i == 0 || piece.id > state.pieces[i - 1].id), wrong);
  }
  reader.require(state.next_id >= 1 && state.next_id <= most_ids, wrong);
}

}  // namespace septet::debris
