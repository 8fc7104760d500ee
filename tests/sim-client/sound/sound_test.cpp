#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "sim-client/frame/car_sound.hpp"
#include "sim-client/sound/sound_program.hpp"
#include "sim-client/soundtrack/session_sound.hpp"
#include "sim-client/soundtrack/wav_file.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::sound {
namespace fs = std::filesystem;
namespace {

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<std::uint8_t>(bytes.at(place + i));
  return number;
}

/// Session of so many ticks.
fs::path session_in(const TemporaryFolder& folder, Tick ticks) {
  const fs::path file = folder.path() / "session.sqlite";
  auto writer = logging::must_create(file);
  for (Tick tick = 0; tick < ticks; ++tick) writer.record(logging::taken(logging::drive_snapshot(tick)));
  REQUIRE(writer.finish());
  return file;
}

}  // namespace

TEST_CASE(
    "A sound file is a whole WAV with its lengths, loud samples stay within full scale, and nothing else is left") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.wav";
  auto wav = WavFile::create(file, 2);
  REQUIRE(wav);
  REQUIRE(wav->write(std::vector<float>{0.0f, 0.5f, -7.0f, 7.0f}));
  CHECK_FALSE(fs::exists(file));
  REQUIRE(wav->finish());
  const std::string bytes = bytes_of(file);
  REQUIRE(bytes.size() == 68 + 8);
  CHECK(bytes.substr(0, 4) == "RIFF");
  CHECK(number_at(bytes, 4) == bytes.size() - 8);
  CHECK(number_at(bytes, 64) == 8);
  CHECK(number_at(bytes, 68) == 0x40000000);
  CHECK(number_at(bytes, 72) == 0x7FFF8001);
  CHECK_FALSE(fs::exists(folder.path() / "a.wav.part"));
  CHECK(WavFile::create(file, 2).error().what == "it is there already");
}

TEST_CASE("A sound file that is given up leaves nothing, and a full disk is told of") {
  const TemporaryFolder folder;
  { REQUIRE(WavFile::create(folder.path() / "a.wav", 6)); }
  CHECK(fs::is_empty(folder.path()));
  fs::create_symlink("/dev/full", folder.path() / "b.wav.part");
  auto full = WavFile::create(folder.path() / "b.wav", 2);
  REQUIRE(full);
  Expected<void> written;
  for (int i = 0; i < 100 && written; ++i) written = full->write(std::vector<float>(1000, 0.1f));
  REQUIRE_FALSE(written);
  CHECK(written.error().what == "No space left on device");
  CHECK_FALSE(WavFile::create(folder.path() / "nowhere" / "a.wav", 2));
}

TEST_CASE("A session's sound is as long as its drive, to the sample, also of a part") {
  const TemporaryFolder folder;
  SoundOptions options;
  options.session = session_in(folder, 61);
  options.out = folder.path() / "whole.wav";
  REQUIRE(run_sound(options) == 0);
  CHECK(number_at(bytes_of(options.out), 64) == 60 * 400 * 2 * 2);
  options.out = folder.path() / "part.wav";
  options.from_s = 0.1;
  options.to_s = 0.2;
  options.stage.speakers = audio::Speakers::surround_51;
  REQUIRE(run_sound(options) == 0);
  CHECK(number_at(bytes_of(options.out), 64) == 12 * 400 * 6 * 2);
}

TEST_CASE("What cannot be heard is refused with a word and leaves no file") {
  const TemporaryFolder folder;
  SoundOptions options;
  options.out = folder.path() / "a.wav";
  options.session = session_in(folder, 61);
  options.from_s = 5.0;
  auto refused = run_sound(options);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what.find("not a part of the session") != std::string::npos);
  options.from_s.reset();
  fs::remove(options.session);
  options.session = session_in(folder, 1);  // A drive of 0 s.
  CHECK_FALSE(run_sound(options));
  options.session = folder.path() / "none.sqlite";
  CHECK_FALSE(run_sound(options));
  CHECK_FALSE(fs::exists(folder.path() / "a.wav"));
  CHECK_FALSE(fs::exists(folder.path() / "a.wav.part"));
}

TEST_CASE("Only what lets less than half of the sky in echoes") {
  instant::SceneSummary scene;
  scene.roofs = {{{}, {0, 0, 0}, {10, 10, 6}, 0.0f}, {{}, {0, 0, 0}, {10, 10, 6}, 0.8f}};
  CHECK(frame::echo_boxes(scene).size() == 1);
}

}  // namespace septet::sound
