#include "sim-client/film/overlay/overlay_cast.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/world/rider.hpp"
#include "logging/session/participants.hpp"

namespace septet::film {
namespace {

constexpr double place_every_s = 0.1;
constexpr std::size_t longest_label = 24;

Expected<std::vector<OverlayWay>> read_ways(const logging::SessionReader& session,
                                            const std::vector<OverlayPerson>& people, double from_s, double to_s) {
  std::vector<OverlayWay> ways(people.size());
  auto cursor = session.snapshots_from(from_s);
  if (!cursor) return tl::unexpected(cursor.error());
  double next_s = from_s;
  for (;;) {
    const auto world = cursor->next();
    if (!world) return tl::unexpected(world.error());
    if (!*world || (*world)->simulated_time_s > to_s) return ways;
    if ((*world)->simulated_time_s < next_s - 1e-6) continue;
    next_s = (*world)->simulated_time_s + place_every_s;
    for (std::size_t n = 0; n < people.size(); ++n)
      if (const Participant* participant = find_person(**world, people[n].number)) {
        ways[n].times_s.push_back((*world)->simulated_time_s);
        ways[n].places_m.push_back(participant->world_from_vehicle.position_m);
      }
  }
}

}  // namespace

Expected<OverlayCast> OverlayCast::of(const logging::SessionReader& session, const Script& script) {
  OverlayCast cast;
  if (std::ranges::none_of(script.shots, &Shot::overlay)) return cast;
  auto font = image::Font::find(image::FontStyle::bold);
  if (!font) return tl::unexpected(font.error());
  cast.font.emplace(std::move(*font));
  const auto names = logging::participant_names(session);
  if (!names) return tl::unexpected(names.error());
  for (const std::string& text : script.overlay.participants) {
    std::optional<ParticipantId> number = logging::number_of(*names, text);
    if (text == "driver") {
      const auto stay = logging::find_stay(session, text, "overlay.participants");
      if (!stay) return tl::unexpected(stay.error());
      number = stay->number;
    }
    if (!number)
      return failure(fmt::format("nobody in the session is called \"{}\"", printable(text, 100)),
                     "overlay.participants", "write \"driver\", a name of the scenario or a number");
    const auto name = names->find(*number);
    cast.people.push_back({*number, printable(name == names->end() ? text : name->second, longest_label)});
  }
  double from_s = 1e300, to_s = -1e300;
  for (const Shot& shot : script.shots)
    if (shot.paths) from_s = std::min(from_s, shot.from_s), to_s = std::max(to_s, shot.to_s);
  if (from_s >= to_s) return cast;
  auto ways = read_ways(session, cast.people, from_s, to_s);
  if (!ways) return tl::unexpected(ways.error());
  cast.ways = std::move(*ways);
  return cast;
}

}  // namespace septet::film
