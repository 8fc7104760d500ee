/// Reactions to hazards, from the first moment at which they could be seen.

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/world/hazard.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "logging/study/measures/hazard_reactions.hpp"
#include "tests/relative.hpp"

namespace septet::logging {
namespace {

/// Twenty seconds at 14 m/s with the accelerator at 0.3; `acts` changes the samples from 11.2 s on.
template <class Acts>
std::vector<Sample> drive(const Acts& acts) {
  std::vector<Sample> samples;
  for (int i = 0; i < 200; ++i) {
    Sample sample;
    sample.tick = static_cast<Tick>(12 * i);
    sample.simulated_time_s = 0.1 * i;
    sample.speed_mps = 14.0;
    sample.accelerator = 0.3;
    if (i >= 112) acts(sample);
    samples.push_back(sample);
  }
  return samples;
}

Event at_s(double time_s, const std::string& kind, std::optional<ParticipantId> who, const std::string& detail) {
  return {static_cast<Tick>(120.0 * time_s), time_s, kind, who, detail};
}
Event begins(double time_s, bool known, ParticipantId who = 7) {
  return at_s(time_s, "hazard", who, text_of(HazardNote{known, "ball and child"}));
}

const auto brakes = [](Sample& sample) { sample.brake = 0.4, sample.accelerator = 0.0; };

}  // namespace

TEST_CASE("a reaction counts from the hazard's beginning where it was known, else from its first sight") {
  const auto samples = drive(brakes);
  const std::vector<Event> known{begins(10.0, true)};
  const std::vector<Event> hidden{at_s(3.0, "first_sight", 7, ""), begins(10.0, false),
                                  at_s(10.5, "first_sight", 8, ""), at_s(10.7, "first_sight", 7, "")};
  CHECK(find_hazard_reactions(known, samples)[0].time_s == doctest::Approx(1.2));
  CHECK(find_hazard_reactions(hidden, samples)[0].time_s == doctest::Approx(0.5));
  CHECK(find_hazard_reactions(hidden, samples)[0].response == HazardResponse::braked);
}

TEST_CASE("half of the accelerator given back is a reaction, a tenth of it is not") {
  const std::vector<Event> events{begins(10.0, true)};
  const auto lifted = find_hazard_reactions(events, drive([](Sample& sample) { sample.accelerator = 0.14; }));
  CHECK(lifted[0].response == HazardResponse::lifted);
  CHECK(lifted[0].time_s == doctest::Approx(1.2));
  const auto held = find_hazard_reactions(events, drive([](Sample& sample) { sample.accelerator = 0.27; }));
  CHECK(held[0].response == HazardResponse::censored);
  CHECK(held[0].time_s == relative(9.9, 0.02));
}

TEST_CASE("one who braked already has reacted, one who stood or never saw it has no reaction time") {
  const auto samples = drive(brakes);
  CHECK(find_hazard_reactions(std::vector{begins(15.0, true)}, samples)[0].response == HazardResponse::braking_already);
  CHECK(find_hazard_reactions(std::vector{begins(15.0, true)}, samples)[0].time_s == 0.0);
  const auto standing = drive([](Sample& sample) { sample.speed_mps = 0.0; });
  CHECK(!find_hazard_reactions(std::vector{begins(15.0, true)}, standing)[0].counts());
  CHECK(!find_hazard_reactions(std::vector{begins(10.0, false)}, samples)[0].counts());
}

TEST_CASE("a hazard of two actors is one, from the one who was seen first") {
  const std::vector<Event> events{begins(10.0, false, 7), begins(10.0, false, 8), at_s(10.4, "first_sight", 8, ""),
                                  at_s(10.9, "first_sight", 7, "")};
  const auto reactions = find_hazard_reactions(events, drive(brakes));
  REQUIRE(reactions.size() == 1);
  CHECK(reactions[0].who == 8);
  CHECK(reactions[0].time_s == doctest::Approx(0.8));
}

TEST_CASE("a lesson marks perception by the slowest reaction, and names the hazard") {
  const auto lesson = read_lesson(
      "title = \"T\"\naim = \"A\"\n[[task]]\nid = \"p\"\nsays = \"React\"\nmeasure = \"perception\"\nbound = 1.0\n"
      "tolerance = 1.0\n",
      "x.lesson.toml");
  REQUIRE(lesson.has_value());
  const auto marks = mark_lesson(*lesson, drive(brakes), std::vector{begins(10.0, true)});
  CHECK(*marks.tasks[0].mark == doctest::Approx(8.0));
  CHECK(marks.tasks[0].worst_at == "ball and child");
  CHECK(!mark_lesson(*lesson, drive(brakes), {}).tasks[0].mark);
}

TEST_CASE("a hazard's note comes back from its text, and another text is none") {
  for (const bool known : {false, true}) {
    const auto note = read_hazard_note(text_of(HazardNote{known, "a b = c"}));
    REQUIRE(note.has_value());
    CHECK(note->known == known);
    CHECK(note->name == "a b = c");
  }
  for (const char* text :
       {"", "known=1", "known=1 name=", "known=1 name=\"", "known=2 name=\"a\"", "name=\"a\" known=1"})
    CHECK(!read_hazard_note(text).has_value());
}

}  // namespace septet::logging
