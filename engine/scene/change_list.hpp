#pragma once
/// Changed things in the order of their revisions, so that a reader pays for what changed and not for what there is.
///
/// Bounded: the oldest half is forgotten when the list is full, and a reader from before that reads everything.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace septet::scene {

template <class What>
class ChangeList {
 public:
  struct Change {
    std::uint64_t revision = 0;
    What what;
  };
  static constexpr std::size_t most = 8192;
  static constexpr std::uint64_t knows_nothing = std::numeric_limits<std::uint64_t>::max();

  /// Knows all changes after this revision.
  explicit ChangeList(std::uint64_t known_from = 0) : known_from_(known_from) {}

  /// Adds a change; revisions rise. A thing that changes again at once stands once.
  void add(std::uint64_t revision, const What& what) {
    if (!changes_.empty() && changes_.back().what == what) {
      changes_.back().revision = revision;
      return;
    }
    if (changes_.size() == most) {
      known_from_ = changes_[most / 2 - 1].revision;
      changes_.erase(changes_.begin(), changes_.begin() + most / 2);
    }
    changes_.push_back({revision, what});
  }
  /// The changes after `revision`; empty where some of them are forgotten.
  std::optional<std::span<const Change>> since(std::uint64_t revision) const {
    if (revision < known_from_) return std::nullopt;
    const auto first = std::ranges::upper_bound(changes_, revision, {}, &Change::revision);
    return std::span(changes_).subspan(static_cast<std::size_t>(first - changes_.begin()));
  }
  /// Everything may have changed until this revision.
  void forget(std::uint64_t revision) {
    changes_.clear();
    known_from_ = revision;
  }

 private:
  std::vector<Change> changes_;
  std::uint64_t known_from_;
};

}  // namespace septet::scene
