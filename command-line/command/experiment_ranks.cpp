#include "command-line/command/experiment_ranks.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "engine/core/bytes.hpp"
#include "engine/core/version.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"
#include "program/temporary_folder.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using program::Machines, program::Mail;

namespace {

enum class Word : std::uint8_t {
  hello,        ///< Driver: which Septet it is, how many drives at once, its process.
  drive,        ///< First: number, arguments.
  part,         ///< Driver: number, name of a file of the drive, bytes that follow those before.
  ended,        ///< Driver: number, exit status, signal, its log.
  still_there,  ///< Both: a sign of life. From the first: its process.
  end,          ///< First: no more is to be done; 1 where some are lost.
};

constexpr double still_there_every_s = 1.0, longest_silence_s = 60.0;
constexpr std::size_t part_bytes = 1 << 20, most_arguments = 4096, longest_text = 1 << 16, longest_log = 1 << 20;
constexpr std::size_t most_jobs = 1024;

Bytes message(Word word) { return {static_cast<std::byte>(word)}; }

fs::path coming(const fs::path& folder) { return folder.string() + ".coming"; }

/// True for a file name below a folder, and for nothing outside it.
bool is_below(const fs::path& name) {
  return !name.empty() && name.is_relative() &&
         std::ranges::none_of(name, [](const fs::path& part) { return part == ".." || part == "."; });
}

tl::unexpected<Error> full(const fs::path& place) {
  return failure("a drive from another machine cannot be written", place.string(),
                 "free some space and give the command again: finished drives are kept");
}

}  // namespace

void clear_half_drive(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(coming(folder), ignored);
}

ExperimentRanks::~ExperimentRanks() {
  for (int rank = 1; rank < machines_.count(); ++rank) {
    Bytes end = message(Word::end);
    ByteWriter(end).put(static_cast<std::uint8_t>(machines_.has_losses()));
    machines_.send(rank, std::move(end));
  }
  for (const auto& [number, drive] : drives_) clear_half_drive(drive.folder);
}

bool ExperimentRanks::has_room(int rank) const {
  const auto driving = std::ranges::count_if(drives_, [&](const auto& drive) { return drive.second.rank == rank; });
  return static_cast<std::size_t>(driving) < ranks_.at(rank).jobs;
}

bool ExperimentRanks::has_room() const {
  return std::ranges::any_of(ranks_, [&](const auto& rank) { return has_room(rank.first); });
}

std::vector<std::string> ExperimentRanks::take_messages() { return std::exchange(messages_, {}); }

std::optional<std::uint64_t> ExperimentRanks::deal(const std::vector<std::string>& arguments, const fs::path& folder) {
  const auto free = std::ranges::find_if(ranks_, [&](const auto& rank) { return has_room(rank.first); });
  if (free == ranks_.end()) return std::nullopt;
  const std::uint64_t number = next_drive_++;
  Bytes bytes = message(Word::drive);
  ByteWriter writer(bytes);
  writer.put(number);
  writer.put_varint(arguments.size());
  for (const auto& argument : arguments) writer.put_string(argument);
  machines_.send(free->first, std::move(bytes));
  drives_[number] = {free->first, folder};
  return number;
}

void ExperimentRanks::lose(int rank, const std::string& why, std::vector<Ended>& ended) {
  if (ranks_.erase(rank) == 0) return;
  machines_.note_loss();
  messages_.push_back(fmt::format("septet: program {} {}; its drives are repeated", rank, why));
  std::erase_if(drives_, [&](const auto& drive) {
    if (drive.second.rank != rank) return false;
    clear_half_drive(drive.second.folder);
    ended.push_back({drive.first, {}, true});
    return true;
  });
}

Expected<void> ExperimentRanks::obey(const Mail& mail, std::vector<Ended>& ended) {
  const double now_s = program::monotonic_s();
  ByteReader reader(mail.bytes);
  const auto word = static_cast<Word>(reader.get<std::uint8_t>());
  if (word == Word::hello) {
    const bool is_same = reader.get_string(longest_text) == version_text();
    Rank rank{.jobs = std::min<std::size_t>(reader.get<std::uint32_t>(), most_jobs), .process = {}, .heard_s = now_s};
    rank.process = program::get_process(reader);
    if (reader.ok() && is_same && rank.jobs > 0)
      ranks_[mail.from] = rank;
    else
      messages_.push_back(fmt::format("septet: program {} is another version of Septet and drives nothing", mail.from));
    return {};
  }
  const auto rank = ranks_.find(mail.from);
  if (rank == ranks_.end()) return {};  // It was given up.
  rank->second.heard_s = now_s;
  if (word != Word::part && word != Word::ended) return {};
  const auto drive = drives_.find(reader.get<std::uint64_t>());
  if (drive == drives_.end() || drive->second.rank != mail.from) return {};
  const fs::path& folder = drive->second.folder;
  std::error_code error;
  if (word == Word::part) {
    const fs::path name = reader.get_string(longest_text);
    const auto bytes = reader.take(reader.remaining());
    if (!reader.ok() || !is_below(name)) return {};
    const fs::path file = coming(folder) / name;
    fs::create_directories(file.parent_path(), error);
    std::ofstream out(file, std::ios::binary | std::ios::app);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush()) return full(file);
    return {};
  }
  Ended end{.drive = drive->first, .exit = {}, .is_lost = false};
  end.exit.code = reader.get<std::int32_t>();
  end.exit.signal = reader.get<std::int32_t>();
  const std::string log = reader.get_string(longest_log);
  std::ofstream(folder.string() + ".log", std::ios::binary) << log;
  fs::create_directories(coming(folder), error);
  fs::remove_all(folder, error);
  fs::rename(coming(folder), folder, error);
  if (error) return full(folder);
  drives_.erase(drive);
  ended.push_back(end);
  return {};
}

Expected<std::vector<ExperimentRanks::Ended>> ExperimentRanks::take_ended() {
  std::vector<Ended> ended;
  while (const auto mail = machines_.receive())
    if (auto obeyed = obey(*mail, ended); !obeyed) return tl::unexpected(obeyed.error());
  const double now_s = program::monotonic_s();
  if (now_s - told_s_ < still_there_every_s) return ended;
  told_s_ = now_s;
  Bytes bytes = message(Word::still_there);
  ByteWriter writer(bytes);
  program::put_process(writer, program::own_process_mark());
  for (int rank = 1; rank < machines_.count(); ++rank) machines_.send(rank, bytes);
  std::vector<std::pair<int, std::string>> lost;
  for (const auto& [number, rank] : ranks_) {
    if (program::is_there(rank.process) == std::optional(false))
      lost.emplace_back(number, "has ended");
    else if (now_s - rank.heard_s > longest_silence_s)
      lost.emplace_back(number, fmt::format("has been silent for {:.0f} s", now_s - rank.heard_s));
  }
  for (const auto& [number, why] : lost) lose(number, why, ended);
  return ended;
}

namespace {

/// One of the programs after the first.
class ExperimentDriver {
 public:
  ExperimentDriver(Machines& machines, std::size_t jobs) : machines_(machines), jobs_(jobs) {}

  Expected<void> run() {
    auto folder = program::TemporaryFolder::make("septet-experiment");
    if (!folder) return tl::unexpected(folder.error());
    folder_ = folder->path();
    Bytes hello = message(Word::hello);
    ByteWriter writer(hello);
    writer.put_string(version_text());
    writer.put(static_cast<std::uint32_t>(jobs_));
    program::put_process(writer, program::own_process_mark());
    machines_.send(0, std::move(hello));
    heard_s_ = program::monotonic_s();
    while (!is_over_ && !program::should_stop()) {
      while (const auto mail = machines_.receive()) obey(*mail);
      take_ended();
      const double now_s = program::monotonic_s();
      if (now_s - told_s_ > still_there_every_s) {
        // On this machine its end is noticed directly, elsewhere by its silence.
        if (now_s - heard_s_ > longest_silence_s || (first_ && program::is_there(*first_) == std::optional(false))) {
          machines_.note_loss();
          return failure("the experiment's first program is gone", "mpirun",
                         "give the command again: finished drives are kept");
        }
        told_s_ = now_s;
        machines_.send(0, message(Word::still_there));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return {};
  }

 private:
  struct Going {
    std::uint64_t number = 0;
    fs::path folder, log;
    program::ChildProcess process;
  };

  void obey(const Mail& mail) {
    if (mail.from != 0) return;
    heard_s_ = program::monotonic_s();
    ByteReader reader(mail.bytes);
    const auto word = static_cast<Word>(reader.get<std::uint8_t>());
    if (word == Word::still_there) {
      program::ProcessMark first = program::get_process(reader);
      if (reader.ok()) first_ = std::move(first);
    }
    if (word == Word::end) {
      is_over_ = true;
      if (reader.get<std::uint8_t>() != 0) machines_.note_loss();
    }
    if (word != Word::drive) return;
    const auto number = reader.get<std::uint64_t>();
    std::vector<std::string> arguments{"drive", "--no-screens"};
    for (std::size_t left = reader.get_count(most_arguments); left > 0; --left)
      arguments.push_back(reader.get_string(longest_text));
    const fs::path folder = folder_ / std::to_string(number), log = folder.string() + ".log";
    const auto out = std::ranges::find(arguments, "--out");
    if (!reader.ok() || out == arguments.end() || std::next(out) == arguments.end()) return;
    *std::next(out) = folder.string();
    auto process =
        program::ChildProcess::start({(program::own_folder() / "septet").string(), std::move(arguments), {}, log});
    if (process)
      going_.push_back({number, folder, log, std::move(*process)});
    else
      send_end(number, {.code = program::failed_status}, describe(process.error()));
  }

  void take_ended() {
    for (auto it = going_.begin(); it != going_.end();) {
      while (it->process.read_line(std::chrono::milliseconds(0))) {
      }
      const auto exit = it->process.poll();
      if (!exit) {
        ++it;
        continue;
      }
      std::error_code ignored;
      fs::remove_all(it->folder / "screens", ignored);
      for (const auto& entry : fs::recursive_directory_iterator(it->folder, ignored))
        if (entry.is_regular_file(ignored)) send_file(it->number, entry.path(), it->folder);
      std::ifstream in(it->log, std::ios::binary);
      std::string log{std::istreambuf_iterator<char>(in), {}};
      if (log.size() > longest_log / 2) log.erase(0, log.size() - longest_log / 2);
      send_end(it->number, *exit, log);
      fs::remove_all(it->folder, ignored);
      fs::remove(it->log, ignored);
      it = going_.erase(it);
    }
  }

  void send_file(std::uint64_t number, const fs::path& file, const fs::path& below) {
    std::ifstream in(file, std::ios::binary);
    std::vector<char> buffer(part_bytes);
    do {
      in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
      Bytes bytes = message(Word::part);
      ByteWriter writer(bytes);
      writer.put(number);
      writer.put_string(file.lexically_relative(below).string());
      writer.put_bytes(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(in.gcount()))));
      machines_.send(0, std::move(bytes));
    } while (in);
  }

  void send_end(std::uint64_t number, const program::ChildExit& exit, const std::string& log) {
    Bytes bytes = message(Word::ended);
    ByteWriter writer(bytes);
    writer.put(number);
    writer.put(static_cast<std::int32_t>(exit.code));
    writer.put(static_cast<std::int32_t>(exit.signal));
    writer.put_string(log);
    machines_.send(0, std::move(bytes));
  }

  Machines& machines_;
  std::size_t jobs_;
  fs::path folder_;
  std::vector<Going> going_;
  std::optional<program::ProcessMark> first_;
  double heard_s_ = 0.0, told_s_ = 0.0;
  bool is_over_ = false;
};

}  // namespace

int drive_for_experiment(Machines& machines, std::size_t jobs) {
  program::catch_stop_signals();
  const std::size_t share = program::share_of_processors();
  const auto done = ExperimentDriver(machines, jobs > 0 ? jobs : share).run();
  if (done) return 0;
  if (machines.own_number() == 1) program::say("septet: " + describe(done.error()));  // One message is enough.
  return program::failed_status;
}

}  // namespace septet::server
