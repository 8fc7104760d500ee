#include "sim-client/film/ghosts.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "logging/session/session_reader.hpp"
#include "sim-client/playback/session_instants.hpp"

namespace septet::film {
namespace {

constexpr double elsewhere_m = 0.3;
/// Yellow, blue, red, green of the palette.
constexpr std::array<std::uint8_t, 4> paints{11, 4, 5, 9};

/// Texts of the roads that a session was driven on.
std::vector<const std::string*> roads_of(const logging::SessionInfo& session) {
  std::vector<const std::string*> roads;
  for (const logging::SourceFile& file : session.files)
    if (file.role == "road") roads.push_back(&file.content);
  return roads;
}

bool have_same_roads(const logging::SessionInfo& a, const logging::SessionInfo& b) {
  const auto first = roads_of(a), second = roads_of(b);
  return std::ranges::equal(first, second, [](const auto* x, const auto* y) { return *x == *y; });
}

bool is_elsewhere(const Participant& ghost, const Snapshot& world) {
  const Participant* own = find_participant(world, ghost.id);
  return !own || glm::distance(own->world_from_vehicle.position_m, ghost.world_from_vehicle.position_m) > elsewhere_m;
}

}  // namespace

struct Ghosts::Other {
  logging::SessionReader session;
  std::pair<double, double> span_s;
  ParticipantId driver;
  std::optional<playback::SessionInstants> instants{};
};

Ghosts::Ghosts(std::vector<std::unique_ptr<Other>> others) : others_(std::move(others)) {}
Ghosts::Ghosts(Ghosts&&) noexcept = default;
Ghosts& Ghosts::operator=(Ghosts&&) noexcept = default;
Ghosts::~Ghosts() = default;

Expected<Ghosts> Ghosts::open(const std::vector<std::filesystem::path>& sessions, const logging::SessionInfo& film) {
  std::vector<std::unique_ptr<Other>> others;
  others.reserve(sessions.size());
  for (const auto& path : sessions) {
    auto session = logging::SessionReader::open(path);
    if (!session) return tl::unexpected(session.error());
    if (!have_same_roads(session->info(), film))
      return failure("it was driven on other roads than the film's session", path.string(),
                     "give --ghost a session of the same roads");
    const auto span_s = session->shown_span_s();
    if (!span_s) return tl::unexpected(span_s.error());
    auto cursor = session->snapshots();
    if (!cursor) return tl::unexpected(cursor.error());
    const auto first = cursor->next();
    if (!first) return tl::unexpected(first.error());
    const ParticipantId driver = *first ? (*first)->driver_car.participant : 0;
    others.push_back(std::make_unique<Other>(Other{std::move(*session), *span_s, driver}));
  }
  return Ghosts(std::move(others));
}

void Ghosts::begin_shot() {
  for (const auto& other : others_) other->instants.reset();
}

std::vector<ParticipantId> Ghosts::drivers() const {
  std::vector<ParticipantId> drivers;
  drivers.reserve(others_.size());
  for (std::size_t n = 0; n < others_.size(); ++n) drivers.push_back(ghost_number(n, others_[n]->driver));
  return drivers;
}

Expected<void> Ghosts::add_to(Snapshot& world, double instant_s) {
  std::vector<Participant> ghosts;
  for (std::size_t n = 0; n < others_.size(); ++n) {
    Other& other = *others_[n];
    if (instant_s < other.span_s.first || instant_s > other.span_s.second) continue;
    if (!other.instants) {
      auto instants = playback::SessionInstants::start(other.session, instant_s);
      if (!instants) return tl::unexpected(instants.error());
      other.instants.emplace(std::move(*instants));
    }
    auto there = other.instants->at(instant_s);
    if (!there) return tl::unexpected(there.error());
    for (Participant& participant : there->participants) {
      if (participant.id >= numbers_a_ghost_session || !is_elsewhere(participant, world)) continue;
      participant.id = ghost_number(n, participant.id);
      participant.paint = paints[n % paints.size()];
      ghosts.push_back(participant);
    }
  }
  world.participants.insert(world.participants.end(), ghosts.begin(), ghosts.end());
  return {};
}

}  // namespace septet::film
