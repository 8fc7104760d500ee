// Hostile bytes against a screen's decoding of a tick: the snapshot, as a keyframe and as a difference, and the
// effects' keyframes in it. The first byte chooses. Accepted bytes must come back from their own encoder.

#include <cstdlib>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/ice/glass_keyframe.hpp"
#include "engine/effects/ice/ice_keyframe.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/effects/smoke/soot_keyframe.hpp"
#include "engine/world/wire_snapshot.hpp"

namespace {

using namespace septet;

void require(bool condition) {
  if (!condition) std::abort();
}

void feed_snapshots(ByteReader& input) {
  const auto first_bytes = input.take(std::min<std::size_t>(input.get<std::uint16_t>(), input.remaining()));
  const auto first = decode_snapshot(first_bytes, nullptr);
  if (!first) return;
  Bytes again;
  encode_snapshot(*first, nullptr, again);
  const auto returned = decode_snapshot(again, nullptr);
  require(returned && returned->participants == first->participants && returned->rest.effects == first->rest.effects);
  const auto second = decode_snapshot(input.take(input.remaining()), &*first);
  if (!second || second->rest.tick <= first->rest.tick) return;
  Bytes difference;
  encode_snapshot(*second, &*first, difference);
  const auto came_back = decode_snapshot(difference, &*first);
  require(came_back && came_back->participants == second->participants &&
          came_back->rest.effects == second->rest.effects);
}

void feed_debris(std::span<const std::byte> bytes) {
  const auto keyframe = debris::decode(bytes);
  if (!keyframe) return;
  for (const auto& triangle : keyframe->triangles)
    for (const auto corner : triangle) require(corner < keyframe->vertices_m.size());
  require(debris::decode(debris::encode(*keyframe)).has_value());
}

void feed_smoke(std::span<const std::byte> bytes) {
  const auto keyframe = smoke::decode(bytes);
  if (!keyframe) return;
  std::vector<smoke::Puff> puffs;
  smoke::add_puffs(*keyframe, keyframe->time_s + 0.1, puffs);
}

void feed_soot(std::span<const std::byte> bytes) {
  const auto keyframe = smoke::decode_soot(bytes);
  if (!keyframe) return;
  require(keyframe->level.size() == static_cast<std::size_t>(keyframe->nx) * keyframe->ny * keyframe->nz);
  for (const std::uint8_t level : keyframe->level) require(level < smoke::soot_levels);
}

void feed_ice(std::span<const std::byte> bytes) {
  const auto ice = ice::decode(bytes);
  if (!ice) return;
  require(ice::decode(ice::encode(*ice)).has_value());
  for (const ice::IcicleRow& row : ice->rows)
    for (const ice::Icicle& icicle : ice::icicles_of(row, ice->thawed_kh)) require(icicle.length_m >= 0.0);
}

void feed_glass(std::span<const std::byte> bytes) {
  const auto panes = ice::decode_glass(bytes);
  if (!panes) return;
  const Bytes again = ice::encode_glass(*panes);
  require(ice::decode_glass(again).has_value());
  const ice::PaneShape shape = ice::pane_between({1, -1, 1}, {1, 1, 1}, {0.5, -1, 1.5}, {0.5, 1, 1.5}, 0.04);
  for (ice::Pane pane : *panes) {
    ice::warm(pane.frost, ice::freezing_k, 10.0, 0.1);
    for (const ice::Star& star : pane.stars) require(ice::star_surface(shape, star).size() % 3 == 0);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteReader input(std::as_bytes(std::span(data, size)));
  switch (input.get<std::uint8_t>() % 6) {
    case 0:
      feed_snapshots(input);
      break;
    case 1:
      feed_debris(input.take(input.remaining()));
      break;
    case 2:
      feed_smoke(input.take(input.remaining()));
      break;
    case 3:
      feed_soot(input.take(input.remaining()));
      break;
    case 4:
      feed_glass(input.take(input.remaining()));
      break;
    default:
      feed_ice(input.take(input.remaining()));
      break;
  }
  return 0;
}
