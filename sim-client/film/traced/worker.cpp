#include "sim-client/film/traced/worker.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "program/clock.hpp"
#include "program/temporary_folder.hpp"
#include "sim-client/film/traced/frame_tracers.hpp"
#include "sim-client/film/traced/messages.hpp"
#include "sim-client/film/traced/photon_exchange.hpp"
#include "sim-client/film/traced/statistics.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t master = 0;
constexpr std::chrono::microseconds pause{1000};

/// Threads that trace the tiles of a run one by one, in order.
class TracingThreads {
 public:
  TracingThreads(const FrameTracers& tracers, std::span<const instant::PixelRectangle> tiles,
                 const FilmOptions& options, unsigned threads, std::optional<double> pace)
      : tracers_(tracers), tiles_(tiles), options_(options), pace_(pace) {
    for (unsigned n = 0; n < threads; ++n) threads_.emplace_back([this] { work(); });
  }
  ~TracingThreads() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
  }

  /// True if no tile is being traced: a new frame may be begun.
  bool is_idle() {
    const std::lock_guard lock(mutex_);
    return next_ >= end_ && busy_ == 0;
  }
  void begin_frame(std::size_t frame, const FrameFacts& facts) {
    const std::lock_guard lock(mutex_);
    frame_ = frame, facts_ = facts;
  }
  void set_run(std::uint32_t first, std::uint32_t end) {
    {
      const std::lock_guard lock(mutex_);
      next_ = first, end_ = std::min(end, static_cast<std::uint32_t>(tiles_.size()));
    }
    changed_.notify_all();
  }
  void shorten(std::uint32_t end) {
    const std::lock_guard lock(mutex_);
    end_ = std::min(end_, end);
  }
  /// Messages about finished tiles; with `waits`, waits a moment for one.
  std::deque<Bytes> done(bool waits) {
    std::unique_lock lock(mutex_);
    if (waits && done_.empty()) came_.wait_for(lock, pause);
    return std::exchange(done_, {});
  }

 private:
  raytrace::Bucket trace(std::uint32_t tile) const {
    if (options_.sample_sets == 1) return tracers_.trace(tiles_[tile], std::nullopt);
    const auto of_set = static_cast<std::uint32_t>(tiles_.size() / options_.sample_sets);
    return tracers_.trace(tiles_[tile], raytrace::sample_set(options_.samples, tile / of_set, options_.sample_sets));
  }
  void work() {
    std::unique_lock lock(mutex_);
    std::chrono::steady_clock::time_point due;
    while (true) {
      if (next_ >= end_) due = {};
      changed_.wait(lock, [&] { return stop_ || next_ < end_; });
      if (stop_) return;
      const std::uint32_t tile = next_++;
      ++busy_;
      lock.unlock();
      if (due == std::chrono::steady_clock::time_point()) due = std::chrono::steady_clock::now();
      const double begun_s = thread_cpu_s();
      const raytrace::Bucket bucket = trace(tile);
      const double cpu_s = thread_cpu_s() - begun_s;
      if (pace_) {
        due += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(cpu_s / *pace_));
        std::this_thread::sleep_until(due);
      }
      Bytes bytes = message(Word::tile);
      ByteWriter writer(bytes);
      writer.put(std::uint64_t{frame_}), writer.put(tile), writer.put(cpu_s);
      writer.put_bytes(encode_tile(facts_, bucket.pixels));
      lock.lock();
      --busy_;
      done_.push_back(std::move(bytes));
      came_.notify_all();
    }
  }

  const FrameTracers& tracers_;
  std::span<const instant::PixelRectangle> tiles_;
  const FilmOptions& options_;
  std::optional<double> pace_;
  std::mutex mutex_;
  std::condition_variable changed_, came_;
  std::size_t frame_ = 0;  ///< Written while no tile is being traced.
  FrameFacts facts_;
  std::uint32_t next_ = 0, end_ = 0;
  unsigned busy_ = 0;
  std::deque<Bytes> done_;
  bool stop_ = false;
  std::vector<std::jthread> threads_;  ///< Last: they use the rest.
};

/// Messages of the master, until its end.
class Listening {
 public:
  /// `master_process`: the process that must exist where that can be seen.
  explicit Listening(Machines& machines, program::ProcessMark master_process = {})
      : machines_(machines), master_process_(std::move(master_process)), asked_s_(program::monotonic_s()) {}

  /// Calls `obey(word, reader)` with each message. False: it is the end.
  template <class Obey>
  Expected<bool> listen(const Obey& obey) {
    while (auto mail = machines_.receive()) {
      silent_s_ = 0.0;
      ByteReader reader(mail->bytes);
      const auto word = static_cast<Word>(reader.get<std::uint8_t>());
      if (word == Word::end) {
        if (reader.get<std::uint8_t>() != 0) machines_.note_loss();
        return false;
      }
      obey(word, reader);
    }
    const double now_s = program::monotonic_s();
    if (now_s < asked_s_ + still_there_every_s) return true;
    // A machine that slept has heard nothing meanwhile, which proves nothing.
    silent_s_ += std::min(now_s - asked_s_, 2.0 * still_there_every_s);
    asked_s_ = now_s;
    machines_.send(master, message(Word::still_there));
    if (silent_s_ > longest_silence_s || !program::is_there(master_process_).value_or(true)) {
      machines_.note_loss();
      return failure(fmt::format("nothing has come from the master for {:.0f} s", silent_s_), "mpirun",
                     "start the film again with --resume");
    }
    return true;
  }

 private:
  Machines& machines_;
  program::ProcessMark master_process_;
  double asked_s_, silent_s_ = 0.0;
};

/// Waits for the film, then for the session's bytes. Empty: the master has ended before.
Expected<std::optional<FilmTold>> fetch_film(Machines& machines, const fs::path& folder) {
  std::optional<FilmTold> told;
  std::ofstream session(folder / "session.sqlite", std::ios::binary);
  std::uint64_t there = 0, asked = 0;
  const auto ask = [&] {
    Bytes bytes = message(Word::part_wanted);
    ByteWriter(bytes).put(there);
    machines.send(master, std::move(bytes));
    asked = there;
  };
  for (Listening listening(machines);;) {
    const auto goes_on = listening.listen([&](Word word, ByteReader& reader) {
      if (word == Word::film && !told) {
        told = read_film(reader);
        ask();
      } else if (word == Word::part && told && reader.get<std::uint64_t>() == there) {
        const auto bytes = reader.take(reader.remaining());
        session.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        there += bytes.size();
      }
    });
    if (!goes_on) return tl::unexpected(goes_on.error());
    if (!*goes_on) return std::nullopt;
    session.flush();
    if (!session) return failure("the session finds no room there", folder.string(), "make room, or set TMPDIR");
    if (told && there >= told->session_bytes) break;
    if (told && there > asked) ask();
    std::this_thread::sleep_for(pause);
  }
  told->options.session = folder / "session.sqlite";
  if (told->script) {
    told->options.shots = folder / "shots.toml";
    std::ofstream(told->options.shots, std::ios::binary) << *told->script;
  }
  return told;
}

Expected<void> serve(Machines& machines, program::ProcessMark& master_process) {
  const unsigned threads = program::share_of_processors();
  machines.send(master, hello_message(threads));
  auto folder = program::TemporaryFolder::make("septet-film");
  if (!folder) return tl::unexpected(folder.error());
  const auto told = fetch_film(machines, folder->path());
  if (!told) return tl::unexpected(told.error());
  if (!*told) return {};
  master_process = (*told)->master;
  auto frames = FilmFrames::open((*told)->options);
  if (!frames) return tl::unexpected(frames.error());
  return trace_for_master(machines, *frames, (*told)->options, threads, (*told)->master);
}

}  // namespace

std::optional<double> pace_of_test() {
  const char* text = std::getenv("SEPTET_FILM_PACES");
  if (!text) return std::nullopt;
  std::istringstream paces(text);
  std::string pace;
  for (int n = 0; std::getline(paces, pace, ','); ++n)
    if (n == program::number_by_mpirun().value_or(0)) return std::clamp(std::atof(pace.c_str()), 0.001, 1.0);
  return std::nullopt;
}

Expected<void> trace_for_master(Machines& machines, FilmFrames& frames, const FilmOptions& options, unsigned threads,
                                const program::ProcessMark& master_process) {
  auto tracers = FrameTracers::create(frames);
  if (!tracers) return tl::unexpected(tracers.error());
  const auto tiles = tiles_of(options);
  TracingThreads tracing(*tracers, tiles, options, threads, pace_of_test());
  std::optional<raytrace::TileRun> wanted;
  std::optional<std::size_t> frame, soon;
  std::optional<PhotonGathering> photons;  ///< Photons of a frame in preparation.
  double begun_s = 0.0;
  machines.send(master, message(Word::prepared));
  Listening listening(machines, master_process);
  while (true) {
    const auto goes_on = listening.listen([&](Word word, ByteReader& reader) {
      if (photons && word == Word::photons) photons->came(reader);
      if (photons && word == Word::shoot)
        if (const auto run = read_photon_run(reader)) photons->told(*run);
      const bool is_run = word == Word::soon || word == Word::run || word == Word::shorter_run;
      const auto run = is_run ? read_run(reader) : std::nullopt;
      if (!run || run->frame >= frames.plan().frames.size()) return;
      if (word == Word::soon)
        soon = run->frame;
      else if (word == Word::run)
        wanted = run, tracing.shorten(0);
      else if (wanted && wanted->frame == run->frame)
        wanted->end = std::min(wanted->end, run->end);
      else if (frame == run->frame)
        tracing.shorten(run->end);
    });
    if (!goes_on) return tl::unexpected(goes_on.error());
    if (!*goes_on) return {};
    const auto target = wanted ? std::optional(wanted->frame) : std::exchange(soon, std::nullopt);
    const auto begun = photons ? std::optional<std::size_t>(photons->frame()) : frame;
    if (target && begun != target && tracing.is_idle()) {
      begun_s = program::monotonic_s();
      photons.reset();
      frame.reset();
      if (auto done = tracers->begin(frames, *target, options); !done) return done;
      photons.emplace(tracers->light(), *target, threads);
    }
    if (photons) {
      if (auto question = photons->question()) machines.send(master, std::move(*question));
      for (Bytes& bytes : photons->shoot()) machines.send(master, std::move(bytes));
      if (photons->is_whole()) {
        frame = photons->frame();
        photons.reset();
        tracing.begin_frame(*frame, facts_of(tracers->light().instant()));
        Bytes bytes = message(Word::ready);
        ByteWriter writer(bytes);
        writer.put(std::uint64_t{*frame}), writer.put(program::monotonic_s() - begun_s);
        machines.send(master, std::move(bytes));
      }
    }
    if (wanted && frame == wanted->frame) {
      tracing.set_run(wanted->first, wanted->end);
      wanted.reset();
    }
    for (Bytes& bytes : tracing.done(!photons || !photons->has_work())) machines.send(master, std::move(bytes));
  }
}

int serve_master(Machines& machines) {
  program::ProcessMark master_process;
  const auto served = serve(machines, master_process);
  if (served) return 0;
  machines.send(master, error_message(served.error()));
  // mpirun ends all programs if one ends with another status than 0, or before the rest: the film goes on without this
  // one.
  Listening listening(machines, master_process);
  while (true) {
    const auto goes_on = listening.listen([](Word, ByteReader&) {});
    if (!goes_on) return 1;
    if (!*goes_on) return 0;
    std::this_thread::sleep_for(10 * pause);
  }
}

}  // namespace septet::film
