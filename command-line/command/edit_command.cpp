#include "command-line/command/edit_command.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <deque>
#include <iostream>
#include <optional>
#include <utility>

#include "command-line/command/edit/edit_session.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/scene/participant_root.hpp"
#include "logging/session/drive_end.hpp"
#include "program/clock.hpp"
#include "program/stop_signal.hpp"

namespace septet::server {
namespace {

constexpr std::size_t longest_line_bytes = 32u << 20, most_answers_owed = 200;
constexpr double connects_within_s = 30.0;

/// Lines of the files, or of standard input as they come.
class Lines {
 public:
  static Expected<Lines> open(const std::vector<std::filesystem::path>& files) {
    Lines lines;
    lines.from_input_ = files.empty();
    for (const auto& file : files) {
      const auto text = read_regular_file(file);
      if (!text) return tl::unexpected(text.error());
      lines.split(*text + '\n');
    }
    return lines;
  }
  /// Takes what has come. Error: a line without end.
  Expected<void> pump() {
    if (!from_input_ || lines_.size() > 1000) return {};
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, 0) <= 0) return {};
    char bytes[65536];
    const ssize_t size = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (size < 0 && errno == EINTR) return {};
    if (size <= 0)
      split("\n"), from_input_ = false;
    else
      split({bytes, static_cast<std::size_t>(size)});
    if (rest_.size() > longest_line_bytes)
      return failure("a line is longer than 32 MiB", "standard input", "break it into several commands");
    return {};
  }
  bool empty() const { return lines_.empty(); }
  bool ended() const { return lines_.empty() && !from_input_; }
  const std::string& front() const { return lines_.front(); }
  std::string take() {
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    return line;
  }

 private:
  void split(std::string_view text) {
    for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1)) {
      rest_ += text.substr(0, end);
      lines_.push_back(std::exchange(rest_, {}));
    }
    rest_ += text;
  }
  std::deque<std::string> lines_;
  std::string rest_;
  bool from_input_ = false;
};

Expected<std::unique_ptr<EditClient>> connected(const EditOptions& options, const editor::EditPlace& place,
                                                const EditOutput& output) {
  auto client = EditClient::open(place);
  if (!client) return client;
  const double until_s = program::monotonic_s() + connects_within_s;
  while (!(*client)->is_ready()) {
    (*client)->pump();
    for (const std::string& message : (*client)->take_messages()) output.message(message);
    if (const auto& refusal = (*client)->link().refusal()) return tl::unexpected(*refusal);
    if ((*client)->link().finished())
      return failure("the drive has ended", net::to_text(place.server), "start another one");
    if (program::should_stop() || program::monotonic_s() > until_s)
      return failure("the server does not let this editor in", net::to_text(place.server),
                     options.server.empty()
                         ? "check that the drive runs, that its list names this key, and that no other script holds it"
                         : "check --server, and that the server's list names this key");
    (*client)->wait(0.02);
  }
  return client;
}

/// A server that is busy for a moment has not gone, and a script that ended would not come back.
constexpr double longest_absence_s = 5.0;

}  // namespace

Expected<int> run_edit(const EditOptions& options) {
  const EditOutput output(std::cout, options.json);
  auto lines = Lines::open(options.files);
  if (!lines) return tl::unexpected(lines.error());
  const auto place = editor::find_edit_place(options.keys, options.key, options.server);
  if (!place) return tl::unexpected(place.error());
  program::catch_stop_signals();
  const auto client = connected(options, *place, output);
  if (!client) return tl::unexpected(client.error());
  const screen::ScreenLink& link = (*client)->link();
  EditSession session(**client, output);
  output.hello(place->name, link.welcome()->tick_rate_hz, link.welcome()->lockstep,
               link.history().empty() ? 0 : link.history().newest().snapshot.tick,
               scene::participant_names((*client)->store()));
  std::string end = "all lines are done";
  double heard_s = program::monotonic_s();
  for (;;) {
    (*client)->pump();
    session.hear();
    session.look_at_files(program::monotonic_s());
    if (auto read = lines->pump(); !read) return tl::unexpected(read.error());
    const auto may_take = [&](const std::string& line) {
      return session.is_settled_for_now() ||
             ((options.json || session.is_in_batch()) && !EditSession::reads_scene(line) &&
              session.answers_owed() < most_answers_owed);
    };
    while (!lines->empty() && may_take(lines->front())) session.take(lines->take());
    if (lines->ended()) session.end();
    if (lines->ended() && session.is_settled() && !session.is_watching()) break;
    if (!link.server_is_gone()) heard_s = program::monotonic_s();
    const bool is_gone = program::monotonic_s() - heard_s > longest_absence_s;
    if (link.finished() || is_gone || link.refusal() || program::should_stop()) {
      end = link.finished() ? "the drive has ended" : program::should_stop() ? "stopped" : "the server is gone";
      break;
    }
    (*client)->wait(lines->empty() ? 0.004 : 0.001);
  }
  output.end(end);
  (*client)->close();
  return session.refusals() == 0 && session.answers_owed() + session.ahead_of_now() == 0 ? logging::finished_status
                                                                                         : logging::failed_status;
}

}  // namespace septet::server
