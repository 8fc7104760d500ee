#include "command-line/command/what_if_command.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <ostream>
#include <utility>

#include <fmt/core.h>

#include "command-line/command/what_if_table.hpp"
#include "command-line/command/what_if_variants.hpp"
#include "engine/core/random.hpp"
#include "engine/document/text_file.hpp"
#include "engine/document/try_folder.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/machines.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "sim-server/drive/what_if/variant_session.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

/// Longer than any drive; a table's runs last as long as the session.
constexpr double whole_drive_s = 1e6;

/// The command's changes: some are the same in all variants, one at most is a range.
struct AskedChanges {
  std::vector<ChangeRange> each;
  std::optional<std::size_t> range;  ///< Which of them.

  std::size_t count() const { return range ? each[*range].count : 1; }
  std::vector<InputChange> of(std::size_t variant) const {
    std::vector<InputChange> changes;
    for (std::size_t i = 0; i < each.size(); ++i)
      changes.push_back(range == i ? change_at(each[i], variant) : each[i].first);
    return changes;
  }
  RanVariant ran(std::size_t variant, VariantOutcome outcome) const {
    RanVariant row{.changes = {}, .value = {}, .outcome = std::move(outcome)};
    const auto changes = of(variant);
    for (const InputChange& change : changes) row.changes += (row.changes.empty() ? "" : " ") + text_of(change);
    if (range) row.value = changes[*range].value;
    return row;
  }
};

Expected<AskedChanges> read_changes(const std::vector<std::string>& texts) {
  AskedChanges asked;
  for (const auto& text : texts) {
    auto change = parse_change(text);
    if (!change) return tl::unexpected(change.error());
    if (change->count > 1) {
      if (asked.range)
        return failure("two ranges are given", fmt::format("--change {}", text),
                       "give one range, the others as values");
      asked.range = asked.each.size();
    }
    asked.each.push_back(*change);
  }
  return asked;
}

Expected<int> run_one(const logging::SessionReader& session, const WhatIf& what_if, const AskedChanges& asked,
                      const fs::path& folder, std::ostream& out) {
  const auto changes = asked.of(0);
  auto outcome = run_variant(what_if, changes);
  if (!outcome) return tl::unexpected(outcome.error());
  const RanVariant ran = asked.ran(0, std::move(*outcome));
  const auto written = write_variant_session(session, what_if, changes, folder);
  if (!written) return tl::unexpected(written.error());
  if (auto table = document::write_text_file(folder / "what-if.csv", variants_csv(what_if, {&ran, 1})); !table)
    return tl::unexpected(table.error());
  out << fmt::format("{}: {}\n{}\n", ran.changes,
                     outcome_text(ran.outcome, what_if.logged ? &*what_if.logged : nullptr), written->string());
  return 0;
}

/// Outcomes of variants 0 to `count` − 1, on all processors and machines; empty in all programs but the first.
Expected<std::optional<std::vector<VariantOutcome>>> run_all(const WhatIf& what_if, const RunVariant& run,
                                                             std::size_t count, unsigned jobs,
                                                             program::Machines* machines, std::ostream& out) {
  program::catch_stop_signals();
  program::ProgressLine line;
  const double begun_s = program::monotonic_s();
  const auto go_on = [&](std::size_t done) {
    if (line.is_due(program::monotonic_s())) line.show(fmt::format("{} of {} variants", done, count));
    return !program::should_stop();
  };
  std::optional<std::vector<VariantOutcome>> outcomes;
  if (machines) {
    auto all = run_variants_on(*machines, what_if, run, count, jobs, go_on);
    if (!all) return all;
    outcomes = std::move(*all);
  } else {
    std::vector<std::size_t> variants(count);
    std::iota(variants.begin(), variants.end(), std::size_t{0});
    auto all = run_variants(what_if, run, variants, jobs, go_on);
    if (!all) return tl::unexpected(all.error());
    outcomes = std::move(*all);
  }
  line.close();
  const double took_s = program::monotonic_s() - begun_s;
  if (outcomes) out << fmt::format("{:.0f} variants a minute\n", 60.0 * static_cast<double>(count) / took_s);
  return outcomes;
}

Expected<int> run_range(const WhatIf& what_if, const AskedChanges& asked, const fs::path& folder, unsigned jobs,
                        program::Machines* machines, std::ostream& out) {
  const std::size_t count = asked.count();
  auto outcomes = run_all(
      what_if, [&](std::size_t i) { return run_variant(what_if, asked.of(i)); }, count, jobs, machines, out);
  if (!outcomes) return tl::unexpected(outcomes.error());
  if (!*outcomes) return 0;
  std::vector<RanVariant> ran;
  ran.reserve(count);
  for (std::size_t i = 0; i < count; ++i) ran.push_back(asked.ran(i, std::move((**outcomes)[i])));
  if (auto written =
          document::write_text_files(folder, {{"what-if.csv", variants_csv(what_if, ran)},
                                              {"what-if.svg", range_plot(what_if, asked.each[*asked.range], ran)}});
      !written)
    return tl::unexpected(written.error());
  out << range_sentence(ran) << '\n' << (folder / "what-if.csv").string() << '\n';
  return 0;
}

/// Run i's departure from its table: even over the rows' ±.
simulation::MotionDeviation deviation_of(std::uint64_t seed, std::size_t run) {
  Random random(seed, run);
  simulation::MotionDeviation deviation;
  using simulation::MotionValues;
  for (double MotionValues::*value :
       {&MotionValues::time_s, &MotionValues::x_m, &MotionValues::y_m, &MotionValues::heading_rad,
        &MotionValues::speed_mps, &MotionValues::yaw_rate_radps})
    deviation.share.*value = random.uniform(-1.0, 1.0);
  return deviation;
}

std::string text_of(const simulation::MotionDeviation& deviation, bool is_path) {
  const simulation::MotionValues& share = deviation.share;
  return is_path ? fmt::format("time:{:+.4f} x:{:+.4f} y:{:+.4f} heading:{:+.4f}", share.time_s, share.x_m, share.y_m,
                               share.heading_rad)
                 : fmt::format("time:{:+.4f} speed:{:+.4f} yaw_rate:{:+.4f}", share.time_s, share.speed_mps,
                               share.yaw_rate_radps);
}

/// Sessions of the first runs, and the words that show them in one film.
Expected<void> write_runs(const logging::SessionReader& session, const WhatIf& what_if, std::size_t count,
                          const fs::path& folder, std::ostream& out) {
  const std::uint64_t seed = what_if.recorded.loaded.model->seed;
  std::string film = "septet film " + session.path().string();
  for (std::size_t i = 0; i < count; ++i) {
    const auto written =
        write_run_session(session, what_if, deviation_of(seed, i), folder, fmt::format("run-{}.sqlite", i + 1));
    if (!written) return tl::unexpected(written.error());
    film += " --ghost " + written->string();
  }
  if (count > 0) out << "as ghosts in one film: " << film << '\n';
  return {};
}

Expected<int> run_deviations(const logging::SessionReader& session, const WhatIf& what_if,
                             const WhatIfCommandOptions& options, unsigned jobs, program::Machines* machines,
                             std::ostream& out) {
  const std::size_t runs = options.runs;
  const fs::path folder = what_if_folder(options);
  const simulation::Model& model = *what_if.recorded.loaded.model;
  auto outcomes = run_all(
      what_if, [&](std::size_t i) { return run_deviating(what_if, deviation_of(model.seed, i)); }, runs, jobs, machines,
      out);
  if (!outcomes) return tl::unexpected(outcomes.error());
  if (!*outcomes) return 0;
  std::vector<RanVariant> ran;
  ran.reserve(runs);
  for (std::size_t i = 0; i < runs; ++i)
    ran.push_back({text_of(deviation_of(model.seed, i), model.motion->is_path), {}, std::move((**outcomes)[i])});
  if (auto written = document::write_text_files(folder, {{"what-if.csv", variants_csv(what_if, ran)}}); !written)
    return tl::unexpected(written.error());
  out << share_sentence(ran) << '\n' << (folder / "what-if.csv").string() << '\n';
  if (auto written = write_runs(session, what_if, std::min(options.sessions, runs), folder, out); !written)
    return tl::unexpected(written.error());
  return 0;
}

Expected<int> run_here(const WhatIfCommandOptions& options, program::Machines* machines, std::ostream& out) {
  const auto asked = read_changes(options.changes);
  if (!asked) return tl::unexpected(asked.error());
  const auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  std::vector<std::vector<InputChange>> extremes;
  if (!asked->each.empty()) extremes = {asked->of(0), asked->of(asked->count() - 1)};
  if (options.sessions > 0 && options.runs == 0)
    return failure("--sessions is given without --runs", options.session.string(), "add --runs N");
  if (options.runs > 0 && !asked->each.empty())
    return failure("--runs and --change are given", options.session.string(), "give one of them");
  WhatIfOptions run = options.run;
  if (options.runs > 0) run.seconds = whole_drive_s;
  const auto what_if = prepare_what_if(*session, extremes, run);
  if (!what_if) return tl::unexpected(what_if.error());
  const bool is_first = !machines || machines->own_number() == 0;
  if (is_first) {
    out << fmt::format("{} ticks run again from {:g} s without a change: every state hash agrees\n",
                       what_if->agreeing_ticks, static_cast<double>(what_if->begin) / simulation::tick_rate_hz);
    out << "as logged: " << (what_if->logged ? collision_text(what_if->logged->met) : "no collision") << '\n';
    out.flush();
  }
  if (asked->each.empty() && options.runs == 0) return 0;
  if (!machines)  // Programs of mpirun wait for each other.
    if (auto writable = document::try_folder(what_if_folder(options)); !writable)
      return tl::unexpected(writable.error());
  const unsigned jobs = options.jobs > 0 ? options.jobs : program::share_of_processors();
  if (options.runs > 0) return run_deviations(*session, *what_if, options, jobs, machines, out);
  if (asked->range) return run_range(*what_if, *asked, what_if_folder(options), jobs, machines, out);
  return is_first ? run_one(*session, *what_if, *asked, what_if_folder(options), out) : 0;
}

}  // namespace

fs::path what_if_folder(const WhatIfCommandOptions& options) {
  return options.out.empty() ? fs::absolute(options.session).parent_path() / "what-if" : options.out;
}

Expected<int> run_what_if(const WhatIfCommandOptions& options, std::ostream& out) {
  const auto number = program::number_by_mpirun();
  if (!number) return run_here(options, nullptr, out);
  auto machines = program::start_machines();
  if (!machines) return *number > 0 ? Expected<int>(program::failed_status) : tl::unexpected(machines.error());
  auto status = run_here(options, machines->get(), out);
  out.flush();
  // The first program runs what another one leaves undone: one message is enough.
  if (!status && *number == 0) program::say("septet: " + describe(status.error()));
  (*machines)->will_end_with(status.value_or(program::failed_status));
  return status.value_or(program::failed_status);
}

}  // namespace septet::server
