#include "command-line/command/what_if_variants.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include <fmt/core.h>

#include "engine/core/hash.hpp"

namespace septet::server {
namespace {

constexpr std::size_t variants_a_job = 8, longest_name = 1000;

tl::unexpected<Error> stopped(const WhatIf& what_if) {
  return failure("stopped before all variants were run", what_if.where, "give the command again");
}

/// Outcomes of one batch, each by the first free of `jobs` threads.
Expected<std::vector<VariantOutcome>> run_batch(const RunVariant& run, std::span<const std::size_t> variants,
                                                unsigned jobs) {
  std::vector<std::optional<Expected<VariantOutcome>>> made(variants.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < variants.size(); i = next++) made[i].emplace(run(variants[i]));
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned job = 1; job < std::min<std::size_t>(jobs, variants.size()); ++job) threads.emplace_back(work);
    work();
  }
  std::vector<VariantOutcome> outcomes;
  outcomes.reserve(variants.size());
  for (auto& one : made) {
    if (!*one) return tl::unexpected(one->error());
    outcomes.push_back(std::move(**one));
  }
  return outcomes;
}

template <class T>
void put_optional(ByteWriter& writer, const std::optional<T>& value) {
  writer.put(static_cast<std::uint8_t>(value.has_value()));
  if (value) writer.put(*value);
}

template <class T>
std::optional<T> get_optional(ByteReader& reader) {
  if (reader.get<std::uint8_t>() == 0) return std::nullopt;
  if constexpr (std::is_same_v<T, double>)
    return reader.get_double();
  else
    return reader.get<T>();
}

/// What two programs must have in common: the state at the fork, which names build and drive.
std::uint64_t hash_of_fork(const WhatIf& what_if) {
  StateHash hash;
  hash.add_bytes(what_if.fork_state);
  return hash.value();
}

}  // namespace

Expected<std::vector<VariantOutcome>> run_variants(const WhatIf& what_if, const RunVariant& run,
                                                   const std::vector<std::size_t>& variants, unsigned jobs,
                                                   const std::function<bool(std::size_t)>& go_on) {
  std::vector<VariantOutcome> outcomes;
  const std::size_t batch = std::size_t{std::max(1u, jobs)} * variants_a_job;
  while (outcomes.size() < variants.size()) {
    const auto rest = std::span(variants).subspan(outcomes.size());
    auto some = run_batch(run, rest.first(std::min(batch, rest.size())), jobs);
    if (!some) return some;
    outcomes.insert(outcomes.end(), std::make_move_iterator(some->begin()), std::make_move_iterator(some->end()));
    if (!go_on(outcomes.size())) return stopped(what_if);
  }
  return outcomes;
}

Expected<std::optional<std::vector<VariantOutcome>>> run_variants_on(program::Machines& machines, const WhatIf& what_if,
                                                                     const RunVariant& run, std::size_t count,
                                                                     unsigned jobs,
                                                                     const std::function<bool(std::size_t)>& go_on) {
  const auto programs = static_cast<std::size_t>(machines.count());
  const auto own = static_cast<std::size_t>(machines.own_number());
  const std::uint64_t fork = hash_of_fork(what_if);
  const std::size_t batch = std::size_t{std::max(1u, jobs)} * variants_a_job;
  const auto always = [](std::size_t) { return true; };
  if (own != 0) {
    for (std::size_t i = own; i < count;) {
      std::vector<std::size_t> some;
      for (; i < count && some.size() < batch; i += programs) some.push_back(i);
      const auto outcomes = run_variants(what_if, run, some, jobs, always);
      if (!outcomes) return tl::unexpected(outcomes.error());
      Bytes bytes;
      ByteWriter writer(bytes);
      writer.put(fork);
      for (std::size_t n = 0; n < some.size(); ++n) {
        writer.put(static_cast<std::uint64_t>(some[n]));
        put_outcome((*outcomes)[n], bytes);
      }
      machines.send(0, std::move(bytes));
      if (!go_on(i)) return stopped(what_if);
    }
    return std::optional<std::vector<VariantOutcome>>();
  }
  std::vector<std::optional<VariantOutcome>> outcomes(count);
  const auto receive = [&] {
    while (const auto mail = machines.receive()) {
      ByteReader reader(mail->bytes);
      if (reader.get<std::uint64_t>() != fork) continue;
      while (reader.ok() && reader.remaining() > 0) {
        const auto i = reader.get<std::uint64_t>();
        VariantOutcome outcome = get_outcome(reader);
        if (reader.ok() && i < count) outcomes[i] = std::move(outcome);
      }
    }
  };
  // Its own share, then what is missing from the end on: the others work from the beginning.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; i += programs) order.push_back(i);
  for (std::size_t i = count; i-- > 0;)
    if (i % programs != 0) order.push_back(i);
  for (std::size_t at = 0;;) {
    receive();
    std::vector<std::size_t> some;
    for (; at < order.size() && some.size() < batch; ++at)
      if (!outcomes[order[at]]) some.push_back(order[at]);
    if (some.empty()) break;
    auto made = run_variants(what_if, run, some, jobs, always);
    if (!made) return tl::unexpected(made.error());
    for (std::size_t n = 0; n < some.size(); ++n) outcomes[some[n]] = std::move((*made)[n]);
    const auto done = std::ranges::count_if(outcomes, [](const auto& outcome) { return outcome.has_value(); });
    if (!go_on(static_cast<std::size_t>(done))) return stopped(what_if);
  }
  std::vector<VariantOutcome> all;
  all.reserve(count);
  for (auto& outcome : outcomes) all.push_back(std::move(*outcome));
  return std::optional(std::move(all));
}

void put_outcome(const VariantOutcome& outcome, Bytes& bytes) {
  ByteWriter writer(bytes);
  writer.put(static_cast<std::uint8_t>(outcome.collision.has_value()));
  if (const auto& met = outcome.collision) {
    writer.put(met->tick);
    put_optional(writer, met->other);
    writer.put_string(met->with.substr(0, longest_name));
    writer.put(met->closing_speed_mps);
    writer.put(met->delta_v_mps);
  }
  put_optional(writer, outcome.stopped_s);
  put_optional(writer, outcome.least_gap_m);
  put_optional(writer, outcome.before_place_m);
  writer.put(outcome.last_tick);
  writer.put(outcome.state_hash);
}

VariantOutcome get_outcome(ByteReader& reader) {
  VariantOutcome outcome;
  if (reader.get<std::uint8_t>() != 0) {
    MetCollision& met = outcome.collision.emplace();
    met.tick = reader.get<Tick>();
    met.other = get_optional<ParticipantId>(reader);
    met.with = reader.get_string(longest_name);
    met.closing_speed_mps = reader.get_double();
    met.delta_v_mps = reader.get_double();
  }
  outcome.stopped_s = get_optional<double>(reader);
  outcome.least_gap_m = get_optional<double>(reader);
  outcome.before_place_m = get_optional<double>(reader);
  outcome.last_tick = reader.get<Tick>();
  outcome.state_hash = reader.get<std::uint64_t>();
  return outcome;
}

}  // namespace septet::server
