#include <algorithm>
#include <cmath>

#include "engine/image/png.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

image::Image picture(const fs::path& file) {
  CAPTURE(file);
  auto read = image::read_png(file);
  REQUIRE(read.has_value());
  return std::move(*read);
}

/// Mean of the three colours' differences, in steps of 255.
double difference(const image::Image& a, const image::Image& b) {
  REQUIRE(a.rgba.size() == b.rgba.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    if (i % 4 != 3) sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
  return sum / (0.75 * static_cast<double>(a.rgba.size()));
}

}  // namespace

TEST_CASE(
    "a film through the eyes of the driver is what the screen showed and its cameras turn and it refuses what the "
    "session lacks") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(1));
  const fs::path session = folder / "drive" / "session.sqlite", out = folder / "film", script = folder / "shots.toml";
  const Ended driven = run("septet",
                           {"drive", "--virtual", "--scenario", "behind-ambulance", "--seconds", "1.2", "--rig",
                            (folder / "small.toml").string(), "--out", (folder / "drive").string()},
                           folder / "drive.err");
  INFO(driven.error);
  REQUIRE(driven.code == 0);
  const auto film = [&](const std::string& shots, std::vector<std::string> more = {}) {
    write_text(script, shots);
    std::vector<std::string> arguments{"film",       session.string(), "--shots", script.string(), "--out",
                                       out.string(), "--size",         "160x120", "--software"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    fs::remove(folder / "film.err");
    return run("septet", arguments, folder / "film.err");
  };
  check_refused(film("[[shot]]\nfrom_s = 0\nto_s = 5\n"), {"shot 1", "within the session"}, out);
  check_refused(film("[[shot]]\nfrom_s = 0\nto_s = 0\n"), {"shots.toml:3", "later than from_s"}, out);
  check_refused(film("[[shot]]\nfrom_s = 0\nto_s = 1\nparticipant = \"tram\"\n"), {"shot 1", "\"tram\"", "volvo-s80"},
                out);
  check_refused(film("", {"--size", "0x9"}), {"--size", "0x9"}, out);
  check_refused(
      run("septet", {"film", (folder / "small.toml").string(), "--out", out.string()}, folder / "no-session.err"),
      {"small.toml", "not an SQLite file"}, out);

  // The screen is 0.8 m before the eyes and 0.8 m wide.
  const Ended made = film(
      "[[shot]]\nfrom_s = 1\nto_s = 1.08\nfield_of_view_deg = 53.13010235415598\n"
      "[[shot]]\nfrom_s = 1\nto_s = 1.08\ndistance_m = 7\npitch_deg = -10\n[[shot.turn]]\nheading_deg = 120\n");
  INFO(made.error);
  REQUIRE(made.code == 0);
  CHECK(std::distance(fs::directory_iterator(out), {}) == 5);  // And film.json.
  const double from_screen =
      difference(picture(out / "000001.png"), picture(folder / "drive" / "screens" / "a" / "120.png"));
  MESSAGE("the screen's picture and the film's differ by ", from_screen, " steps of 255");
  CHECK(from_screen < 0.05);
  CHECK(difference(picture(out / "000001.png"), picture(out / "000003.png")) > 5.0);
  CHECK(difference(picture(out / "000003.png"), picture(out / "000004.png")) > 5.0);
  const Ended again = film("[[shot]]\nfrom_s = 1\nto_s = 1.08\n");
  CHECK(again.code == 1);
  CHECK(again.error.find("add --resume") != std::string::npos);
}

}  // namespace septet::pipeline
