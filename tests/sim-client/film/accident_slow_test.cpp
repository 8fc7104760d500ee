#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/film_script/film_script.hpp"
#include "engine/image/png.hpp"
#include "sim-client/film/accident/accident_film.hpp"
#include "sim-client/film/accident/manifest.hpp"
#include "sim-client/film/overlay/overlay_drawing.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::film {
namespace {
namespace fs = std::filesystem;

constexpr double contact_s = 2.0, frames_per_second = 10.0;

/// Four seconds of five on a circle, of whom 1 and 2 are said to meet; 2 is gone from a tick on.
fs::path write_session(const TemporaryFolder& folder, Tick second_until = 480) {
  auto info = logging::example_info();
  info.other["participant_names"] = R"({"1":"ego","2":"crosser"})";
  info.other["driver"] = "novice";
  auto writer = logging::SessionWriter::create(folder / "session.sqlite", info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  for (Tick tick = 0; tick <= 480; ++tick) {
    Snapshot world = logging::drive_snapshot(tick);
    if (tick > second_until) std::erase_if(world.participants, [](const Participant& one) { return one.id == 2; });
    writer->record(logging::taken(world));
  }
  writer->record(logging::Event{240, contact_s, "collision", 2, "closing_speed_mps=8.00 delta_v_mps=3.00"});
  REQUIRE(writer->finish().has_value());
  return folder / "session.sqlite";
}

AccidentOptions options_for(const fs::path& session, const fs::path& out) {
  AccidentOptions options;
  options.film.session = session;
  options.film.out = out;
  options.film.frames_per_second = frames_per_second;
  options.film.width_px = 320, options.film.height_px = 180;
  options.film.software = true;
  options.film.sound = false;
  return options;
}

void must_make(const AccidentOptions& options) {
  const auto made = run_accident(options);
  REQUIRE_MESSAGE(made.has_value(), why_not(made));
  REQUIRE(*made == 0);
}

std::string differences_of(const fs::path& film) {
  const auto checked = check_accident(film, {});
  REQUIRE_MESSAGE(checked.has_value(), why_not(checked));
  std::string text;
  for (const std::string& difference : checked->differences) text += difference + '\n';
  return text;
}

void replace_in(const fs::path& file, const std::string& what, const std::string& by) {
  std::string text = text_of(file);
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  text.replace(at, what.size(), by);
  std::ofstream(file, std::ios::binary) << text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("an accident's film is the same bytes twice and its check finds an altered frame or figure or input") {
  const TemporaryFolder folder;
  const fs::path session = write_session(folder), film = folder / "film";
  must_make(options_for(session, film));
  must_make(options_for(session, folder / "again"));
  std::size_t files = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(film)) {
    const fs::path name = file.path().filename();
    CAPTURE(name);
    ++files;
    CHECK(text_of(file.path()) == text_of(folder / "again" / name));
  }
  CHECK(files >= 9);  // Film, subtitles, storyboard, page, manifest and stills; no pictures.
  CHECK(differences_of(film).empty());
  CHECK(differences_of(film / film_name).empty());

  const auto altered = [&](const std::string& what) {
    const fs::path copy = folder / what;
    fs::copy(film, copy);
    return copy;
  };
  // A film of the same length in which one picture is another one.
  const fs::path of_frame = altered("frame");
  const std::string draw = fmt::format(
      "ffmpeg -nostdin -loglevel error -y -i '{}' -vf \"drawbox=x=0:y=0:w=9:h=9:t=fill:enable='eq(n,17)'\" -c:v "
      "libx264 "
      "-crf 0 -f mp4 '{}'",
      (film / film_name).string(), (of_frame / film_name).string());
  REQUIRE(std::system(draw.c_str()) == 0);
  CHECK(has(differences_of(of_frame), "accident.mp4: it was altered"));
  CHECK(has(differences_of(of_frame), "accident.mp4: frame"));

  const fs::path of_figure = altered("figure");
  replace_in(of_figure / manifest_name, "28.8", "27.8");
  CHECK(has(differences_of(of_figure), "figure \"closing speed\" is 27.8, the session gives 28.8"));

  const fs::path of_page = altered("page");
  replace_in(of_page / page_name, "28.80 km/h", "27.80 km/h");
  CHECK(has(differences_of(of_page), "accident.html: it was altered"));

  const fs::path of_script = altered("script");
  replace_in(of_script / script_name, "field_of_view_deg = 75.0", "field_of_view_deg = 76.0");
  CHECK(has(differences_of(of_script), "storyboard.toml: it is not what the session's plan gives"));

  const fs::path of_driver = altered("driver");
  replace_in(of_driver / manifest_name, R"("driver": "novice")", R"("driver": "expert")");
  CHECK(has(differences_of(of_driver), "accident.json: \"session\" is"));

  const fs::path of_input = altered("input");
  replace_in(of_input / manifest_name, R"("role": "scenario")", R"("role": "scene")");
  CHECK(has(differences_of(of_input), "accident.json: input "));

  const fs::path of_contacts = altered("contacts");
  replace_in(of_contacts / manifest_name, R"("contacts": 1)", R"("contacts": 2)");
  CHECK(has(differences_of(of_contacts), "accident.json: \"contacts\" is 2, the session gives 1"));

  const auto nowhere = check_accident(folder / "nowhere", {});
  REQUIRE_FALSE(nowhere.has_value());
  CHECK(has(describe(nowhere.error()), (folder / "nowhere").string() + ": there is no such film"));

  // Somebody who alters what is drawn and writes the record anew: frames are drawn again.
  const fs::path of_record = altered("record");
  std::string text = text_of(of_record / manifest_name);
  for (auto at = text.find("\"picture\": \""); at != std::string::npos; at = text.find("\"picture\": \"", at + 1))
    text[at + 12] = text[at + 12] == '0' ? '1' : '0';
  std::ofstream(of_record / manifest_name) << text;
  CHECK(has(differences_of(of_record), "drawn again from the session it is another picture"));

  std::ofstream(session, std::ios::binary | std::ios::app) << "x";
  CHECK(has(differences_of(film), "it is not the session that was filmed, or it was altered"));
}

TEST_CASE("a narrator is heard when a shot begins and the pictures stay as they are") {
  const TemporaryFolder folder;
  const fs::path session = write_session(folder);
  auto options = options_for(session, folder / "silent");
  must_make(options);
  options.film.out = folder / "told";
  // A beep of 0.2 s for each subtitle, and the words as they came.
  options.voice = fmt::format(
      "printf '%s\\n' \"$WORDS\" >> '{}' && ffmpeg -nostdin -loglevel error -f lavfi -i "
      "sine=frequency=440:duration=0.2 -y \"$WAV\"",
      (folder / "words.txt").string());
  must_make(options);
  CHECK(has(text_of(folder / "words.txt"), "What ego has before them.\nWhat crosser has before them.\n"));
  const auto silent = decoded_hashes(folder / "silent" / film_name), told = decoded_hashes(folder / "told" / film_name);
  REQUIRE_MESSAGE(silent.has_value(), why_not(silent));
  REQUIRE_MESSAGE(told.has_value(), why_not(told));
  CHECK(*silent == *told);
  const std::string decode =
      fmt::format("ffmpeg -nostdin -loglevel error -y -i '{}' -map 0:a -ac 1 -ar 8000 -f s16le '{}'",
                  (folder / "told" / film_name).string(), (folder / "sound").string());
  REQUIRE(std::system(decode.c_str()) == 0);
  const std::string sound = text_of(folder / "sound");
  const auto loudest = [&](double from_s, double to_s) {
    int most = 0;
    for (auto n = static_cast<std::size_t>(8000.0 * from_s); n < static_cast<std::size_t>(8000.0 * to_s); ++n) {
      REQUIRE(2 * n + 1 < sound.size());
      most = std::max(
          most, std::abs(static_cast<int>(static_cast<std::int16_t>(
                    static_cast<std::uint8_t>(sound[2 * n]) | (static_cast<std::uint8_t>(sound[2 * n + 1]) << 8)))));
    }
    return most;
  };
  // The first shot lasts 4 s, the session's length; the second begins then.
  CHECK(loudest(0.02, 0.15) > 1000);
  CHECK(loudest(0.5, 3.9) < 100);
  CHECK(loudest(4.02, 4.15) > 1000);
  CHECK(differences_of(folder / "told").empty());

  options.film.out = folder / "mute";
  options.voice = "exit 3";
  const auto mute = run_accident(options);
  CHECK(has(why_not(mute), "status 3"));
}

TEST_CASE("the figures in a film's pictures are those of the log's ticks, rasterised or traced") {
  const TemporaryFolder folder;
  const fs::path session = write_session(folder);
  std::ofstream(folder / "shots.toml") << "[overlay]\ncontact_s = 2.0\nparticipants = [\"ego\", \"crosser\"]\n"
                                          "notes = [\"assumed: everything\"]\n"
                                          "[[shot]]\nfrom_s = 0.5\nto_s = 3.5\nparticipant = \"ego\"\noverlay = true\n";
  FilmOptions options{.session = session,
                      .shots = folder / "shots.toml",
                      .out = folder / "pictures",
                      .frames_per_second = frames_per_second,
                      .width_px = 320,
                      .height_px = 180,
                      .software = true};
  const auto make = [&](std::size_t frames) {
    const auto made = make_film(options, [](const FilmMade&) { return true; });
    REQUIRE_MESSAGE(made.has_value(), why_not(made));
    REQUIRE(made->frames == frames);
  };
  make(30);
  auto font = image::Font::find(image::FontStyle::bold);
  REQUIRE(font.has_value());
  // Where figures stand does not depend on their values.
  const auto script = read_script(text_of(folder / "shots.toml"), "shots.toml");
  REQUIRE_MESSAGE(script.has_value(), why_not(script));
  const Snapshot nobody;
  const std::vector<OverlayPerson> people{{1, "ego"}, {2, "crosser"}};
  const std::vector<instant::FrameView> views(1);
  const auto content = overlay_content({*script, script->shots[0], nobody, people, {}, views, 320, 180}, *font);
  const auto check = [&](std::size_t n) {
    const auto picture = image::read_png(options.out / fmt::format("{:06}.png", n + 1));
    REQUIRE_MESSAGE(picture.has_value(), why_not(picture));
    std::vector<std::string> read;
    for (const OverlayLine& line : content.lines)
      if (line.is_figure) read.push_back(read_figure(*picture, line, *font));
    const Snapshot tick = logging::drive_snapshot(60 + 12 * n);
    const auto speed = [&](std::size_t i) {
      return fmt::format("{:5.1f}", 3.6 * glm::length(Vec2(tick.participants[i].velocity_mps)));
    };
    CHECK(read == std::vector<std::string>{fmt::format("{:7.2f}", tick.simulated_time_s),
                                           fmt::format("{:+7.2f}", tick.simulated_time_s - contact_s), speed(0),
                                           speed(1)});
  };
  for (std::size_t n = 0; n < 30; ++n) check(n);
  options.renderer = FilmRenderer::traced, options.samples = 1, options.every = 10;
  options.out = folder / "traced";
  make(3);
  for (const std::size_t n : {0u, 10u, 20u}) check(n);
}

TEST_CASE("a film that was stopped goes on from its pictures, and is the same bytes as one that was not") {
  const TemporaryFolder folder;
  const fs::path session = write_session(folder);
  must_make(options_for(session, folder / "whole"));
  const auto begin = [&](const char* name) {
    AccidentOptions options = options_for(session, folder / name);
    fs::create_directory(options.film.out);
    AccidentOptions planned = options;
    planned.plan = options.film.out / script_name;
    must_make(planned);
    FilmOptions part = options.film;
    part.out = options.film.out / film_name, part.shots = planned.plan, part.keep_pictures = true;
    const auto stopped = make_film(part, [](const FilmMade& so_far) { return so_far.frames < 30; });
    REQUIRE_MESSAGE(stopped.has_value(), why_not(stopped));
    REQUIRE(stopped->stopped);
    return options;
  };
  AccidentOptions options = begin("part");
  CHECK(has(why_not(run_accident(options)), "add --resume"));
  options.film.resume = true;
  must_make(options);
  std::size_t files = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(folder / "whole")) {
    CAPTURE(file.path().filename());
    ++files;
    CHECK(text_of(file.path()) == text_of(folder / "part" / file.path().filename()));
  }
  CHECK(files >= 9);
  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(folder / "part"), {})) == files);
  CHECK(has(why_not(run_accident(options)), "whole already"));

  // What is kept is not drawn again; another film is refused.
  options = begin("altered");
  options.film.resume = true;
  const fs::path pictures = folder / "altered" / (std::string(film_name) + ".pictures");
  fs::copy_file(pictures / "000001.png", pictures / "000020.png", fs::copy_options::overwrite_existing);
  AccidentOptions other = options;
  other.film.width_px = 352;
  CHECK_FALSE(run_accident(other).has_value());
  must_make(options);
  CHECK(text_of(folder / "altered" / film_name) != text_of(folder / "whole" / film_name));
}

TEST_CASE("a traced accident's film has its overlays and its second camera, and its check traces frames again") {
  const TemporaryFolder folder;
  const fs::path session = write_session(folder);
  AccidentOptions options = options_for(session, folder / "traced");
  options.film.renderer = FilmRenderer::traced, options.film.samples = 1;
  options.film.frames_per_second = 2.0;
  options.film.width_px = 160, options.film.height_px = 90;
  must_make(options);
  CHECK(has(text_of(folder / "traced" / script_name), "[shot.beside]"));
  CHECK(differences_of(folder / "traced").empty());
}

TEST_CASE("a picture of two cameras is the halves of their own pictures though one of the two has vanished") {
  const TemporaryFolder folder;
  const fs::path session = write_session(folder, 147);
  const std::string head = "[[shot]]\nfrom_s = 1\nto_s = 1.5\n", left = "participant = \"ego\"\n",
                    right = "participant = \"crosser\"\nfield_of_view_deg = 40\n";
  std::ofstream(folder / "both.toml") << head << left << "[shot.beside]\n" << right;
  std::ofstream(folder / "left.toml") << head << left;
  std::ofstream(folder / "right.toml") << head << right;
  const auto pictures_of = [&](const std::string& name, std::uint32_t width_px,
                               FilmRenderer renderer = FilmRenderer::raster) {
    const FilmOptions options{.session = session,
                              .shots = folder / (name + ".toml"),
                              .out = folder / (renderer == FilmRenderer::raster ? name : name + "-traced"),
                              .frames_per_second = frames_per_second,
                              .width_px = width_px,
                              .height_px = 90,
                              .software = true,
                              .renderer = renderer,
                              .samples = 16};
    const auto made = make_film(options, [](const FilmMade&) { return true; });
    REQUIRE_MESSAGE(made.has_value(), why_not(made));
    std::vector<image::Image> pictures;
    for (std::size_t n = 1; n <= made->frames; ++n) {
      auto picture = image::read_png(options.out / fmt::format("{:06}.png", n));
      REQUIRE_MESSAGE(picture.has_value(), why_not(picture));
      pictures.push_back(std::move(*picture));
    }
    return pictures;
  };
  const auto both = pictures_of("both", 200), alone_left = pictures_of("left", 100),
             alone_right = pictures_of("right", 100);
  REQUIRE(both.size() == 5);
  for (std::size_t n = 0; n < both.size(); ++n) {
    std::size_t differ = 0;
    for (std::uint32_t y = 0; y < 90; ++y)
      for (std::uint32_t x = 3; x < 97; ++x) {
        differ += both[n].at(x, y) == alone_left[n].at(x, y) ? 0 : 1;
        differ += both[n].at(100 + x, y) == alone_right[n].at(x, y) ? 0 : 1;
      }
    CAPTURE(n);
    CHECK(differ < 90 * 94 / 50);  // Edges are smoothed with the neighbourhood of the whole target.
  }

  // Traced, a pixel's noise is that of its place: the first camera's half is its own picture, the second's as bright.
  const auto traced = pictures_of("both", 200, FilmRenderer::traced),
             traced_left = pictures_of("left", 100, FilmRenderer::traced),
             traced_right = pictures_of("right", 100, FilmRenderer::traced);
  REQUIRE(traced.size() == 5);
  for (std::size_t n = 0; n < traced.size(); ++n) {
    std::size_t differ = 0;
    double green = 0.0, green_alone = 0.0, apart = 0.0;
    for (std::uint32_t y = 0; y < 90; ++y)
      for (std::uint32_t x = 3; x < 97; ++x) {
        differ += traced[n].at(x, y) == traced_left[n].at(x, y) ? 0 : 1;
        const double own = traced[n].at(100 + x, y).green, alone = traced_right[n].at(x, y).green;
        green += own, green_alone += alone, apart += std::abs(own - alone);
      }
    CAPTURE(n);
    CHECK(differ == 0);
    CHECK(green == relative(green_alone, 0.01));
    CHECK(apart < 0.1 * green);
  }
}

}  // namespace septet::film
