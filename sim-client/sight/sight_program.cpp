#include "sim-client/sight/sight_program.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/document/text_file.hpp"
#include "engine/document/try_folder.hpp"
#include "logging/session/session_reader.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/sight/pairs.hpp"
#include "sim-client/sight/sight_words.hpp"

namespace septet::sight {
namespace {

constexpr double time_slack_s = 1e-6;

}  // namespace

Expected<int> run_sight(SightOptions options) {
  if (options.out.empty()) options.out = options.session.parent_path() / "sight";
  program::catch_stop_signals();
  const auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  const auto span = session->shown_span_s();
  if (!span) return tl::unexpected(span.error());
  const auto [first_s, last_s] = *span;
  const double from_s = options.from_s.value_or(first_s), to_s = options.to_s.value_or(last_s);
  if (!(from_s >= first_s - time_slack_s && to_s <= last_s + time_slack_s && from_s < to_s))
    return failure(fmt::format("from {} to {} s is not a part of the session, which lasts from {:.2f} to {:.2f} s",
                               from_s, to_s, first_s, last_s),
                   "--from, --to", "choose a beginning and a later end within it");
  const auto chosen = choose_pairs(*session, {.eyes = options.eyes,
                                              .target = options.target,
                                              .from_s = from_s,
                                              .to_s = to_s,
                                              .range_m = options.range_m,
                                              .most = options.pairs});
  if (!chosen) return tl::unexpected(chosen.error());
  if (auto writable = document::try_folder(options.out); !writable) return tl::unexpected(writable.error());
  const auto lookings = lookings_of(*chosen);
  program::ProgressLine progress;
  const auto sight = sight_of(
      {.session = options.session,
       .from_s = from_s,
       .to_s = to_s,
       .every_ticks = std::max(1, static_cast<int>(std::lround(options.every_s * session->info().ticks_per_second))),
       .mirrors = options.mirrors,
       .threshold = options.threshold},
      directed(lookings), [&](double share) {
        if (progress.is_due(program::monotonic_s()))
          progress.show(fmt::format("{:.0f} % of {} pairs", 100.0 * share, chosen->size()));
        return !program::should_stop();
      });
  progress.close();
  if (!sight) return tl::unexpected(sight.error());
  if (sight->stopped) {
    program::say("septet: stopped; nothing is written");
    return program::failed_status;
  }
  std::string text;
  for (const std::string& sentence : sentences(*sight, lookings, options.threshold)) text += sentence + "\n";
  const auto written = document::write_text_files(
      options.out, {{"sight.csv", table(*sight, lookings)},
                    {"sight.svg", chart(*sight, lookings, options.threshold,
                                        fmt::format("Unobstructed, {:.2f} to {:.2f} s", from_s, to_s))},
                    {"sight.txt", text}});
  if (!written) return tl::unexpected(written.error());
  text += fmt::format("{}: sight.csv, sight.svg, sight.txt", options.out.string());
  program::announce(text);
  return 0;
}

}  // namespace septet::sight
