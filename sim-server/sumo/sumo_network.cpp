#include "sim-server/sumo/sumo_network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/core.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_position.hpp"

namespace septet::server {
namespace {

constexpr double straight_step_m = 10.0, curved_step_m = 2.0;
constexpr double curved_per_m = 1.0 / 1500.0;  // Chords of 10 m stay within 1 cm of anything flatter.
/// For roads without a posted limit: the drivers have their own desired speed.
constexpr double no_limit_mps = 80.0;
/// Times round a ring, for SUMO's routes have an end.
constexpr int laps = 40;

std::optional<std::size_t> find_edge(const std::vector<SumoEdge>& edges, road::RoadIndex road, std::uint32_t section,
                                     int lane) {
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges[i].road == road && edges[i].section == section &&
        std::ranges::find(edges[i].lanes, lane) != edges[i].lanes.end())
      return i;
  return std::nullopt;
}

void add_edges(const road::RoadNetwork& roads, road::RoadIndex index, std::vector<SumoEdge>& edges) {
  const road::Road& road = roads.roads[index];
  for (std::uint32_t s = 0; s < road.sections.size(); ++s) {
    const road::LaneSection& section = road.sections[s];
    for (const int side : {-1, 1}) {
      SumoEdge edge;
      for (int lane = side; section.has_lane(lane); lane += side)
        if (road::is_drivable(section.lane(lane).type)) edge.lanes.push_back(lane);
      if (edge.lanes.empty()) continue;
      edge.id = fmt::format("{}.{}.{}", index, s, side < 0 ? "right" : "left");
      edge.road = index;
      edge.section = s;
      edge.along_s = road::runs_along_s(road, section, edge.lanes.front());
      edge.begin_s_m = section.s_m;
      edge.end_s_m = s + 1 < road.sections.size() ? road.sections[s + 1].s_m : road.length_m;
      if ((side < 0) == edge.along_s) std::ranges::reverse(edge.lanes);
      edges.push_back(std::move(edge));
    }
  }
}

/// Centre line of a lane in the direction of travel.
std::vector<Vec2> centre_line(const road::RoadNetwork& roads, const SumoEdge& edge, int lane) {
  std::vector<Vec2> points;
  // A hair inside the section, where its lanes are.
  const double begin = edge.begin_s_m + 1e-6, end = edge.end_s_m - 1e-6;
  for (double s = begin;;) {
    const auto at = road::evaluate_lane(roads, {edge.road, lane, s, 0.0});
    points.emplace_back(at.road.position_m.x, at.road.position_m.y);
    if (s >= end) break;
    s = std::min(end, s + (std::abs(at.road.curvature_per_m) > curved_per_m ? curved_step_m : straight_step_m));
  }
  if (!edge.along_s) std::ranges::reverse(points);
  return points;
}

std::string shape_text(const std::vector<Vec2>& points) {
  std::string text;
  for (const Vec2& p : points) text += fmt::format("{}{:.4f},{:.4f}", text.empty() ? "" : " ", p.x, p.y);
  return text;
}

struct Link {
  std::size_t from, to;
  int from_lane, to_lane;  ///< SUMO's lane indices.
};

int index_of(const std::vector<int>& lanes, int lane) {
  return static_cast<int>(std::ranges::find(lanes, lane) - lanes.begin());
}

/// Continuation of a lane: by its links; without any, within one road, the lane of the same number, as in Septet's own
/// traffic on a file without links between the lanes of its sections.
std::vector<road::LaneContinuation> beyond(const road::RoadNetwork& roads, const SumoEdge& edge, int lane) {
  auto found = road::continuations(roads, edge.road, edge.section, lane, edge.along_s);
  if (!found.empty()) return found;
  const auto& sections = roads.roads[edge.road].sections;
  if (edge.along_s ? edge.section + 1 >= sections.size() : edge.section == 0) return found;
  const std::uint32_t next = edge.along_s ? edge.section + 1 : edge.section - 1;
  if (sections[next].has_lane(lane)) found.push_back({edge.road, next, lane, edge.along_s});
  return found;
}

std::vector<Link> links_of(const road::RoadNetwork& roads, const std::vector<SumoEdge>& edges) {
  std::vector<Link> links;
  for (std::size_t from = 0; from < edges.size(); ++from)
    for (const int lane : edges[from].lanes)
      for (const auto& next : beyond(roads, edges[from], lane))
        if (const auto to = find_edge(edges, next.road, next.section, next.lane);
            to && edges[*to].along_s == next.towards_increasing_s)
          links.push_back({from, *to, index_of(edges[from].lanes, lane), index_of(edges[*to].lanes, next.lane)});
  return links;
}

/// The posted limit that most of the edge has.
double limit_mps(const road::RoadNetwork& roads, const SumoEdge& edge, int lane) {
  const double limit = road::speed_limit_mps(roads, {edge.road, lane, 0.5 * (edge.begin_s_m + edge.end_s_m), 0.0});
  return limit > 0.0 ? limit : no_limit_mps;
}

/// Ends of edges that meet are one node: ends 2e (beginning of edge e) and 2e + 1 (its end), joined by the links.
std::vector<std::size_t> nodes_of(std::size_t edges, const std::vector<Link>& links) {
  std::vector<std::size_t> node(2 * edges);
  std::iota(node.begin(), node.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (node[i] != i) i = node[i] = node[node[i]];
    return i;
  };
  for (const Link& link : links) node[root(2 * link.from + 1)] = root(2 * link.to);
  for (std::size_t i = 0; i < node.size(); ++i) node[i] = root(i);
  return node;
}

}  // namespace

SumoNetwork make_sumo_network(const road::RoadNetwork& roads) {
  SumoNetwork network;
  for (road::RoadIndex road = 0; road < roads.roads.size(); ++road) add_edges(roads, road, network.edges);
  const auto links = links_of(roads, network.edges);
  const auto node = nodes_of(network.edges.size(), links);
  for (const Link& link : links) network.followers.emplace_back(link.from, link.to);
  std::ranges::sort(network.followers);

  std::vector<Vec2> sum(node.size(), Vec2(0.0));
  std::vector<double> count(node.size(), 0.0);
  network.edges_xml = "<edges>\n";
  for (std::size_t e = 0; e < network.edges.size(); ++e) {
    const SumoEdge& edge = network.edges[e];
    std::vector<Vec2> middle;
    std::string lanes;
    for (std::size_t i = 0; i < edge.lanes.size(); ++i) {
      const auto line = centre_line(roads, edge, edge.lanes[i]);
      if (middle.empty()) middle.assign(line.size(), Vec2(0.0));
      // All lanes of an edge are sampled at the first one's places, unless a curve begins between them: then the first
      // decides.
      if (line.size() == middle.size())
        for (std::size_t k = 0; k < line.size(); ++k) middle[k] += line[k] / static_cast<double>(edge.lanes.size());
      else if (i == 0)
        middle = line;
      const double width = road::lane_width_m(roads, edge.road, edge.lanes[i], 0.5 * (edge.begin_s_m + edge.end_s_m));
      lanes += fmt::format("  <lane index=\"{}\" speed=\"{:.2f}\" width=\"{:.2f}\" shape=\"{}\"/>\n", i,
                           limit_mps(roads, edge, edge.lanes[i]), std::max(width, 2.0), shape_text(line));
    }
    for (const auto& [end, point] : {std::pair{2 * e, middle.front()}, std::pair{2 * e + 1, middle.back()}}) {
      sum[node[end]] += point;
      count[node[end]] += 1.0;
    }
    network.edges_xml += fmt::format(
        "<edge id=\"{}\" from=\"n{}\" to=\"n{}\" numLanes=\"{}\" speed=\"{}\" spreadType=\"center\" "
        "shape=\"{}\">\n{}</edge>\n",
        edge.id, node[2 * e], node[2 * e + 1], edge.lanes.size(), no_limit_mps, shape_text(middle), lanes);
  }
  network.edges_xml += "</edges>\n";
  network.nodes_xml = "<nodes>\n";
  for (std::size_t n = 0; n < node.size(); ++n)
    if (count[n] > 0.0)
      network.nodes_xml += fmt::format("<node id=\"n{}\" x=\"{:.4f}\" y=\"{:.4f}\" type=\"priority\"/>\n", n,
                                       sum[n].x / count[n], sum[n].y / count[n]);
  network.nodes_xml += "</nodes>\n";
  network.connections_xml = "<connections>\n";
  for (const Link& link : links)
    network.connections_xml +=
        fmt::format("<connection from=\"{}\" to=\"{}\" fromLane=\"{}\" toLane=\"{}\"/>\n", network.edges[link.from].id,
                    network.edges[link.to].id, link.from_lane, link.to_lane);
  network.connections_xml += "</connections>\n";
  return network;
}

SumoPlace place_in_sumo(const SumoNetwork& network, const road::RoadNetwork& roads, const traffic::Corridor& corridor,
                        int lane, double x_m) {
  const auto at = traffic::position_at(corridor, x_m, lane);
  SumoPlace place;
  const auto section = static_cast<std::uint32_t>(road::section_index_at(roads.roads[at.road], at.s_m));
  const auto first = find_edge(network.edges, at.road, section, at.lane);
  if (!first) return place;
  const SumoEdge& edge = network.edges[*first];
  place.lane_index = index_of(edge.lanes, at.lane);
  place.along_m = edge.along_s ? at.s_m - edge.begin_s_m : edge.end_s_m - at.s_m;
  // The rest of the path: every piece of the corridor, section by section in the direction of travel.
  std::vector<std::size_t> way;
  std::size_t here = 0;
  for (const auto& piece : corridor.pieces) {
    const auto sections = static_cast<std::uint32_t>(roads.roads[piece.road].sections.size());
    for (std::uint32_t k = 0; k < sections; ++k) {
      const std::uint32_t s = piece.along_s ? k : sections - 1 - k;
      const auto found = std::ranges::find_if(network.edges, [&](const SumoEdge& e) {
        return e.road == piece.road && e.section == s && e.lanes.front() * piece.side > 0;
      });
      if (found == network.edges.end()) continue;
      if (found->road == edge.road && found->section == edge.section) here = way.size();
      way.push_back(static_cast<std::size_t>(found - network.edges.begin()));
    }
  }
  // The route ends where lanes no longer lead from edge to edge: SUMO aborts on a route with a gap.
  const std::size_t rounds = corridor.closed ? laps * way.size() : way.size() - here;
  for (std::size_t i = 0; i < rounds; ++i) {
    const std::size_t edge_now = way[(here + i) % way.size()];
    if (i > 0 && !std::ranges::binary_search(network.followers, std::pair(way[(here + i - 1) % way.size()], edge_now)))
      break;
    place.route.push_back(network.edges[edge_now].id);
  }
  return place;
}

}  // namespace septet::server
