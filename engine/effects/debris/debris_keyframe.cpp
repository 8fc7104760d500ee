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

/// Flags: places at rest follow, and cracks.
constexpr std::uint8_t without_rest = 1, with_rest = 2, with_cracks = 3;
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

}  // namespace

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
  keyframe.material = part_recipe(piece.part).material;
  keyframe.asleep = piece.asleep;
  std::map<int, std::uint16_t> place;
  for (const auto& triangle : piece.surface) {
    std::array<std::uint16_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [found, fresh] =
          place.try_emplace(triangle.nodes[c], static_cast<std::uint16_t>(keyframe.vertices_m.size()));
      if (fresh) {
        keyframe.vertices_m.push_back(from_eigen(piece.body.position_m[triangle.nodes[c]]));
        if (keyframe.material == Material::ice)
          keyframe.rest_m.push_back(from_eigen(piece.body.rest_position_m[triangle.nodes[c]]));
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
  writer.put(!keyframe.cracks.empty() ? with_cracks : keyframe.rest_m.empty() ? without_rest : with_rest);
  writer.put(static_cast<std::uint8_t>(keyframe.part));
  writer.put(static_cast<std::uint8_t>(keyframe.material));
  writer.put(static_cast<std::uint8_t>((keyframe.shards ? 1 : 0) | (keyframe.asleep ? 2 : 0)));
  writer.put_varint(keyframe.vertices_m.size());
  SEPTET_CHECK(keyframe.rest_m.empty() || keyframe.rest_m.size() == keyframe.vertices_m.size(), "{} places at rest",
               keyframe.rest_m.size());
  put_places(writer, keyframe.vertices_m);
  if (!keyframe.rest_m.empty()) put_places(writer, keyframe.rest_m);
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
  if (version < without_rest || version > with_cracks) return refuse("unknown version");
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
  if (version >= with_rest && (vertices == 0 || !read_places(reader, vertices, keyframe.rest_m)))
    return refuse("place at rest out of bounds");
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
