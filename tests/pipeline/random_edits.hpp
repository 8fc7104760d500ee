#pragma once
/// Lines of an editor that are valid, drawn by a seed: boards beside the road and on a participant come, go, move,
/// change their looks and are hidden.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/core/random.hpp"

namespace septet::pipeline {

class RandomEdits {
 public:
  /// `carrier`: number of the participant on which every other board hangs, an editor's own: the first to hang a thing
  /// there owns its root.
  RandomEdits(std::string editor, std::uint64_t seed, int carrier)
      : editor_(std::move(editor)), random_(seed), carrier_(carrier) {}

  /// One batch, of one to eight lines.
  std::vector<std::string> batch() {
    std::vector<std::string> lines;
    for (auto left = 1 + random_.below(8); left > 0; --left) add_line(lines);
    return lines;
  }

 private:
  static constexpr std::size_t most_things = 12;
  static constexpr int most_texts = 4;  ///< Each leaves a picture in the store.

  std::string place() {
    return fmt::format("{:.2f} {:.2f} {:.2f} {:.1f}", random_.uniform(6.0, 40.0), random_.uniform(-12.0, 12.0),
                       random_.uniform(0.0, 4.0), random_.uniform(90.0, 270.0));
  }
  std::string colour() {
    return fmt::format("{:.2f} {:.2f} {:.2f}", random_.uniform(), random_.uniform(), random_.uniform());
  }
  void add_line(std::vector<std::string>& lines) {
    const auto draw = random_.below(10);
    if (things_.empty() || (draw < 3 && things_.size() < most_things)) {
      const std::string thing = fmt::format("{}/{}", editor_, made_++);
      lines.push_back(fmt::format("board {} {:.2f} {:.2f} {}", thing, random_.uniform(0.3, 3.0),
                                  random_.uniform(0.3, 3.0), place()));
      lines.push_back(fmt::format("color {} {}", thing, colour()));
      if (made_ % 2 == 0) lines.push_back(fmt::format("hang {} {}", thing, carrier_));
      things_.push_back(thing);
      return;
    }
    const std::size_t at = random_.below(things_.size());
    const std::string thing = things_[at];
    if (draw < 5) {
      lines.push_back(fmt::format("move {} {}", thing, place()));
    } else if (draw == 5) {
      lines.push_back(fmt::format("{} {}", random_.below(2) == 0 ? "hide" : "show", thing));
    } else if (draw == 6 && texts_++ < most_texts) {
      lines.push_back(fmt::format("text {} \"{}\"", thing, random_.below(1'000'000)));
    } else if (draw < 8) {
      lines.push_back(fmt::format("color {} {}", thing, colour()));
    } else if (draw == 8) {
      lines.push_back(fmt::format("go {} {:.2f} {:.2f} 0 0 0 0 {:.1f}", thing, random_.uniform(-2.0, 2.0),
                                  random_.uniform(-2.0, 2.0), random_.uniform(-90.0, 90.0)));
    } else {
      lines.push_back(fmt::format("remove {}", thing));
      things_.erase(things_.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }

  std::string editor_;
  Random random_;
  int carrier_;
  int made_ = 0, texts_ = 0;
  std::vector<std::string> things_;
};

}  // namespace septet::pipeline
