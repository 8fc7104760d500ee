#include "sim-server/attendants/edit_turns.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/core.h>

namespace septet::server {
namespace {

std::size_t memory_of(const SceneRequest& request) {
  return request.batch.bytes + request.batch.changes.size() * sizeof(scene::Command);
}

std::size_t work_of(const SceneRequest& request) {
  return request.batch.changes.size() + request.batch.bytes / bytes_of_edit_work;
}

}  // namespace

void EditTurns::begin_tick(Tick from) {
  from_ = from;
  work_ = 0;
  for (auto entry = queues_.begin(); entry != queues_.end();) {
    Queue& queue = entry->second;
    queue.work -= std::min(queue.work, most_edit_work_a_tick);
    for (; !queue.later.empty() && queue.later.begin()->first <= from; queue.later.erase(queue.later.begin()))
      queue.due.push_back(std::move(queue.later.begin()->second));
    const bool is_idle = queue.work == 0 && queue.due.empty() && queue.later.empty();
    entry = is_idle ? queues_.erase(entry) : std::next(entry);
  }
}

std::optional<std::string> EditTurns::refusal(const SceneRequest& request) const {
  if (const Tick tick = request.batch.tick; tick > from_ && tick - from_ > most_ticks_ahead)
    return fmt::format("tick {} is more than {} ticks ahead of {}: name a nearer one", tick, most_ticks_ahead, from_);
  const auto found = queues_.find(request.editor.name);
  const std::size_t waiting = found == queues_.end() ? 0 : found->second.bytes;
  if (waiting + memory_of(request) <= most_edit_bytes_waiting) return std::nullopt;
  return "this editor's changes that wait for their turn or tick fill its queue: send fewer";
}

void EditTurns::add(SceneRequest request) {
  Queue& queue = queues_[request.editor.name];
  queue.bytes += memory_of(request);
  if (const Tick tick = request.batch.tick; tick > from_)
    queue.later.emplace(tick, std::move(request));
  else
    queue.due.push_back(std::move(request));
}

std::optional<SceneRequest> EditTurns::next() {
  if (work_ >= most_edit_work_of_all_a_tick) return std::nullopt;
  const auto has_turn = [](const auto& entry) {
    return !entry.second.due.empty() && entry.second.work < most_edit_work_a_tick;
  };
  const auto after_last = queues_.upper_bound(last_);
  auto entry = std::find_if(after_last, queues_.end(), has_turn);
  if (entry == queues_.end()) {
    entry = std::find_if(queues_.begin(), after_last, has_turn);
    if (entry == after_last) return std::nullopt;
  }
  auto& [name, queue] = *entry;
  last_ = name;
  SceneRequest request = std::move(queue.due.front());
  queue.due.pop_front();
  queue.bytes -= memory_of(request);
  const std::size_t work = work_of(request);
  queue.work += work;
  work_ += work;
  return request;
}

}  // namespace septet::server
