#include "engine/world/guidance_words.hpp"

#include <array>
#include <cstddef>

#include <fmt/format.h>

namespace septet {
namespace {

struct Sentences {
  std::string_view soon, now;
};

/// In the order of Guided; "{}" is a roundabout's exit.
using Phrasebook = std::array<Sentences, 12>;

constexpr Phrasebook english{{
    {"At the next crossing, go straight on.", "Go straight on here."},
    {"At the next crossing, turn left.", "Turn left here."},
    {"At the next crossing, turn right.", "Turn right here."},
    {"Where the road forks, keep left.", "Keep left here."},
    {"Where the road forks, keep right.", "Keep right here."},
    {"At the next crossing, turn back.", "Turn back here."},
    {"At the roundabout, take the {} exit.", "Take the {} exit."},
    {"Keep to the left lane.", "Keep to the left lane."},
    {"Keep to the right lane.", "Keep to the right lane."},
    {"Your goal is ahead.", "You have arrived."},
    {"We take another way.", "We take another way."},
    {"From here no way leads to the goal.", "From here no way leads to the goal."},
}};
constexpr Phrasebook german{{
    {"An der nächsten Kreuzung geradeaus.", "Hier geradeaus."},
    {"An der nächsten Kreuzung links abbiegen.", "Hier links abbiegen."},
    {"An der nächsten Kreuzung rechts abbiegen.", "Hier rechts abbiegen."},
    {"An der Gabelung links halten.", "Hier links halten."},
    {"An der Gabelung rechts halten.", "Hier rechts halten."},
    {"An der nächsten Kreuzung wenden.", "Hier wenden."},
    {"Im Kreisverkehr die {} Ausfahrt nehmen.", "Die {} Ausfahrt nehmen."},
    {"Ordnen Sie sich links ein.", "Ordnen Sie sich links ein."},
    {"Ordnen Sie sich rechts ein.", "Ordnen Sie sich rechts ein."},
    {"Das Ziel liegt vor Ihnen.", "Sie sind am Ziel."},
    {"Wir nehmen einen anderen Weg.", "Wir nehmen einen anderen Weg."},
    {"Von hier führt kein Weg zum Ziel.", "Von hier führt kein Weg zum Ziel."},
}};
constexpr Phrasebook swedish{{
    {"Kör rakt fram i nästa korsning.", "Kör rakt fram här."},
    {"Sväng vänster i nästa korsning.", "Sväng vänster här."},
    {"Sväng höger i nästa korsning.", "Sväng höger här."},
    {"Håll till vänster där vägen delar sig.", "Håll till vänster här."},
    {"Håll till höger där vägen delar sig.", "Håll till höger här."},
    {"Vänd i nästa korsning.", "Vänd här."},
    {"Ta {} avfarten i rondellen.", "Ta {} avfarten."},
    {"Välj vänster körfält.", "Välj vänster körfält."},
    {"Välj höger körfält.", "Välj höger körfält."},
    {"Målet ligger framför dig.", "Du är framme."},
    {"Vi tar en annan väg.", "Vi tar en annan väg."},
    {"Ingen väg leder härifrån till målet.", "Ingen väg leder härifrån till målet."},
}};

/// The exits that have a word; others are numbers.
struct Language {
  std::string_view code;
  const Phrasebook* phrases;
  std::array<std::string_view, 5> exits;
  std::string_view further;
};
constexpr std::array<Language, 3> languages{{
    {"en", &english, {"first", "second", "third", "fourth", "fifth"}, "{}th"},
    {"de", &german, {"erste", "zweite", "dritte", "vierte", "fünfte"}, "{}."},
    {"sv", &swedish, {"första", "andra", "tredje", "fjärde", "femte"}, "{}:e"},
}};

}  // namespace

std::string guidance_sentence(const GuidanceWord& word, std::string_view language) {
  const Language* spoken = languages.data();
  for (const Language& one : languages)
    if (one.code == language) spoken = &one;
  const Sentences& sentences = (*spoken->phrases)[static_cast<std::size_t>(word.what)];
  const std::string_view text = word.now ? sentences.now : sentences.soon;
  const std::size_t gap = text.find("{}");
  if (gap == text.npos) return std::string(text);
  const std::size_t exit = word.exit == 0 ? 1 : word.exit;
  const std::string number = exit <= spoken->exits.size() ? std::string(spoken->exits[exit - 1])
                                                          : fmt::format(fmt::runtime(spoken->further), exit);
  return std::string(text.substr(0, gap)) + number + std::string(text.substr(gap + 2));
}

std::string guidance_arrow(const Guidance& guidance) {
  const auto arrow = [&]() -> std::string {
    switch (guidance.next.what) {
      case Guided::left:
        return "◀";
      case Guided::right:
        return "▶";
      case Guided::bear_left:
      case Guided::keep_left:
        return "↖";
      case Guided::bear_right:
      case Guided::keep_right:
        return "↗";
      case Guided::turn_back:
        return "↶";
      case Guided::roundabout:
        return fmt::format("↻ {}", guidance.next.exit);
      case Guided::arrive:
        return "●";
      case Guided::straight_on:
      case Guided::new_route:
      case Guided::no_way:
        break;
    }
    return "▲";
  };
  return fmt::format("{} {} m", arrow(), guidance.to_next_m);
}

}  // namespace septet
