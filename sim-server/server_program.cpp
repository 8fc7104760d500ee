#include "sim-server/server_program.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "program/child_process.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/stop_signal.hpp"
#include "sim-server/attendants/allowed_list.hpp"
#include "sim-server/attendants/console.hpp"
#include "sim-server/attendants/desk.hpp"
#include "sim-server/attendants/drive_log.hpp"
#include "sim-server/attendants/guidance_voice.hpp"
#include "sim-server/attendants/operator_lines.hpp"
#include "sim-server/attendants/scene_edits.hpp"
#include "sim-server/attendants/screens.hpp"
#include "sim-server/attendants/sound.hpp"
#include "sim-server/drive/driver_word.hpp"
#include "sim-server/drive/opened_drive.hpp"
#include "sim-server/drive/operator_desk.hpp"
#include "sim-server/drive/world_gate.hpp"
#include "sim-server/host/serve.hpp"

namespace septet::server {
namespace {

/// The machine's clock, for a drive without screens.
class MachineClock final : public ServeClock {
 public:
  double now_s() const override { return program::monotonic_s(); }
  void wait(double seconds) override { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }
};

/// Ticks from a drive's first one to the end of the requested seconds. 0 for a drive that lasts until it is ended; one
/// that is to last, however short, has a tick.
std::uint64_t ticks_of(double seconds, double tick_rate_hz, Tick first) {
  if (seconds <= 0.0) return 0;
  const auto ticks = static_cast<std::uint64_t>(std::llround(seconds * tick_rate_hz));
  return ticks > first ? ticks - first : 1;
}

bool is_lesson(const LoadedDrive& drive) {
  return std::ranges::find(drive.sources, logging::lesson_role, &logging::SourceFile::role) != drive.sources.end();
}

ServeOptions serve_options(const ServerOptions& options, const OpenedDrive& drive) {
  ServeOptions serving{
      .lockstep = options.lockstep,
      .ticks = ticks_of(options.seconds, drive.source->tick_rate_hz(), drive.live ? drive.live->state().tick : 0),
      .can_go_without = true};
  if (serving.ticks > 0) serving.draw_every_ticks = std::min(serving.draw_every_ticks, serving.ticks);
  if (drive.by_person && !options.start_now) {
    const bool by_keyboard = drive.loaded.rig.car.source == rig::CarSource::keyboard;
    serving.wait_for_driver = by_keyboard ? "Press any key to start" : "Press a pedal or turn the wheel to start";
    if (by_keyboard && drive.live)
      serving.words_at_end = [is_lesson = is_lesson(drive.loaded)](logging::DriveEnd end) {
        return words_at_end(end, is_lesson);
      };
  }
  if (drive.live) serving.about = printable(drive.loaded.model->scenario.header.description, 200);
  serving.wait_for_screens_s =
      options.wait_for_screens_s < 0.0 ? std::numeric_limits<double>::infinity() : options.wait_for_screens_s;
  return serving;
}

Expected<std::unique_ptr<OperatorDesk>> open_desk(const ServerOptions& options, const OpenedDrive& drive,
                                                  WorldGate* gate, program::ProgressLine& line) {
  if (!gate) return failure("a session that is shown again has no operator", "--page", "leave --page away");
  auto desk = OperatorDesk::open(options, drive.loaded, *gate);
  if (!desk) return desk;
  line.message("operator's page: " + (*desk)->url());
  if (!(*desk)->speaks()) line.message("espeak-ng is not installed: a word to the student is text alone");
  return desk;
}

/// The list of attendants, in the order in which they begin, and the two that the program uses directly.
struct Attendance {
  std::unique_ptr<WorldGate> gate;  ///< Outlives the attendants; null: a replay.
  Attendants list;
  Screens* screens = nullptr;  ///< Null: no screens.
  DriveLog* log = nullptr;     ///< Null: a replay.
};

/// Opens all attendants of the drive. Error: one cannot be opened; no attendant has begun.
Expected<Attendance> gather(const ServerOptions& options, const ServeOptions& serving, OpenedDrive& drive,
                            program::ProgressLine& line) {
  Attendance all;
  std::unique_ptr<Screens> screens;
  if (!options.no_screens) {
    auto opened = Screens::open(options, serving, drive, line);
    if (!opened) return tl::unexpected(opened.error());
    screens = std::move(*opened);
  }
  ScreenHost* host = screens ? &screens->host() : nullptr;
  const rig::Rig& rig = drive.loaded.rig;
  if (drive.live) {
    all.gate = std::make_unique<WorldGate>(drive);
    auto log = std::make_unique<DriveLog>(options, drive.loaded, drive.store, *drive.live, host, line);
    all.log = log.get();
    all.list.push_back(std::move(log));
  }
  all.list.push_back(std::make_unique<Console>(line, drive.live, host != nullptr));
  if (options.page_port) {
    auto desk = open_desk(options, drive, all.gate.get(), line);
    if (!desk) return tl::unexpected(desk.error());
    all.list.push_back(std::make_unique<Desk>(std::move(*desk), *all.log, host));
  }
  if (rig.sound && !options.no_sound && !options.lockstep && host)
    all.list.push_back(std::make_unique<Sound>(
        SoundSources{rig, drive.loaded.model, drive.session ? &*drive.session : nullptr, drive.store}, drive.live));
  if (drive.live && host && !options.no_sound && !options.lockstep)
    all.list.push_back(std::make_unique<GuidanceVoice>(Speaker(program::find_program("espeak-ng")), options.language));
  if (screens) all.list.push_back(std::make_unique<OperatorLines>(drive, *host, all.log, all.gate.get()));
  if (screens || drive.live)
    all.list.push_back(std::make_unique<SceneEdits>(drive, host, all.log, all.gate.get(), options.save));
  if (screens) {
    all.list.push_back(std::make_unique<AllowedList>(options.keys / "allowed-clients", *host));
    all.screens = screens.get();
    all.list.push_back(std::move(screens));
  }
  return all;
}

}  // namespace

Expected<logging::DriveEnd> run_server(ServerOptions options) {
  if (options.replay.empty())
    if (auto known = check_names(options); !known) return tl::unexpected(known.error());
  if (auto found = find_files(options); !found) return tl::unexpected(found.error());
  program::ProgressLine line;
  const auto drive = open_drive(options, line);
  if (!drive) return tl::unexpected(drive.error());
  TickSource& source = *(*drive)->source;
  const ServeOptions serving = serve_options(options, **drive);
  const auto all = gather(options, serving, **drive, line);
  if (!all) return tl::unexpected(all.error());
  // From here on there is something to be ended in order.
  program::catch_stop_signals();
  for (const auto& attendant : all->list)
    if (auto begun = attendant->begin(); !begun) return tl::unexpected(begun.error());
  if (!all->screens) program::announce("ready 0");
  MachineClock clock;
  ServeResult result = all->screens ? serve(source, all->screens->host(), serving, all->list, *all->screens)
                                    : run_headless(source, serving.ticks, all->list, clock);
  std::for_each(all->list.rbegin(), all->list.rend(), [&](const auto& attendant) { attendant->close(result); });
  // The log keeps how the drive ended; this line tells `septet drive` whether to begin it again.
  program::announce(fmt::format("ended {} {}", name_of(result.begins_again ? logging::DriveEnd::restart : result.end),
                                all->log ? all->log->session().ending(result) : std::string(text_of(result.end))));
  return result.end;
}

}  // namespace septet::server
