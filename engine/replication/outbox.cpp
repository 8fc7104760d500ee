#include "engine/replication/outbox.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "engine/scene/command_codec.hpp"

namespace septet::replication {
namespace {

constexpr std::size_t chunk_bytes = 24 * 1024;  ///< Size of a range's part, before it is packed.
constexpr std::size_t most_ranges = 64;         ///< More are merged, with the elements between them.

using Ranges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

void add_range(Ranges& ranges, std::uint32_t first, std::uint32_t end) {
  auto at = std::lower_bound(ranges.begin(), ranges.end(), first,
                             [](const auto& range, std::uint32_t value) { return range.second < value; });
  // Ranges from `at` on that touch the new one are merged into it.
  auto last = at;
  for (; last != ranges.end() && last->first <= end; ++last) {
    first = std::min(first, last->first);
    end = std::max(end, last->second);
  }
  at = ranges.erase(at, last);
  ranges.insert(at, {first, end});
  if (ranges.size() > most_ranges) ranges = {{ranges.front().first, ranges.back().second}};
}

}  // namespace

void Outbox::mark(const Change& change, std::uint64_t tick) {
  if (merge(change, tick)) order_.emplace_back(change.subject, tick);
}

bool Outbox::merge(const Change& change, std::uint64_t tick) {
  const auto [found, added] = waiting_.try_emplace(change.subject);
  Waiting& waiting = found->second;
  if (added) {
    waiting.change = change;
  } else {
    waiting.change.renew = waiting.change.renew || change.renew;
    waiting.change.smallest_vertices = std::min(waiting.change.smallest_vertices, change.smallest_vertices);
    waiting.change.smallest_polygons = std::min(waiting.change.smallest_polygons, change.smallest_polygons);
  }
  waiting.changed_at = std::max(waiting.changed_at, tick);
  if (is_range(change.subject.kind)) add_range(waiting.ranges, change.first, change.end);
  return added;
}

void Outbox::mark_lost(std::span<const Change> lost, std::uint64_t tick) {
  auto waited = std::exchange(order_, {});
  std::set<Subject> first;
  for (const Change& change : lost) {
    if (first.insert(change.subject).second) order_.emplace_back(change.subject, tick);
    merge(change, tick);
  }
  // What is among the lost goes with them: what follows there may point at it.
  std::erase_if(waited, [&](const auto& entry) { return first.contains(entry.first); });
  order_.insert(order_.end(), waited.begin(), waited.end());
}

std::optional<std::uint64_t> Outbox::next_tick() const {
  const auto next = std::ranges::find_if(order_, [&](const auto& entry) { return waiting_.contains(entry.first); });
  return next == order_.end() ? std::nullopt : std::optional(next->second);
}

bool Outbox::goes_on() const {
  const auto next = next_tick();
  return next && *next != 0 && *next <= written_up_to_;
}

bool Outbox::waits_for(std::uint64_t tick) const {
  const auto next = next_tick();
  return next && *next <= tick;
}

void Outbox::forget(const Subject& first, const Subject& last) {
  waiting_.erase(waiting_.lower_bound(first), waiting_.upper_bound(last));
}

void Outbox::write_whole(const scene::Store& store, const Subject& subject, Bytes& out, std::vector<Change>& sent) {
  const auto found = waiting_.find(subject);
  if (found == waiting_.end()) return;
  describe_change(store, found->second.change, [&](const scene::Command& command) { encode(command, out); });
  written_up_to_ = std::max(written_up_to_, found->second.changed_at);
  sent.push_back(found->second.change);
  waiting_.erase(found);
}

void Outbox::write_what_it_needs(const scene::Store& store, const Subject& subject, Bytes& out,
                                 std::vector<Change>& sent) {
  const auto first = [&](SubjectKind kind, PartId part) {
    write_whole(store, Subject{subject.node, kind, part, 0}, out, sent);
  };
  if (subject.kind == SubjectKind::existence) return;
  first(SubjectKind::existence, 0);
  switch (subject.kind) {
    case SubjectKind::tag:
      return first(SubjectKind::tag_group, subject.part);
    case SubjectKind::vertices:
    case SubjectKind::polygons:
      return first(SubjectKind::geometry_size, 0);
    case SubjectKind::layer_values:
      first(SubjectKind::geometry_size, 0);
      return first(SubjectKind::geometry_layer, subject.part);
    case SubjectKind::tiles:
      first(SubjectKind::bitmap_size, 0);
      return first(SubjectKind::bitmap_layer, subject.part);
    default:
      return;
  }
}

void Outbox::write(const scene::Store& store, std::size_t bytes, Bytes& out, std::vector<Change>& sent) {
  while (out.size() < bytes && !order_.empty()) {
    const Subject subject = order_.front().first;
    const auto found = waiting_.find(subject);
    if (found == waiting_.end()) {
      order_.pop_front();
      continue;
    }
    write_what_it_needs(store, subject, out, sent);
    if (!is_range(subject.kind)) {
      write_whole(store, subject, out, sent);
      order_.pop_front();
      continue;
    }
    written_up_to_ = std::max(written_up_to_, found->second.changed_at);
    auto& ranges = found->second.ranges;
    const std::uint32_t count = element_count(store, subject);
    Change piece = found->second.change;
    piece.first = ranges.front().first;
    piece.end = std::min(ranges.front().second, count);
    if (piece.first < piece.end) {
      piece.end = std::min(piece.end, piece.first + elements_in(store, subject, chunk_bytes));
      describe_change(store, piece, [&](const scene::Command& command) { encode(command, out); });
      sent.push_back(piece);
      ranges.front().first = piece.end;
    } else {
      ranges.front().first = ranges.front().second;  // Cut off meanwhile.
    }
    if (ranges.front().first >= ranges.front().second) ranges.erase(ranges.begin());
    if (!ranges.empty()) continue;
    waiting_.erase(found);
    order_.pop_front();
  }
}

}  // namespace septet::replication
