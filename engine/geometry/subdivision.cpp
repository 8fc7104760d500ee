#include "engine/geometry/subdivision.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/core.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "engine/core/check.hpp"

namespace septet::geometry {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A vector with the two functions that OpenSubdiv's refiner requires of interpolated values.
template <class Vector>
struct Blend {
  Vector value;
  void Clear(void* = nullptr) { value = Vector(0.0f); }
  void AddWithWeight(const Blend& source, float weight) { value += weight * source.value; }
};

/// The crease of every edge that has one, by its lower and higher vertex; sorted.
using EdgeCreases = std::vector<std::pair<std::array<std::uint32_t, 2>, std::uint32_t>>;

std::array<std::uint32_t, 2> edge_key(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::uint32_t crease_at(const PolygonMesh& mesh, std::size_t polygon, std::uint32_t corner) {
  return mesh.edge_creases.empty() ? mesh.default_edge_crease : mesh.edge_creases[polygon][corner];
}

EdgeCreases edge_creases(const PolygonMesh& mesh) {
  EdgeCreases creases;
  if (mesh.edge_creases.empty() && mesh.default_edge_crease == crease_smooth) return creases;
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    const std::uint32_t count = corner_count(mesh.polygons[p]);
    for (std::uint32_t k = 0; k < count; ++k)
      if (const std::uint32_t crease = crease_at(mesh, p, k); crease != crease_smooth)
        creases.push_back({edge_key(mesh.polygons[p][k], mesh.polygons[p][(k + 1) % count]), crease});
  }
  // Of two entries for one edge the sharper stays: it is sorted to the front of its equals.
  std::sort(creases.begin(), creases.end(),
            [](const auto& a, const auto& b) { return std::pair(a.first, ~a.second) < std::pair(b.first, ~b.second); });
  const auto same_edge = [](const auto& a, const auto& b) { return a.first == b.first; };
  creases.erase(std::unique(creases.begin(), creases.end(), same_edge), creases.end());
  return creases;
}

std::uint32_t crease_of(const EdgeCreases& creases, std::uint32_t a, std::uint32_t b) {
  const auto key = edge_key(a, b);
  const auto found = std::lower_bound(creases.begin(), creases.end(), key,
                                      [](const auto& entry, const auto& wanted) { return entry.first < wanted; });
  return found != creases.end() && found->first == key ? found->second : crease_smooth;
}

std::uint32_t vertex_crease(const PolygonMesh& mesh, std::size_t vertex) {
  return mesh.vertex_creases.empty() ? mesh.default_vertex_crease : mesh.vertex_creases[vertex];
}

/// Sharpness for one level: a weight below one blends, OpenSubdiv's infinity is sharp.
float one_level_sharpness(std::uint32_t crease) {
  return crease == crease_sharp ? Sdc::Crease::SHARPNESS_INFINITE
                                : std::min(static_cast<float>(sharp_weight(crease)), 0.999999f);
}

/// OpenSubdiv's description of the mesh; the descriptor points into the vectors.
struct Topology {
  std::vector<int> face_sizes, face_vertices, creased_pairs, creased_vertices, uv_indices;
  std::vector<float> edge_sharpness, vertex_sharpness;
  Far::TopologyDescriptor::FVarChannel uv_channel;
  Far::TopologyDescriptor descriptor;
};

void fill(Topology& topology, const PolygonMesh& mesh, const EdgeCreases& creases) {
  for (const PolygonCorners& corners : mesh.polygons) {
    const std::uint32_t count = corner_count(corners);
    topology.face_sizes.push_back(static_cast<int>(count));
    for (std::uint32_t k = 0; k < count; ++k) topology.face_vertices.push_back(static_cast<int>(corners[k]));
  }
  for (const auto& [edge, crease] : creases) {
    topology.creased_pairs.insert(topology.creased_pairs.end(), {static_cast<int>(edge[0]), static_cast<int>(edge[1])});
    topology.edge_sharpness.push_back(one_level_sharpness(crease));
  }
  for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v)
    if (const std::uint32_t crease = vertex_crease(mesh, v); crease != crease_smooth) {
      topology.creased_vertices.push_back(static_cast<int>(v));
      topology.vertex_sharpness.push_back(one_level_sharpness(crease));
    }
  Far::TopologyDescriptor& d = topology.descriptor;
  d.numVertices = static_cast<int>(mesh.vertices_m.size());
  d.numFaces = static_cast<int>(mesh.polygons.size());
  d.numVertsPerFace = topology.face_sizes.data();
  d.vertIndicesPerFace = topology.face_vertices.data();
  d.numCreases = static_cast<int>(topology.edge_sharpness.size());
  d.creaseVertexIndexPairs = topology.creased_pairs.data();
  d.creaseWeights = topology.edge_sharpness.data();
  d.numCorners = static_cast<int>(topology.vertex_sharpness.size());
  d.cornerVertexIndices = topology.creased_vertices.data();
  d.cornerWeights = topology.vertex_sharpness.data();
  if (!mesh.corner_uvs.empty()) {
    // Every corner has a value of its own, so that seams of the texture need no bookkeeping.
    for (std::size_t i = 0; i < topology.face_vertices.size(); ++i) topology.uv_indices.push_back(static_cast<int>(i));
    topology.uv_channel.numValues = static_cast<int>(topology.uv_indices.size());
    topology.uv_channel.valueIndices = topology.uv_indices.data();
    d.numFVarChannels = 1;
    d.fvarChannels = &topology.uv_channel;
  }
}

std::unique_ptr<Far::TopologyRefiner> refine_once(const Topology& topology, bool triangles) {
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_ALL);
  options.SetTriangleSubdivision(Sdc::Options::TRI_SUB_SMOOTH);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const Factory::Options factory(triangles ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK, options);
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(topology.descriptor, factory));
  if (refiner) refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(1));
  return refiner;
}

/// Creases of the next level: a vertex's own, and an edge's on both of its halves; edges inside a face are smooth.
void inherit_creases(const PolygonMesh& mesh, const EdgeCreases& creases, const Far::TopologyLevel& parent,
                     PolygonMesh& refined) {
  if (!mesh.vertex_creases.empty() || mesh.default_vertex_crease != crease_smooth) {
    refined.vertex_creases.assign(refined.vertices_m.size(), crease_smooth);
    for (int v = 0; v < parent.GetNumVertices(); ++v)
      refined.vertex_creases[static_cast<std::size_t>(parent.GetVertexChildVertex(v))] =
          vertex_crease(mesh, static_cast<std::size_t>(v));
  }
  if (creases.empty()) return;
  EdgeCreases halves;
  for (int e = 0; e < parent.GetNumEdges(); ++e) {
    const auto ends = parent.GetEdgeVertices(e);
    const auto crease = crease_of(creases, static_cast<std::uint32_t>(ends[0]), static_cast<std::uint32_t>(ends[1]));
    if (crease == crease_smooth) continue;
    const auto middle = static_cast<std::uint32_t>(parent.GetEdgeChildVertex(e));
    for (const int end : {ends[0], ends[1]})
      halves.push_back({edge_key(static_cast<std::uint32_t>(parent.GetVertexChildVertex(end)), middle), crease});
  }
  std::sort(halves.begin(), halves.end());
  for (const PolygonCorners& corners : refined.polygons) {
    auto& values = refined.edge_creases.emplace_back();
    const std::uint32_t count = corner_count(corners);
    for (std::uint32_t k = 0; k < count; ++k) values[k] = crease_of(halves, corners[k], corners[(k + 1) % count]);
  }
}

Expected<PolygonMesh> subdivide_once(const PolygonMesh& mesh) {
  const EdgeCreases creases = edge_creases(mesh);
  const bool triangles = std::all_of(mesh.polygons.begin(), mesh.polygons.end(), is_triangle);
  Topology topology;
  fill(topology, mesh, creases);
  const auto refiner = refine_once(topology, triangles);
  if (!refiner)
    return failure("OpenSubdiv finds no topology in the polygons", "control cage",
                   "use polygons with distinct corners");
  const Far::TopologyLevel& parent = refiner->GetLevel(0);
  const Far::TopologyLevel& child = refiner->GetLevel(1);
  const Far::PrimvarRefiner refine(*refiner);

  PolygonMesh refined;
  std::vector<Blend<glm::vec3>> from(mesh.vertices_m.size()), to(static_cast<std::size_t>(child.GetNumVertices()));
  for (std::size_t i = 0; i < from.size(); ++i) from[i].value = mesh.vertices_m[i];
  refine.Interpolate(1, from, to);
  for (const auto& blend : to) refined.vertices_m.push_back(blend.value);

  std::vector<Blend<glm::vec2>> uvs;
  if (!mesh.corner_uvs.empty()) {
    std::vector<Blend<glm::vec2>> corners;
    for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
      for (std::uint32_t k = 0; k < corner_count(mesh.polygons[p]); ++k) corners.push_back({mesh.corner_uvs[p][k]});
    uvs.resize(static_cast<std::size_t>(child.GetNumFVarValues()));
    refine.InterpolateFaceVarying(1, corners, uvs);
  }
  for (int f = 0; f < child.GetNumFaces(); ++f) {
    const auto vertices = child.GetFaceVertices(f);
    PolygonCorners corners{no_vertex, no_vertex, no_vertex, no_vertex};
    for (int k = 0; k < vertices.size(); ++k)
      corners[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(vertices[k]);
    refined.polygons.push_back(corners);
    const auto parent_face = static_cast<std::size_t>(child.GetFaceParentFace(f));
    if (!mesh.polygon_materials.empty()) refined.polygon_materials.push_back(mesh.polygon_materials[parent_face]);
    if (uvs.empty()) continue;
    auto& corner_uvs = refined.corner_uvs.emplace_back();
    const auto values = child.GetFaceFVarValues(f);
    for (int k = 0; k < values.size(); ++k)
      corner_uvs[static_cast<std::size_t>(k)] = uvs[static_cast<std::size_t>(values[k])].value;
  }
  inherit_creases(mesh, creases, parent, refined);
  return refined;
}

}  // namespace

Expected<PolygonMesh> subdivide(const PolygonMesh& cage, std::uint32_t levels) {
  for (std::size_t p = 0; p < cage.polygons.size(); ++p)
    for (std::uint32_t k = 0; k < corner_count(cage.polygons[p]); ++k)
      if (cage.polygons[p][k] >= cage.vertices_m.size())
        return failure(fmt::format("polygon {} names vertex {} of {}", p, cage.polygons[p][k], cage.vertices_m.size()),
                       "control cage", "name vertices that exist");
  PolygonMesh mesh = cage;
  if (cage.polygons.empty()) return mesh;
  for (std::uint32_t level = 0; level < levels; ++level) {
    auto refined = subdivide_once(mesh);
    if (!refined) return refined;
    mesh = std::move(*refined);
  }
  return mesh;
}

}  // namespace septet::geometry
