#include "sim-client/soundtrack/cut_track.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/audio/signal.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::sound {
namespace {

namespace fs = std::filesystem;

/// Session of two seconds with no sound but the car's own horn, from 1.0 to 1.1 s.
fs::path session_with_horn(const TemporaryFolder& folder) {
  const fs::path file = folder.path() / "session.sqlite";
  auto writer = logging::must_create(file);
  for (Tick tick = 0; tick <= 240; ++tick) {
    Snapshot snapshot;
    snapshot.tick = tick;
    snapshot.simulated_time_s = static_cast<double>(tick) / 120.0;
    snapshot.driver_car.participant = 1;
    Participant own;
    own.id = 1;
    own.lamps.set(Lamp::horn, tick >= 120 && tick < 132);
    snapshot.participants = {own};
    writer.record(logging::taken(std::move(snapshot)));
  }
  REQUIRE(writer.finish());
  return file;
}

/// Samples of the left channel.
std::vector<double> samples_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::vector<double> samples;
  for (std::size_t i = 68; i + 4 <= bytes.size(); i += 4)
    samples.push_back(
        static_cast<std::int16_t>(static_cast<std::uint8_t>(bytes[i]) | static_cast<std::uint8_t>(bytes[i + 1]) << 8) /
        32768.0);
  return samples;
}

double onset_s(const std::vector<double>& samples, double from_s) {
  for (auto i = static_cast<std::size_t>(from_s * audio::sample_rate_hz); i < samples.size(); ++i)
    if (std::abs(samples[i]) > 0.01) return static_cast<double>(i) / audio::sample_rate_hz;
  return -1.0;
}

std::size_t crossings(const std::vector<double>& samples, double from_s, double to_s) {
  std::size_t count = 0;
  for (auto i = static_cast<std::size_t>(from_s * audio::sample_rate_hz) + 1;
       i < static_cast<std::size_t>(to_s * audio::sample_rate_hz); ++i)
    count += samples[i - 1] < 0.0 && samples[i] >= 0.0 ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE(
    "each shot's horn is heard when its picture is seen, also in slow motion and behind a cut, and the film is as long "
    "as its frames") {
  const TemporaryFolder folder;
  const auto session = logging::SessionReader::open(session_with_horn(folder));
  REQUIRE(session);
  const fs::path file = folder.path() / "film.wav";
  const std::vector<Cut> cuts{{.from_s = 0.5, .speed = 1.0, .frames = 25},
                              {.from_s = 0.75, .speed = 0.5, .frames = 25},
                              {.from_s = 0.9, .speed = 1.0, .frames = 5},
                              {.from_s = 0.6, .speed = 2.0, .frames = 10},
                              {.from_s = 1.9, .speed = 1.0, .frames = 10}};  // Beyond the session's end.
  const auto written = write_cut_track(*session, cuts, 25.0, file, [] { return true; });
  REQUIRE_MESSAGE(written.has_value(), why_not(written));
  const auto samples = samples_of(file);
  CHECK(samples.size() == 75u * 48000u / 25u);
  constexpr double well_within_a_frame_s = 0.012;
  CHECK(std::abs(onset_s(samples, 0.0) - 0.5) < well_within_a_frame_s);
  CHECK(std::abs(onset_s(samples, 1.0) - 1.5) < well_within_a_frame_s);
  CHECK(std::abs(onset_s(samples, 2.0) - 2.1) < well_within_a_frame_s);
  CHECK(std::abs(onset_s(samples, 2.2) - 2.4) < well_within_a_frame_s);
  CHECK(onset_s(samples, 2.6) == -1.0);
  // Pitch of a tape at half speed.
  CHECK(static_cast<double>(crossings(samples, 0.52, 0.58)) ==
        relative(static_cast<double>(crossings(samples, 1.54, 1.66)), 0.1));
}

TEST_CASE("a film's sound that is given up leaves no file") {
  const TemporaryFolder folder;
  const auto session = logging::SessionReader::open(session_with_horn(folder));
  REQUIRE(session);
  int blocks = 0;
  const auto written = write_cut_track(*session, {{.from_s = 0.0, .speed = 1.0, .frames = 50}}, 25.0,
                                       folder.path() / "film.wav", [&] { return ++blocks < 10; });
  REQUIRE(written);
  CHECK_FALSE(*written);
  CHECK_FALSE(fs::exists(folder.path() / "film.wav"));
  CHECK_FALSE(fs::exists(folder.path() / "film.wav.part"));
}

}  // namespace septet::sound
