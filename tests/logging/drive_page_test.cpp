// A drive's page: route, events, pictures, and the group's links to these pages.

#include <cmath>
#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "logging/study/report/event_section.hpp"
#include "logging/study/report/group_report.hpp"
#include "logging/study/report/page_link.hpp"
#include "logging/study/report/report.hpp"
#include "logging/study/report/route_chart.hpp"
#include "tests/logging/count_of.hpp"
#include "tests/logging/sample_series.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// Along x, at one speed for `half` samples and at another for as many.
std::vector<Sample> straight_drive(double first_mps, double then_mps, int half = 100, double bend_m = 0.0) {
  std::vector<Sample> samples;
  double x_m = 0.0;
  for (int i = 0; i < 2 * half; ++i) {
    Sample sample = sample_at(i, -1, 0.0);
    sample.speed_mps = i < half ? first_mps : then_mps;
    x_m += sample.speed_mps / 10.0;
    sample.x_m = x_m;
    sample.y_m = bend_m * i / (2.0 * half);
    samples.push_back(sample);
  }
  return samples;
}

/// The classes of speed of the stretches, as the style calls them, in the order in which they were driven.
std::vector<std::string> colours_of(const std::string& svg) {
  std::vector<std::string> colours;
  const std::string begin = "<polyline class=\"route ";
  for (auto at = svg.find(begin); at != svg.npos; at = svg.find(begin, at + 1))
    colours.push_back(svg.substr(at + begin.size(), 2));
  return colours;
}

double height_of(const std::string& svg) {
  const std::string begin = "viewBox=\"0 0 960 ";
  return std::stod(svg.substr(svg.find(begin) + begin.size()));
}

Event event_at(double time_s, const std::string& kind, const std::string& detail) {
  return {static_cast<Tick>(time_s * 120.0), time_s, kind, std::nullopt, detail};
}

ReportData page_data() {
  ReportData data;
  data.info = example_info();
  data.samples = straight_drive(10.0, 20.0);
  data.events = {event_at(0.1, "scenario", "element=story::act one::<b>lorry</b> goes state=running"),
                 event_at(2.2, "mark", "by=Ann note=he looked <b>away</b> = twice"),
                 event_at(3.3, "operator", "by=Ann wish=rain 0.5"),
                 event_at(4.4, "rating", "by=driver wish=MISC value=3"),
                 event_at(5.5, "game", "state=begins level=1"),
                 event_at(6.6, "mirror_glance", "area=\"left mirror\" duration_s=0.50"),
                 event_at(7.7, "lane_change", "lanes_to_left=-1 from_lane=-1 to_lane=-2"),
                 event_at(8.8, "collision", "closing_speed_mps=10.00"),
                 event_at(9.9, "a_word_of_its_own", "")};
  return data;
}

}  // namespace

TEST_CASE("a stretch at twice the speed has another colour, and the legend says of which speed") {
  for (const double first_mps : {3.0, 7.0, 10.0, 16.5, 35.0}) {
    const std::string svg = route_svg(straight_drive(first_mps, 2.0 * first_mps), {}, "Route");
    const auto colours = colours_of(svg);
    REQUIRE(colours.size() == 2);
    CHECK(colours[0] != colours[1]);
    for (const auto& colour : colours) CHECK(count_of(svg, "<path class=\"route " + colour) == 1);
  }
  CHECK(speed_class_width_kmh(72.0) == 20.0);
  CHECK(speed_class_width_kmh(35.0) == 5.0);
  CHECK(speed_class_width_kmh(36.0) == 10.0);
}

TEST_CASE("a metre is as long along both axes, a straight road is a thin strip, and a car that stands has no route") {
  CHECK(height_of(route_svg(straight_drive(20.0, 20.0), {}, "Route")) < 200.0);
  // 400 m long and 400 m wide: as high as the largest box.
  CHECK(height_of(route_svg(straight_drive(20.0, 20.0, 100, 400.0), {}, "Route")) > 450.0);
  CHECK(route_svg(straight_drive(0.0, 0.0), {}, "Route").empty());
  CHECK(route_svg({}, {}, "Route").empty());
  // 398 m over 900 units: 50 m are 113 of them.
  CHECK(route_svg(straight_drive(20.0, 20.0), {}, "Route").find("h113.1") != std::string::npos);
}

TEST_CASE("a leap is not drawn, and a sample without a place is left out") {
  auto samples = straight_drive(10.0, 10.0);
  for (std::size_t i = 100; i < samples.size(); ++i) samples[i].x_m += 5000.0;
  samples[50].x_m = std::nan("");
  const std::string svg = route_svg(samples, {}, "Route");
  CHECK(colours_of(svg).size() == 2);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("moments on the route that lie on each other share a dot, and their words are escaped") {
  const std::vector<RouteMark> marks{{1.0, "1", "<b>one</b>"}, {1.0, "2", "two"}, {15.0, "3", "three"}};
  const std::string svg = route_svg(straight_drive(10.0, 10.0), marks, "Route");
  CHECK(count_of(svg, "<circle class=\"moment told\"") == 2);
  CHECK(svg.find(">1, 2</text>") != std::string::npos);
  CHECK(svg.find("&lt;b&gt;one&lt;/b&gt;\ntwo</title>") != std::string::npos);
}

TEST_CASE("each event of the log stands in the table once with its time, and is a tick of the time line") {
  const ReportData data = page_data();
  const std::string html = to_html(data);
  for (const Event& event : data.events) {
    CAPTURE(event.kind);
    CHECK(count_of(html, fmt::format("<tr><td class=\"value\">{:.1f} s</td><td class=\"name\">",
                                     event.simulated_time_s)) == 1);
  }
  CHECK(count_of(html, "<path class=\"event\"") == static_cast<int>(data.events.size()));
  for (const char* said :
       {"he looked &lt;b&gt;away&lt;/b&gt; = twice (by Ann)", "rain 0.5 (by Ann)", "MISC value=3",
        "begins: &lt;b&gt;lorry&lt;/b&gt; goes (act one)", "left mirror, for 0.50 s",
        "to the right, from lane -1 to lane -2", "collision at a closing speed of 36 km/h", "a word of its own"})
    CHECK_MESSAGE(html.find(std::string(">") + said) != std::string::npos, said);
  CHECK(html.find("<b>lorry") == std::string::npos);
  CHECK(html.find("<b>away") == std::string::npos);
  CHECK(html.find("Route from above") != std::string::npos);
}

TEST_CASE("of many events of a row the table lists so many and counts the others, and the time line stays short") {
  std::vector<Event> events;
  for (int i = 0; i < 20000; ++i) events.push_back(event_at(i / 10.0, "mirror_glance", ""));
  events.push_back(event_at(1999.0, "mark", "by=Ann note=the end"));
  const auto told = tell_events(events, {});
  const std::string table = event_table(told);
  CHECK(count_of(table, "<td class=\"value\">") == static_cast<int>(most_listed_events) + 1);
  CHECK(count_of(table, "and 19940 more") == 1);
  CHECK(table.find("the end (by Ann)") != std::string::npos);
  CHECK(count_of(event_strip(told, {0.0, 2000.0}), "class=\"event\"") < 1000);
  CHECK(event_table({}).empty());
  CHECK(event_strip({}, {0.0, 1.0}).empty());
}

TEST_CASE("a page shows the pictures that lie beside the session, of the moments that matter, and no others") {
  const TemporaryFolder folder;
  const auto place = folder / "a drive #1";
  const ReportData data = page_data();
  CHECK(find_drive_pictures(data.info, data.events, place, place).empty());
  std::filesystem::create_directories(place / "screens/ahead");
  for (int tick = 120; tick <= 2400; tick += 120)
    std::ofstream(place / fmt::format("screens/ahead/{}.png", tick)) << "x";
  const auto pictures = find_drive_pictures(data.info, data.events, place, folder / "pages");
  std::vector<std::string> links;
  for (const auto& picture : pictures) links.push_back(picture.link);
  // The first, those nearest to the mark at 2.2 s and the collision at 8.8 s, the last; no panorama is there.
  CHECK(links == std::vector<std::string>{
                     "../a%20drive%20%231/screens/ahead/120.png", "../a%20drive%20%231/screens/ahead/240.png",
                     "../a%20drive%20%231/screens/ahead/1080.png", "../a%20drive%20%231/screens/ahead/2400.png"});
  std::ofstream(place / "panorama.png") << "x";
  const auto beside = find_drive_pictures(data.info, data.events, place, place);
  REQUIRE(beside.size() == 5);
  CHECK(beside[0].link == "panorama.png");
  const std::string html = picture_section(beside);
  CHECK(count_of(html, "<img src=\"panorama.png\"") == 1);
  CHECK(count_of(html, "<img") == 5);
  CHECK(count_of(to_html(data), "<img") == 0);
}

TEST_CASE("a group's page links to each drive's page: the one beside the session, or one that is written for it") {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> sessions;
  for (const char* name : {"1", "2", "3"}) {
    std::filesystem::create_directories(folder / name);
    sessions.push_back(folder / name / "session.sqlite");
    SessionInfo info = example_info();
    info.participant = std::string("<b>") + name;
    auto writer = SessionWriter::create(sessions.back(), info);
    REQUIRE(writer.has_value());
    for (const Sample& sample : straight_drive(10.0, 20.0)) writer->record(sample);
    REQUIRE(writer->finish().has_value());
  }
  std::ofstream(folder / "2/report.html") << "beside";
  std::filesystem::create_directories(folder / "1/screens/ahead");
  std::ofstream(folder / "1/screens/ahead/0.png") << "x";
  const auto subjects = pool_sessions(sessions, {});
  REQUIRE(subjects.has_value());
  GroupReport report;
  report.subjects = *subjects;
  const auto out = folder / "pooled";
  REQUIRE(write_group_report(report, out).has_value());
  const auto text_of = [](const std::filesystem::path& path) { return read_regular_file(path).value_or(""); };
  const std::string group = text_of(out / "report.html");
  for (const char* link : {"href=\"drives/1.html\"", "href=\"../2/report.html\"", "href=\"drives/3.html\""})
    CHECK_MESSAGE(count_of(group, link) == 1, link);
  CHECK(count_of(group, "href=") == 3);
  CHECK(group.find("<b>1") == std::string::npos);
  CHECK_FALSE(std::filesystem::exists(out / "drives/2.html"));
  const std::string page = text_of(out / "drives/1.html");
  CHECK(page.find("<img src=\"../../1/screens/ahead/0.png\"") != std::string::npos);
  CHECK(page.find("Route from above") != std::string::npos);
  CHECK(count_of(text_of(out / "drives/3.html"), "<img") == 0);
}

}  // namespace septet::logging
