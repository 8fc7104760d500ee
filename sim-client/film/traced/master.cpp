#include "sim-client/film/traced/master.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <fstream>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "program/clock.hpp"
#include "sim-client/film/traced/frame_writer.hpp"
#include "sim-client/film/traced/kept_tiles.hpp"
#include "sim-client/film/traced/photon_exchange.hpp"
#include "sim-client/film/traced/statistics.hpp"
#include "sim-client/film/traced/worker.hpp"

namespace septet::film {
namespace fs = std::filesystem;
using program::Mail;
namespace {

constexpr int own_worker = 0;
constexpr std::size_t part_bytes = 1 << 20, longest_told_script_bytes = 1 << 22;
constexpr double ask_again_after_s = 0.005;

/// Mailbox between the master and the worker that is a thread of the same program.
class OwnWorkersMail : public Machines {
 public:
  int own_number() const override { return own_worker; }
  int count() const override { return 1; }
  void send(int, Bytes bytes) override {
    const std::lock_guard lock(mutex_);
    from_worker_.push_back(std::move(bytes));
  }
  std::optional<Mail> receive() override { return taken(to_worker_); }
  void will_end_with(int) override {}

  void send_to_worker(Bytes bytes) {
    const std::lock_guard lock(mutex_);
    to_worker_.push_back(std::move(bytes));
  }
  std::optional<Mail> receive_from_worker() { return taken(from_worker_); }

 private:
  std::optional<Mail> taken(std::deque<Bytes>& queue) {
    const std::lock_guard lock(mutex_);
    if (queue.empty()) return std::nullopt;
    Mail mail{own_worker, std::move(queue.front())};
    queue.pop_front();
    return mail;
  }
  std::mutex mutex_;
  std::deque<Bytes> to_worker_, from_worker_;
};

class Master {
 public:
  Master(const FilmOptions& options, const FilmFrames& frames, const FilmFolder& folder, Machines* others,
         FilmMade& made)
      : options_(options),
        folder_(folder),
        others_(others),
        made_(made),
        tiles_(tiles_of(options)),
        schedule_(frames.plan().frames.size(), static_cast<std::uint32_t>(tiles_.size()), options.schedule),
        writer_(options, folder, frames, tiles_) {
    for (const FilmFrame& frame : frames.plan().frames) numbers_.push_back(frame.number);
  }

  Expected<void> take_up();
  Expected<void> run(FilmFrames& frames, const std::function<bool(const FilmMade&)>& go_on);

 private:
  struct Worker {
    int number = 0;
    Hello hello;
    std::size_t in_schedule = 0;
    double heard_s = 0.0;
    bool is_prepared = false, is_lost = false, has_given_up = false;
    bool traces = false;        ///< After `is_prepared` and a request for work; then it is in the schedule.
    bool is_ready = false;      ///< It has prepared a frame.
    double asks_again_s = 0.0;  ///< Time of its next request, after there was no work for it.
  };

  Expected<void> obey(const Mail& mail);
  Expected<void> take_tile(const Worker& worker, ByteReader& reader);
  void welcome(int number, ByteReader& reader);
  void take_in_or_out(Worker& worker);
  void look_who_is_there();
  void send_part(int number, ByteReader& reader);
  void deal();
  void tell_quality();
  void send(int to, Bytes bytes) {
    if (to == own_worker)
      own_.send_to_worker(std::move(bytes));
    else
      statistics_.sent_bytes += bytes.size(), others_->send(to, std::move(bytes));
  }
  void post(std::vector<PhotonExchange::Post> posts) {
    for (PhotonExchange::Post& each : posts) send(each.to, std::move(each.bytes));
  }
  /// Several trace this frame, or are about to.
  bool is_shared(std::uint64_t frame) const {
    return others_ && frame < numbers_.size() && !schedule_.has_frame(frame) &&
           schedule_.shares_frames(static_cast<std::size_t>(others_->count()));
  }
  Expected<KeptTiles*> kept(std::size_t frame);
  fs::path kept_file(std::size_t frame) const { return folder_.path() / fmt::format("{:06}.tiles", numbers_[frame]); }
  Worker* worker(int number) {
    const auto found =
        std::find_if(workers_.begin(), workers_.end(), [&](const Worker& w) { return w.number == number; });
    return found == workers_.end() ? nullptr : &*found;
  }

  const FilmOptions& options_;
  const FilmFolder& folder_;
  Machines* others_;
  FilmMade& made_;
  std::vector<instant::PixelRectangle> tiles_;
  raytrace::BucketSchedule schedule_;
  FrameWriter writer_;
  PhotonExchange photons_;
  std::vector<std::uint64_t> numbers_;  ///< Frame numbers, as in their pictures' names.
  std::vector<Worker> workers_;
  std::map<std::size_t, KeptTiles> kept_;
  OwnWorkersMail own_;
  FilmStatistics statistics_;
  std::ifstream session_;
  double now_s_ = 0.0;
  double shown_ = 0.0;  ///< Number of tiles at the last preview.
  double came_ = 0.0;
};

/// Takes over finished pictures and tiles.
Expected<void> Master::take_up() {
  if (!options_.resume) return {};
  std::error_code ignored;
  for (std::size_t frame = 0; frame < numbers_.size(); ++frame) {
    if (folder_.has(numbers_[frame], options_)) {
      schedule_.skip_frame(frame);
      fs::remove(kept_file(frame), ignored);
      ++made_.frames, ++made_.kept;
      continue;
    }
    if (!fs::exists(kept_file(frame), ignored)) continue;
    const auto tiles = kept(frame);
    if (!tiles) return tl::unexpected(tiles.error());
    for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile)
      if ((*tiles)->read(tile)) schedule_.skip_tile(frame, tile);
    if (schedule_.has_frame(frame)) {
      if (auto queued = writer_.finish(numbers_[frame], std::move(kept_.at(frame)), kept_file(frame)); !queued)
        return queued;
      kept_.erase(frame);
      ++made_.frames, ++made_.kept;
    }
  }
  made_.kept_of_next = schedule_.share_of_begun_frames();
  return {};
}

Expected<KeptTiles*> Master::kept(std::size_t frame) {
  auto found = kept_.find(frame);
  if (found == kept_.end()) {
    auto opened = KeptTiles::open(kept_file(frame), tiles_);
    if (!opened) return tl::unexpected(opened.error());
    found = kept_.emplace(frame, std::move(*opened)).first;
  }
  return &found->second;
}

Expected<void> Master::take_tile(const Worker& from, ByteReader& reader) {
  const auto frame = reader.get<std::uint64_t>();
  const auto tile = reader.get<std::uint32_t>();
  const double cpu_s = reader.get_double();
  const auto encoded = reader.take(reader.remaining());
  if (!reader.ok() || frame >= numbers_.size() || tile >= tiles_.size() ||
      encoded.size() != encoded_tile_size(std::size_t{tiles_[tile].width} * tiles_[tile].height))
    return {};
  const auto finished = [&] {
    const bool counts = schedule_.finish(from.in_schedule, frame, tile, now_s_, cpu_s);
    if (!options_.statistics.empty())
      statistics_.tiles.push_back({numbers_[frame], tile, from.number, cpu_s, now_s_, counts});
    return counts;
  };
  if (schedule_.has_frame(frame)) {
    finished();
    return {};
  }
  const auto tiles = kept(frame);
  if (!tiles) return tl::unexpected(tiles.error());
  if (auto put = (*tiles)->put(tile, encoded); !put) return put;
  if (!finished()) return {};
  ++came_;
  if (schedule_.has_frame(frame)) {
    photons_.forget(frame);
    auto queued = writer_.finish(numbers_[frame], std::move(**tiles), kept_file(frame));
    kept_.erase(frame);
    ++made_.frames;
    return queued;
  }
  if (came_ >= shown_ + 0.125 * static_cast<double>(tiles_.size())) {
    shown_ = came_;
    writer_.show_preview(kept_file(frame));
  }
  return {};
}

void Master::welcome(int number, ByteReader& reader) {
  const auto hello = read_hello(reader);
  if (worker(number)) return;
  if (!hello) {
    made_.notice = fmt::format("program {} of mpirun is another version of Septet; it is not used", number);
    send(number, message(Word::end));
    return;
  }
  workers_.push_back({number, *hello, 0, now_s_});
  if (number == own_worker) return;
  FilmTold told{options_, std::nullopt, 0, program::own_process_mark()};
  std::error_code ignored;
  told.session_bytes = fs::file_size(options_.session, ignored);
  if (!options_.shots.empty())
    if (const auto text = read_regular_file(options_.shots, longest_told_script_bytes)) told.script = *text;
  send(number, film_message(told));
}

void Master::take_in_or_out(Worker& worker) {
  const bool should_trace = worker.is_prepared && !worker.is_lost && !worker.has_given_up;
  if (std::exchange(worker.traces, should_trace) == should_trace) return;
  if (!should_trace) return schedule_.remove_worker(worker.in_schedule);
  worker.in_schedule = schedule_.add_worker(worker.hello.threads);
  if (const auto frame = schedule_.likely_first_frame(worker.in_schedule))
    send(worker.number, run_message(Word::soon, {*frame, 0, 0}));
}

/// A worker that is gone is noticed at once on this machine, and by its silence on another. A worker that sends again
/// is back.
void Master::look_who_is_there() {
  for (Worker& each : workers_) {
    if (each.number == own_worker || each.is_lost || each.has_given_up) continue;
    if (now_s_ < each.heard_s + longest_silence_s && program::is_there(each.hello.process).value_or(true)) continue;
    each.is_lost = true;
    others_->note_loss();
    take_in_or_out(each);
    made_.notice = fmt::format("program {} of mpirun is gone; the film is made without it", each.number);
  }
}

void Master::send_part(int number, ByteReader& reader) {
  const auto from = reader.get<std::uint64_t>();
  if (!session_.is_open()) session_.open(options_.session, std::ios::binary);
  session_.clear();
  session_.seekg(static_cast<std::streamoff>(from));
  std::string text(part_bytes, '\0');
  session_.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, session_.gcount())));
  Bytes bytes = message(Word::part);
  ByteWriter writer(bytes);
  writer.put(from);
  writer.put_bytes(std::as_bytes(std::span(text)));
  send(number, std::move(bytes));
}

Expected<void> Master::obey(const Mail& mail) {
  ByteReader reader(mail.bytes);
  const auto word = static_cast<Word>(reader.get<std::uint8_t>());
  Worker* from = worker(mail.from);
  if (from) {
    from->heard_s = now_s_;
    from->is_lost = false;
    from->is_prepared |= word == Word::prepared;
    from->has_given_up |= word == Word::failed;
    take_in_or_out(*from);
  }
  if (word == Word::hello) {
    welcome(mail.from, reader);
  } else if (word == Word::part_wanted) {
    send_part(mail.from, reader);
  } else if (word == Word::tile && from && from->traces) {
    return take_tile(*from, reader);
  } else if (word == Word::photons_wanted && from) {
    if (const auto question = read_photon_question(reader))
      post(photons_.ask(mail.from, *question, is_shared(question->frame)));
  } else if (word == Word::photons && from) {
    post(photons_.take(mail.from, reader));
    statistics_.photon_buckets = photons_.gathered();
  } else if (word == Word::ready && from && from->traces) {
    const auto frame = reader.get<std::uint64_t>();
    const double duration_s = reader.get_double();
    if (!reader.ok() || frame >= numbers_.size()) return {};
    from->is_ready = true;
    schedule_.was_ready_after(from->in_schedule, frame, duration_s);
  } else if (word == Word::failed) {
    const Error error = read_error(reader);
    if (mail.from == own_worker) return tl::unexpected(error);
    made_.notice = fmt::format("program {} of mpirun gives up: {}", mail.from, describe(error));
  }
  return {};
}

void Master::tell_quality() {
  const FrameWriter::Quality quality = writer_.quality();
  made_.bad_samples = quality.bad_samples;
  if (!(quality.pixels > 0.0)) return;
  made_.error = std::sqrt(quality.squared_errors / quality.pixels);
  made_.samples = quality.samples / quality.pixels;
}

void Master::deal() {
  // With emulated speeds (a benchmark) dealing waits for all workers: reading the session and preparing the first frame
  // takes programs that share a machine far longer than separate machines.
  const auto can_begin = [](const Worker& each) { return each.traces && each.is_ready; };
  if (others_ && pace_of_test() && statistics_.begun_s == 0.0 &&
      std::ranges::count_if(workers_, can_begin) < others_->count())
    return;
  for (Worker& each : workers_) {
    if (!each.traces || now_s_ < each.asks_again_s || !schedule_.is_free(each.in_schedule)) continue;
    const auto deal = schedule_.deal(each.in_schedule, now_s_);
    if (!deal) {
      // Searching for a run to split takes a while: not repeated at each tile that arrives.
      each.asks_again_s = now_s_ + ask_again_after_s;
      continue;
    }
    if (deal->shortened) {
      const auto other = std::find_if(workers_.begin(), workers_.end(), [&](const Worker& w) {
        return w.traces && w.in_schedule == deal->shortened->worker;
      });
      if (other != workers_.end()) send(other->number, run_message(Word::shorter_run, deal->shortened->run));
    }
    if (statistics_.begun_s == 0.0) statistics_.begun_s = now_s_;
    send(each.number, run_message(Word::run, deal->run));
  }
}

Expected<void> Master::run(FilmFrames& frames, const std::function<bool(const FilmMade&)>& go_on) {
  if (auto taken = take_up(); !taken) return taken;
  const unsigned threads = others_ ? program::share_of_processors() : std::max(1u, std::thread::hardware_concurrency());
  own_.send(own_worker, hello_message(threads));
  std::jthread own([&] {
    if (const auto traced = trace_for_master(own_, frames, options_, threads, {}); !traced)
      own_.send(own_worker, error_message(traced.error()));
  });
  Expected<void> result;
  const double begun_cpu_s = thread_cpu_s();
  double told_s = 0.0, asked_s = 0.0;
  while (result && !schedule_.has_all()) {
    now_s_ = program::monotonic_s();
    made_.share_of_next = schedule_.share_of_begun_frames();
    made_.workers = static_cast<std::size_t>(std::ranges::count_if(workers_, &Worker::traces));
    tell_quality();
    if (!go_on(made_)) break;
    bool came = false;
    auto mail = own_.receive_from_worker();
    if (!mail && others_) mail = others_->receive();
    if (mail) {
      came = true;
      if (mail->from != own_worker) statistics_.received_bytes += mail->bytes.size();
      result = obey(*mail);
    }
    if (came || now_s_ > asked_s + ask_again_after_s) {
      asked_s = now_s_;
      deal();
    }
    if (now_s_ > told_s + still_there_every_s) {
      told_s = now_s_;
      look_who_is_there();
      for (const Worker& each : workers_)
        if (!each.is_lost) send(each.number, message(Word::still_there));
    }
    if (!came) std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  made_.share_of_next = 0.0;
  now_s_ = program::monotonic_s();
  look_who_is_there();
  own_.send_to_worker(message(Word::end));
  own.join();
  const auto written = writer_.wait();
  tell_quality();
  if (!result) return result;
  if (!written || options_.statistics.empty()) return written;
  statistics_.master_cpu_s = thread_cpu_s() - begun_cpu_s;
  statistics_.splits = schedule_.splits();
  return write_statistics(options_.statistics, statistics_, tiles_);
}

}  // namespace

Expected<void> trace_film(const FilmOptions& options, FilmFrames& frames, const FilmFolder& folder, Machines* others,
                          FilmMade& made, const std::function<bool(const FilmMade&)>& go_on) {
  return Master(options, frames, folder, others, made).run(frames, go_on);
}

}  // namespace septet::film
