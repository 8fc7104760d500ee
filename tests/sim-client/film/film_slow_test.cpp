#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/image/image.hpp"
#include "engine/image/png.hpp"
#include "engine/light/tone_curve.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "sim-client/film/film.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/traced/layers.hpp"
#include "sim-client/soundtrack/wav_file.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/relative.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

#if defined(__has_feature)
#define SEPTET_WITH_ASAN __has_feature(address_sanitizer)
#else
#define SEPTET_WITH_ASAN 0
#endif

namespace septet::film {
namespace {
namespace fs = std::filesystem;

Bytes bytes_of(const fs::path& file) {
  CAPTURE(file);
  std::ifstream stream(file, std::ios::binary);
  REQUIRE(stream.good());
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return Bytes(begin, begin + text.size());
}

/// A second's drive on a circle, from which participant 2 vanishes between two frames of a film, and a shot through
/// their eyes.
void write_session_and_shots(const TemporaryFolder& folder) {
  {
    auto writer = logging::must_create(folder / "session.sqlite");
    for (Tick tick = 0; tick <= 120; ++tick) {
      Snapshot snapshot = logging::drive_snapshot(tick);
      for (Participant& participant : snapshot.participants) participant.world_from_vehicle.position_m.z = 1.0;
      // Between two frames of the film, so that where he was last is not where a frame saw him.
      if (tick > 51)
        std::erase_if(snapshot.participants, [](const Participant& participant) { return participant.id == 2; });
      writer.record(logging::taken(snapshot));
    }
    REQUIRE(writer.finish().has_value());
  }
  // View from a place to the side of the two, which turn with the sky behind them.
  std::ofstream(folder / "shots.toml") << "[[shot]]\nfrom_s = 0\nto_s = 1\nparticipant = \"2\"\nshutter_deg = 360\n";
}

/// Output of a program.
std::string printed_by(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  REQUIRE(::pclose(pipe) == 0);
  return text;
}

std::string refusal_of(const FilmOptions& options) {
  const auto made = make_film(options, [](const FilmMade&) { return true; });
  return why_not(made);
}

template <class Value>
std::vector<Value> channel(Imf::InputFile& file, const char* name, Imf::PixelType type) {
  const Imath::Box2i window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x) + 1;
  std::vector<Value> values(width * (static_cast<std::size_t>(window.max.y) + 1));
  Imf::FrameBuffer buffer;
  buffer.insert(name, Imf::Slice(type, reinterpret_cast<char*>(values.data()), sizeof(Value), sizeof(Value) * width));
  file.setFrameBuffer(buffer);
  file.readPixels(0, window.max.y);
  return values;
}

double resident_mib() {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kib = 0.0;
  while (status >> word)
    if (word == "VmRSS:") status >> kib;
  return kib / 1024.0;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a film begun in the middle shows frame by frame what the whole film shows though somebody has vanished") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  const FilmRenderer renderers[] = {FilmRenderer::raster, FilmRenderer::traced};
  for (const FilmRenderer renderer : renderers) {
    const std::string name = renderer == FilmRenderer::raster ? "raster" : "traced";
    CAPTURE(name);
    FilmOptions options{.session = folder / "session.sqlite",
                        .shots = folder / "shots.toml",
                        .out = folder / (name + "-whole"),
                        .width_px = 64,
                        .height_px = 48,
                        .software = true,
                        .renderer = renderer,
                        .samples = 2};
    const auto goes_on = [](const FilmMade&) { return true; };
    const auto whole = make_film(options, goes_on);
    REQUIRE_MESSAGE(whole.has_value(), why_not(whole));
    REQUIRE(whole->frames == 25);
    options.out = folder / (name + "-end");
    options.from_s = 0.6;
    const auto end = make_film(options, goes_on);
    REQUIRE_MESSAGE(end.has_value(), why_not(end));
    CHECK(end->frames == 10);
    CHECK(end->bad_samples == 0);
    CHECK(std::distance(fs::directory_iterator(options.out), {}) == 11);  // And film.json; the preview is gone.
    for (const fs::directory_entry& picture : fs::directory_iterator(options.out)) {
      const fs::path file = picture.path().filename();
      CAPTURE(file);
      CHECK(bytes_of(picture.path()) == bytes_of(folder / (name + "-whole") / file));
    }
  }
}

TEST_CASE("a traced film of a thousand frames takes no more memory at its end than after the first hundred") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  const FilmOptions options{.session = folder / "session.sqlite",
                            .shots = folder / "shots.toml",
                            .out = folder / "film",
                            .frames_per_second = 1000.0,
                            .width_px = 8,
                            .height_px = 8,
                            .renderer = FilmRenderer::traced,
                            .samples = 1};
  double early_mib = 0.0, late_mib = 0.0;
  const auto made = make_film(options, [&](const FilmMade& so_far) {
    if (early_mib == 0.0 && so_far.frames >= 100) early_mib = resident_mib();
    if (so_far.frames >= 990) late_mib = resident_mib();
    return true;
  });
  REQUIRE_MESSAGE(made.has_value(), why_not(made));
  CHECK(made->frames >= 1000);
  MESSAGE("after 100 frames ", early_mib, " MiB, after 990 ", late_mib);
  REQUIRE(early_mib > 0.0);
#if !defined(__SANITIZE_ADDRESS__) && !SEPTET_WITH_ASAN  // The sanitizer keeps freed memory, and finds leaks itself.
  CHECK(late_mib < early_mib + 4.0);                     // 4.6 KiB a frame.
#endif
}

TEST_CASE("OpenEXR pictures hold the light of the pictures and stay those of a film that was not stopped") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  std::ofstream(folder / "shots.toml") << "[[shot]]\nfrom_s = 0.2\nto_s = 0.3\nparticipant = \"1\"\n";
  FilmOptions options{.session = folder / "session.sqlite",
                      .shots = folder / "shots.toml",
                      .out = folder / "film",
                      .width_px = 64,
                      .height_px = 48,
                      .renderer = FilmRenderer::traced,
                      .samples = 2,
                      .exr = ExrNumbers::single_precision,
                      .layers = {Layer::depth, Layer::object, Layer::participant, Layer::normal, Layer::albedo},
                      .to_s = 0.26};
  // Stopped by a person between the tiles of the second frame: the finished tiles are kept.
  const auto stopped =
      make_film(options, [](const FilmMade& so_far) { return so_far.frames < 1 || so_far.share_of_next < 0.4; });
  REQUIRE(stopped.has_value());
  REQUIRE(stopped->stopped);
  options.resume = true;
  fs::resize_file(options.out / "000001.exr", fs::file_size(options.out / "000001.exr") - 50);
  REQUIRE(refusal_of(options) == "");
  options.resume = false;
  options.out = folder / "at once";
  REQUIRE(refusal_of(options) == "");
  for (const char* name : {"000001.exr", "000002.exr", "000002.png"})
    CHECK(bytes_of(options.out / name) == bytes_of(folder / "film" / name));

  Imf::InputFile file((options.out / "000002.exr").c_str());
  CHECK(file.header().typedAttribute<Imf::DoubleAttribute>("septet.instant_s").value() == doctest::Approx(0.24));
  CHECK(file.header().typedAttribute<Imf::DoubleAttribute>("septet.tick").value() == doctest::Approx(28.8));
  CHECK(file.header().typedAttribute<Imf::StringAttribute>("septet.seed").value() == "2");
  const std::string seeds = file.header().typedAttribute<Imf::StringAttribute>("septet.drive_seeds").value();
  CHECK(has(seeds, "traffic"));
  CHECK(seeds.back() != '\n');
  const std::vector<float> red = channel<float>(file, "R", Imf::FLOAT), depth = channel<float>(file, "Z", Imf::FLOAT);
  const auto what = channel<std::uint32_t>(file, "object", Imf::UINT);
  const auto picture = image::read_png(options.out / "000002.png");
  REQUIRE(picture.has_value());
  bool light_is_that = true, sky_is_nothing = true;
  for (std::size_t n = 0; n < red.size(); ++n) {
    const float code = 255.0f * std::clamp(light::display_code(glm::vec3(red[n])).x, 0.0f, 1.0f);
    light_is_that = light_is_that && std::abs(code - static_cast<float>(picture->rgba[4 * n])) <= 0.51f;
    sky_is_nothing = sky_is_nothing && (what[n] == 0) == std::isinf(depth[n]);
  }
  CHECK(light_is_that);
  CHECK(sky_is_nothing);
}

TEST_CASE("no layer changes a pixel, and that of motion tells the ways of what moves") {
  const TemporaryFolder folder;
  {
    auto writer = logging::must_create(folder / "session.sqlite");
    scene::Store store;
    scene::SceneBuilder builder(store, [&](const scene::Command& command) {
      Bytes bytes;
      scene::encode(command, bytes);
      writer.record(logging::SceneEdit{0, std::move(bytes)});
    });
    scenery::build_vehicles(builder);
    for (Tick tick = 0; tick <= 60; ++tick) writer.record(logging::taken(logging::drive_snapshot(tick)));
    REQUIRE(writer.finish().has_value());
  }
  std::ofstream(folder / "shots.toml") << "[[shot]]\nfrom_s = 0.2\nto_s = 0.3\nparticipant = \"1\"\ndistance_m = 9\n";
  FilmOptions options{.session = folder / "session.sqlite",
                      .shots = folder / "shots.toml",
                      .out = folder / "without",
                      .width_px = 160,
                      .height_px = 120,
                      .renderer = FilmRenderer::traced,
                      .samples = 9,
                      .exr = ExrNumbers::single_precision,
                      .to_s = 0.26};
  REQUIRE(refusal_of(options) == "");
  options.out = folder / "with";
  REQUIRE(read_layers("all", options.layers) == "");
  const auto made = make_film(options, [](const FilmMade&) { return true; });
  REQUIRE_MESSAGE(made.has_value(), why_not(made));
  CHECK(made->notice.empty());
  for (const char* name : {"000001", "000002"}) {
    const auto picture = fmt::format("{}.png", name), light = fmt::format("{}.exr", name);
    CHECK(bytes_of(folder / "with" / picture) == bytes_of(folder / "without" / picture));
    Imf::InputFile with((folder / "with" / light).c_str()), without((folder / "without" / light).c_str());
    CHECK(channel<float>(with, "R", Imf::FLOAT) == channel<float>(without, "R", Imf::FLOAT));
    const std::vector<float> across = channel<float>(with, "motion.X", Imf::FLOAT);
    CHECK(std::ranges::any_of(across, [](float px) { return std::abs(px) > 0.5f; }));
  }
}

TEST_CASE("OpenEXR pictures are refused where there are none and layers without them") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  FilmOptions options{.session = folder / "session.sqlite", .shots = folder / "shots.toml", .out = folder / "film"};
  options.exr = ExrNumbers::half_precision;
  CHECK(has(refusal_of(options), "add --renderer traced"));
  options.renderer = FilmRenderer::traced;
  options.exr = ExrNumbers::none;
  options.layers = {Layer::depth};
  CHECK(has(refusal_of(options), "add --exr half"));
  CHECK_FALSE(fs::exists(options.out));
}

TEST_CASE("a film of a session without a scene says that it shows nobody") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  const FilmOptions options{.session = folder / "session.sqlite",
                            .shots = folder / "shots.toml",
                            .out = folder / "film",
                            .width_px = 64,
                            .height_px = 48,
                            .renderer = FilmRenderer::traced,
                            .samples = 1};
  const auto made = make_film(options, [](const FilmMade&) { return false; });
  REQUIRE_MESSAGE(made.has_value(), why_not(made));
  CHECK(has(made->notice, "session.sqlite: it keeps no scene"));
}

TEST_CASE("a film that is stopped while a frame is traced ends there") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  const FilmOptions options{.session = folder / "session.sqlite",
                            .shots = folder / "shots.toml",
                            .out = folder / "film",
                            .width_px = 64,
                            .height_px = 48,
                            .renderer = FilmRenderer::traced,
                            .samples = 2};
  const auto made =
      make_film(options, [](const FilmMade& so_far) { return so_far.frames < 2 || so_far.share_of_next < 0.4; });
  REQUIRE(made.has_value());
  CHECK(made->frames == 2);
  CHECK(made->stopped);
  CHECK(fs::exists(options.out / "000003.tiles"));  // The traced tiles are kept.
  CHECK(std::distance(fs::directory_iterator(options.out), {}) == 4);
}

TEST_CASE("a film that was stopped goes on where it was and is the film that was not") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  FilmOptions options{.session = folder / "session.sqlite",
                      .shots = folder / "shots.toml",
                      .out = folder / "whole",
                      .width_px = 64,
                      .height_px = 48,
                      .renderer = FilmRenderer::traced,
                      .samples = 2,
                      .to_s = 0.4};
  REQUIRE(refusal_of(options) == "");
  options.out = folder / "stopped";
  const auto stopped = make_film(options, [](const FilmMade& so_far) { return so_far.frames < 5; });
  REQUIRE(stopped.has_value());
  CHECK(stopped->stopped);
  CHECK(has(refusal_of(options), "add --resume"));
  options.resume = true;
  options.samples = 3;
  CHECK(has(refusal_of(options), "another samples: 2, not 3"));
  options.samples = 2;
  // State after a power cut, and after a kill.
  fs::resize_file(options.out / "000002.png", fs::file_size(options.out / "000002.png") / 2);
  std::ofstream(options.out / "000006.png.part") << "half";
  std::string beside;
  const auto resumed = make_film(options, [&](const FilmMade& so_far) {
    if (so_far.frames == 7 && beside.empty()) beside = refusal_of(options);
    return true;
  });
  REQUIRE_MESSAGE(resumed.has_value(), why_not(resumed));
  CHECK(has(beside, "another program draws"));
  CHECK(resumed->frames == 11);
  CHECK(resumed->kept == 4);
  int files = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(options.out)) {
    CAPTURE(file.path());
    CHECK(bytes_of(file.path()) == bytes_of(folder / "whole" / file.path().filename()));
    ++files;
  }
  CHECK(files == 12);
}

TEST_CASE("ffmpeg makes a film of the pictures, small or without loss, and the pictures go") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  FilmOptions options{.session = folder / "session.sqlite",
                      .shots = folder / "shots.toml",
                      .out = folder / "it's 100 %.mkv",
                      .width_px = 63,
                      .height_px = 47,
                      .renderer = FilmRenderer::traced,
                      .samples = 1,
                      .to_s = 0.2};
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);
  CHECK(has(refusal_of(options), "install the package ffmpeg"));
  ::setenv("PATH", path.c_str(), 1);
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 2);
  const auto file = [](const fs::path& film) { return "\"file:" + film.string() + "\""; };
  for (const char* name : {"it's 100 %.mkv", "small.mp4"}) {
    options.out = folder / name;
    REQUIRE(refusal_of(options) == "");
    CHECK_FALSE(fs::exists(options.out.string() + ".pictures"));
    CHECK_FALSE(fs::exists(options.out.string() + ".part"));
    CHECK(has(refusal_of(options), "it is there already"));
    CHECK(printed_by("ffprobe -v error -select_streams v -count_frames -show_entries "
                     "stream=width,height,r_frame_rate,nb_read_frames -of "
                     "csv=p=0 " +
                     file(options.out)) == (options.out.extension() == ".mkv" ? "63,47,25/1,6\n" : "64,48,25/1,6\n"));
  }
  CHECK(printed_by("ffprobe -v error -select_streams a -show_entries stream=codec_name,channels -of csv=p=0 " +
                   file(folder / "small.mp4")) == "aac,2\n");
  options.out = folder / "silent.mp4";
  options.sound = false;
  REQUIRE(refusal_of(options) == "");
  CHECK(printed_by("ffprobe -v error -select_streams a -show_entries stream=codec_name -of csv=p=0 " +
                   file(options.out)) == "");
  // Without loss means bit by bit.
  printed_by("ffmpeg -v error -i " + file(folder / "it's 100 %.mkv") + " \"" + (folder / "again%d.png").string() +
             "\"");
  options.out = folder / "pictures";
  REQUIRE(refusal_of(options) == "");
  for (const int n : {1, 6}) {
    const auto kept = image::read_png(folder / fmt::format("again{}.png", n)),
               drawn = image::read_png(options.out / fmt::format("{:06}.png", n));
    REQUIRE(kept.has_value());
    REQUIRE(drawn.has_value());
    CHECK(*kept == *drawn);
  }
  options.out = folder / "film.webm";
  CHECK(has(refusal_of(options), "write .mp4"));
}

TEST_CASE("a click in a film's sound is heard within a frame of its picture, by H.264 with AAC and without loss") {
  const TemporaryFolder folder;
  std::vector<fs::path> pictures;
  fs::create_directories(folder / "pictures");
  for (int i = 0; i < 25; ++i) {
    pictures.push_back(folder / fmt::format("pictures/{:06}.png", i + 1));
    REQUIRE(image::write_png(pictures.back(), image::Image(16, 16)));
  }
  auto wav = sound::WavFile::create(folder / "sound.wav", 2);
  REQUIRE(wav);
  std::vector<float> samples(2 * 48000, 0.0f);
  for (std::size_t i = 2 * 19200; i < 2 * 21600; ++i) samples[i] = i / 2 % 48 < 24 ? 0.5f : -0.5f;  // From 0.4 s on.
  REQUIRE(wav->write(samples));
  REQUIRE(wav->finish());
  for (const char* name : {"film.mp4", "film.mkv"}) {
    const auto made =
        encode_film(*find_ffmpeg(), pictures, folder / "sound.wav", 25.0, folder / name, [] { return true; });
    REQUIRE_MESSAGE(made.has_value(), why_not(made));
    const fs::path raw = folder / (std::string(name) + ".raw");
    printed_by("ffmpeg -v error -i \"" + (folder / name).string() + "\" -f s16le -ac 1 -ar 48000 \"" + raw.string() +
               "\"");
    const Bytes heard = bytes_of(raw);
    CHECK(heard.size() / 2 == relative(48000, 0.03));
    std::size_t first = 0;
    while (2 * first + 1 < heard.size() &&
           std::abs(static_cast<int>(static_cast<signed char>(heard[2 * first + 1]))) < 16)
      ++first;
    CHECK(std::abs(static_cast<double>(first) / 48000.0 - 0.4) < 0.5 / 25.0);
  }
}

}  // namespace septet::film
