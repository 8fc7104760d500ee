#include "engine/effects/debris/debris_keyframe.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "engine/core/check.hpp"
#include "engine/effects/debris/piece.hpp"

namespace septet::debris {
namespace {

/// Flags: places at rest follow, and cracks; or an origin.
constexpr std::uint8_t without_rest = 1, with_rest = 2, with_cracks = 3, with_origin = 4;
/// A coordinate of the first vertex, and a difference between vertices, in quanta.
constexpr std::int64_t furthest = 1'000'000'000, widest = 1'000'000;

using Place = std::array<std::int64_t, 3>;

Place quantised(const Vec3& p) {
  Place result;
  for (int c = 0; c < 3; ++c) {
    SEPTET_CHECK(std::isfinite(p[c]), "coordinate {}", p[c]);
    result[c] =
        std::clamp<std::int64_t>(std::llround(std::clamp(p[c] / position_quantum_m, -1e9, 1e9)), -furthest, furthest);
  }
  return result;
}

/// Differences, each from the place before.
void put_places(ByteWriter& writer, std::span<const Vec3> places) {
  Place last{};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place place = quantised(places[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t limit = i == 0 ? furthest : widest;
      const std::int64_t step = std::clamp(place[c] - last[c], -limit, limit);
      writer.put_signed_varint(step);
      last[c] += step;
    }
  }
}

/// False where one is out of bounds.
bool read_places(ByteReader& reader, std::size_t count, std::vector<Vec3>& places) {
  places.reserve(count);
  Place place{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t step = reader.get_signed_varint(), limit = i == 0 ? furthest : widest;
      if (!reader.ok() || step < -limit || step > limit) return false;
      place[c] += step;
      if (place[c] < -2 * furthest || place[c] > 2 * furthest) return false;
    }
    places.emplace_back(
        Vec3(static_cast<double>(place[0]), static_cast<double>(place[1]), static_cast<double>(place[2])) *
        position_quantum_m);
  }
  return true;
}

/// Node of the part's lattice at a place of rest.
std::uint8_t lattice_node(const PartRecipe& recipe, const Vec3& rest_m) {
  const Vec3 cells(recipe.cells), at = (rest_m / recipe.size_m + 0.5) * cells;
  const auto index = [&](int c) { return std::lround(std::clamp(at[c], 0.0, cells[c])); };
  return static_cast<std::uint8_t>((index(2) * (recipe.cells.y + 1) + index(1)) * (recipe.cells.x + 1) + index(0));
}

void put_origin(ByteWriter& writer, const Keyframe& keyframe) {
  SEPTET_CHECK(keyframe.lattice_nodes.size() == keyframe.vertices_m.size(), "{} nodes of {} vertices",
               keyframe.lattice_nodes.size(), keyframe.vertices_m.size());
  writer.put_varint(keyframe.origin->vehicle);
  writer.put_varint(keyframe.origin->model);
  writer.put(keyframe.origin->paint);
  writer.put(static_cast<std::uint8_t>(keyframe.origin->mount));
  for (const std::uint8_t node : keyframe.lattice_nodes) writer.put(node);
}

/// False where one is unknown or out of bounds.
bool read_origin(ByteReader& reader, Keyframe& keyframe) {
  const std::uint64_t vehicle = reader.get_varint(), model = reader.get_varint();
  const auto paint = reader.get<std::uint8_t>(), mount = reader.get<std::uint8_t>();
  if (!reader.ok() || vehicle > UINT32_MAX || model >= vehicle_models().size() || mount >= mount_count) return false;
  keyframe.origin = {static_cast<ParticipantId>(vehicle), static_cast<ModelIndex>(model), paint,
                     static_cast<Mount>(mount)};
  for (std::size_t i = 0; i < keyframe.vertices_m.size(); ++i)
    keyframe.lattice_nodes.push_back(reader.get<std::uint8_t>());
  return std::ranges::all_of(keyframe.lattice_nodes,
                             [&](std::uint8_t node) { return node < lattice_node_count(keyframe.part); });
}

}  // namespace

int lattice_node_count(Part part) {
  const glm::ivec3 nodes = part_recipe(part).cells + 1;
  return nodes.x * nodes.y * nodes.z;
}

Vec3 lattice_place_m(Part part, int node) {
  const PartRecipe& recipe = part_recipe(part);
  const glm::ivec3 nodes = recipe.cells + 1;
  const Vec3 at(node % nodes.x, node / nodes.x % nodes.y, node / (nodes.x * nodes.y));
  return recipe.size_m * (at / Vec3(recipe.cells) - 0.5);
}

Keyframe keyframe_of(const std::vector<Shard>& shards) {
  Keyframe keyframe;
  keyframe.part = Part::windscreen;
  keyframe.material = Material::glass;
  keyframe.shards = true;
  keyframe.asleep = true;
  for (const Shard& shard : shards) {
    if (keyframe.triangles.size() == max_vertices / 3) break;
    const auto first = static_cast<std::uint16_t>(keyframe.vertices_m.size());
    for (const Vec3& corner : {Vec3(1.0, 0.0, 0.0), Vec3(-0.5, 0.7, 0.1), Vec3(-0.4, -0.8, 0.0)})
      keyframe.vertices_m.push_back(shard.position_m + shard.orientation * (shard.size_m * corner));
    keyframe.triangles.push_back({first, static_cast<std::uint16_t>(first + 1), static_cast<std::uint16_t>(first + 2)});
    keyframe.asleep = keyframe.asleep && shard.velocity_mps == Vec3(0.0);
  }
  return keyframe;
}

Keyframe keyframe_of(const Piece& piece) {
  Keyframe keyframe;
  keyframe.part = piece.part;
  keyframe.asleep = piece.asleep;
  keyframe.origin = piece.origin;
  const PartRecipe& recipe = part_recipe(piece.part);
  keyframe.material = recipe.material;
  std::map<int, std::uint16_t> place;
  for (const auto& triangle : piece.surface) {
    std::array<std::uint16_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [found, fresh] =
          place.try_emplace(triangle.nodes[c], static_cast<std::uint16_t>(keyframe.vertices_m.size()));
      if (fresh) {
        keyframe.vertices_m.push_back(from_eigen(piece.body.position_m[triangle.nodes[c]]));
        const Vec3 rest_m = from_eigen(piece.body.rest_position_m[triangle.nodes[c]]);
        if (keyframe.material == Material::ice) keyframe.rest_m.push_back(rest_m);
        if (keyframe.origin) keyframe.lattice_nodes.push_back(lattice_node(recipe, rest_m));
      }
      corners[c] = found->second;
    }
    keyframe.triangles.push_back(corners);
  }
  if (keyframe.material == Material::ice)
    for (const FaceCrack& crack : piece.cracks) {
      if (keyframe.cracks.size() == max_cracks) break;
      const auto &a = piece.body.elements[static_cast<std::size_t>(crack.first)].nodes,
                 &b = piece.body.elements[static_cast<std::size_t>(crack.second)].nodes;
      std::vector<int> nodes;
      std::ranges::copy_if(a, std::back_inserter(nodes),
                           [&](int node) { return std::ranges::find(b, node) != b.end(); });
      // Nodes are numbered anew at each break; places at rest are not.
      std::ranges::sort(nodes, [&](int m, int n) {
        const auto &p = piece.body.rest_position_m[m], &q = piece.body.rest_position_m[n];
        return std::tie(p.x(), p.y(), p.z()) < std::tie(q.x(), q.y(), q.z());
      });
      Keyframe::Crack told;
      const auto known = [&](int node) { return place.contains(node); };
      if (nodes.size() != 3 || !std::ranges::all_of(nodes, known)) continue;  // Deep inside, out of sight.
      for (std::size_t c = 0; c < 3; ++c) told.corners[c] = place.at(nodes[c]);
      told.reach = static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * crack.reach), 0L, 255L));
      if (told.reach > 0) keyframe.cracks.push_back(told);
    }
  SEPTET_CHECK(keyframe.vertices_m.size() <= max_vertices && keyframe.triangles.size() <= max_triangles, "{} vertices",
               keyframe.vertices_m.size());
  return keyframe;
}

Bytes encode(const Keyframe& keyframe) {
  Bytes bytes;
  ByteWriter writer(bytes);
  SEPTET_CHECK(keyframe.cracks.empty() || !keyframe.rest_m.empty(), "{} cracks of nothing", keyframe.cracks.size());
  SEPTET_CHECK(!keyframe.origin || keyframe.rest_m.empty(), "{} places at rest of a part of a vehicle",
               keyframe.rest_m.size());
  const auto version = keyframe.origin            ? with_origin
                       : !keyframe.cracks.empty() ? with_cracks
                       : keyframe.rest_m.empty()  ? without_rest
                                                  : with_rest;
  writer.put(version);
  writer.put(static_cast<std::uint8_t>(keyframe.part));
  writer.put(static_cast<std::uint8_t>(keyframe.material));
  writer.put(static_cast<std::uint8_t>((keyframe.shards ? 1 : 0) | (keyframe.asleep ? 2 : 0)));
  writer.put_varint(keyframe.vertices_m.size());
  SEPTET_CHECK(keyframe.rest_m.empty() || keyframe.rest_m.size() == keyframe.vertices_m.size(), "{} places at rest",
               keyframe.rest_m.size());
  put_places(writer, keyframe.vertices_m);
  if (!keyframe.rest_m.empty()) put_places(writer, keyframe.rest_m);
  if (keyframe.origin) put_origin(writer, keyframe);
  writer.put_varint(keyframe.triangles.size());
  std::int64_t last_index = 0;
  const auto put_corners = [&](const std::array<std::uint16_t, 3>& corners) {
    for (const std::uint16_t index : corners) {
      writer.put_signed_varint(index - last_index);
      last_index = index;
    }
  };
  for (const auto& triangle : keyframe.triangles) put_corners(triangle);
  if (keyframe.cracks.empty()) return bytes;
  writer.put_varint(keyframe.cracks.size());
  for (const Keyframe::Crack& crack : keyframe.cracks) {
    put_corners(crack.corners);
    writer.put(crack.reach);
  }
  return bytes;
}

Expected<Keyframe> decode(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  Keyframe keyframe;
  const auto refuse = [](const char* what) {
    return failure(what, "debris keyframe", "send what the same version of Septet wrote");
  };
  const auto version = reader.get<std::uint8_t>();
  if (version < without_rest || version > with_origin) return refuse("unknown version");
  const auto part = reader.get<std::uint8_t>(), material = reader.get<std::uint8_t>(),
             flags = reader.get<std::uint8_t>();
  if (!reader.ok() || part >= part_count || material >= material_count || flags > 3)
    return refuse("unknown part, material or flag");
  keyframe.part = static_cast<Part>(part);
  keyframe.material = static_cast<Material>(material);
  keyframe.shards = (flags & 1) != 0;
  keyframe.asleep = (flags & 2) != 0;
  const std::size_t vertices = reader.get_count(std::min(max_vertices, reader.remaining() / 3));
  if (!read_places(reader, vertices, keyframe.vertices_m)) return refuse("coordinate out of bounds");
  const bool rests = version == with_rest || version == with_cracks;
  if (rests && (vertices == 0 || !read_places(reader, vertices, keyframe.rest_m)))
    return refuse("place at rest out of bounds");
  if (version == with_origin && !read_origin(reader, keyframe)) return refuse("unknown origin");
  const std::size_t triangles = reader.get_count(std::min(max_triangles, reader.remaining() / 3));
  keyframe.triangles.reserve(triangles);
  std::int64_t index = 0;
  const auto read_corners = [&](std::array<std::uint16_t, 3>& corners) {
    for (auto& corner : corners) {
      const std::int64_t step = reader.get_signed_varint();
      if (!reader.ok() || step < -65536 || step > 65536) return false;
      index += step;
      if (index < 0 || index >= static_cast<std::int64_t>(vertices)) return false;
      corner = static_cast<std::uint16_t>(index);
    }
    return true;
  };
  for (std::size_t t = 0; t < triangles; ++t)
    if (!read_corners(keyframe.triangles.emplace_back())) return refuse("index out of bounds");
  if (version == with_cracks) {
    keyframe.cracks.resize(reader.get_count(std::min(max_cracks, reader.remaining() / 4)));
    for (Keyframe::Crack& crack : keyframe.cracks) {
      if (!read_corners(crack.corners)) return refuse("index out of bounds");
      crack.reach = reader.get<std::uint8_t>();
    }
    if (keyframe.cracks.empty()) return refuse("no cracks where some were announced");
  }
  if (!reader.ok() || !reader.at_end()) return refuse("length does not fit");
  return keyframe;
}

}  // namespace septet::debris
