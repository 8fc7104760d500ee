#include "engine/traffic/looks.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/core/check.hpp"

namespace septet::traffic {
namespace {

/// Shares of a model's appearances: assumed, as on a northern motorway by day.
struct Share {
  std::string_view model, look;
  int percent;
};
constexpr std::array<Share, 14> shares{{
    {"saloon", "taxi", 10},
    {"saloon", "police-car", 3},
    {"saloon", "coupe", 12},
    {"suv", "pick-up", 18},
    {"suv", "mpv", 30},
    {"van", "minibus", 14},
    {"van", "dropside-van", 14},
    {"van", "box-van", 18},
    {"van", "police-van", 2},
    {"lorry", "tanker", 14},
    {"lorry", "tipper", 14},
    {"lorry", "city-articulated", 26},
    {"lorry", "timber-lorry", 8},
    {"lorry", "coach", 12},
}};

using Hundred = std::array<ModelIndex, 100>;

ModelIndex index_of(std::string_view name) {
  const auto index = find_vehicle_model(name);
  SEPTET_CHECK(index.has_value(), "no vehicle model {}", name);
  return *index;
}

std::vector<Hundred> looks_of_all() {
  std::vector<Hundred> all(vehicle_models().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i].fill(static_cast<ModelIndex>(i));
  std::vector<std::size_t> used(all.size(), 0);
  for (const Share& share : shares) {
    const ModelIndex model = index_of(share.model), look = index_of(share.look);
    for (int i = 0; i < share.percent; ++i) all[model][used[model]++] = look;
  }
  return all;
}

}  // namespace

ModelIndex look_of(ModelIndex model, ParticipantId id) {
  static const std::vector<Hundred> looks = looks_of_all();
  // Ids are consecutive: mixed so that neighbours differ (the finaliser of MurmurHash3).
  std::uint32_t mixed = id;
  mixed = (mixed ^ (mixed >> 16)) * 0x85EBCA6Bu;
  mixed = (mixed ^ (mixed >> 13)) * 0xC2B2AE35u;
  mixed ^= mixed >> 16;
  return looks[model][mixed % 100u];
}

}  // namespace septet::traffic
