#include "engine/net/baseline_tracker.hpp"

#include <algorithm>

namespace septet::net {

void BaselineTracker::join(Client client, double now_s) {
  State& state = clients_[client];
  const bool waiting = state.live && state.acknowledged.empty();
  state.acknowledged.clear();
  state.heard_s = now_s;
  if (now_s < state.barred_until_s) return;
  // Asking again does not renew the patience.
  if (!waiting) state.waiting_since_s = now_s;
  state.live = true;
}

void BaselineTracker::leave(Client client) { clients_.erase(client); }

void BaselineTracker::heard(Client client, double now_s) {
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  State& state = found->second;
  state.heard_s = now_s;
  if (!state.live && now_s >= state.barred_until_s) join(client, now_s);
}

void BaselineTracker::acknowledge(Client client, std::uint64_t tick, double now_s) {
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  heard(client, now_s);
  std::vector<std::uint64_t>& ticks = found->second.acknowledged;
  const auto place = std::lower_bound(ticks.begin(), ticks.end(), tick);
  if (place != ticks.end() && *place == tick) return;
  ticks.insert(place, tick);
  if (ticks.size() > options_.history) ticks.erase(ticks.begin());
}

void BaselineTracker::advance_to(double now_s) {
  for (auto& [client, state] : clients_) {
    if (!state.live) continue;
    const bool silent = now_s - state.heard_s > options_.silence_s;
    const bool mute = state.acknowledged.empty() && now_s - state.waiting_since_s > options_.patience_s;
    if (!silent && !mute) continue;
    state.live = false;
    state.acknowledged.clear();
    if (mute && !silent) state.barred_until_s = now_s + options_.penalty_s;
  }
}

std::optional<std::uint64_t> BaselineTracker::baseline() const {
  std::optional<std::vector<std::uint64_t>> common;
  for (const auto& [client, state] : clients_) {
    if (!state.live) continue;
    if (!common) {
      common = state.acknowledged;
      continue;
    }
    std::vector<std::uint64_t> both;
    std::set_intersection(common->begin(), common->end(), state.acknowledged.begin(), state.acknowledged.end(),
                          std::back_inserter(both));
    common = std::move(both);
  }
  if (!common || common->empty()) return std::nullopt;
  return common->back();
}

bool BaselineTracker::is_live(Client client) const {
  const auto found = clients_.find(client);
  return found != clients_.end() && found->second.live;
}

}  // namespace septet::net
