#include "command-line/command/edit/edit_session.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include "command-line/command/edit/exported_model.hpp"
#include "engine/core/whole_file.hpp"
#include "engine/document/text_file.hpp"
#include "engine/editor/content_ahead.hpp"
#include "engine/scene/command_validation.hpp"
#include "engine/scene/edit_file.hpp"
#include "engine/world/call.hpp"

namespace septet::server {
namespace {

std::string_view first_word(std::string_view line) {
  const auto begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_first_of(" \t", begin) - begin);
}

/// True if the line would have made the thing that its second word names.
bool makes(const std::vector<scene::TextWord>& words) {
  constexpr std::array<std::string_view, 3> verbs{"create", "import", "board"};
  return words.size() > 1 && std::ranges::find(verbs, words.front().text) != verbs.end();
}

/// True if a line speaks of a thing that an earlier line failed to make: it fails for that reason alone.
bool is_about(const std::vector<scene::TextWord>& words, const std::set<std::string>& not_made) {
  return std::ranges::any_of(words, [&](const scene::TextWord& word) { return not_made.contains(word.text); });
}

/// The first reason, for what is told in one sentence.
const std::string& why_of(const replication::Refused& refused) { return refused.refusal.failures.front().why; }

/// What the server has told of commands, by the lines that they came from: of each line its first failure.
FailedLines by_line(const replication::Refusal& refusal, const std::vector<std::size_t>& line_of,
                    const std::vector<std::string>& lines) {
  FailedLines failed{{}, refusal.others};
  for (const replication::Failure& one : refusal.failures) {
    const std::size_t line = one.index < line_of.size() ? line_of[one.index] : 1;
    if (!failed.lines.empty() && failed.lines.back().line == line) continue;
    failed.lines.push_back({line, line <= lines.size() ? lines[line - 1] : "", one.node, one.why});
  }
  return failed;
}

}  // namespace

EditSession::EditSession(EditClient& client, const EditOutput& output)
    : client_(client), output_(output), names_{client.own_ids(), client.own_ids()}, before_(client.store()) {}

bool EditSession::reads_scene(std::string_view line) {
  constexpr std::array<std::string_view, 11> verbs{"find", "read",    "save",  "undo",   "wait", "remove",
                                                   "text", "picture", "color", "export", "call"};
  return std::ranges::find(verbs, first_word(line)) != verbs.end();
}

std::size_t EditSession::ahead_of_now() const {
  const auto& ticks = client_.link().history();
  const Tick next = ticks.empty() ? 0 : ticks.newest().snapshot.tick + 1;
  return static_cast<std::size_t>(
      std::ranges::count_if(waiting_, [&](const auto& entry) { return entry.second.batch.tick > next; }));
}

void EditSession::refuse(std::uint64_t request, const FailedLines& failed) {
  ++refusals_;
  output_.refused(request, failed);
}

void EditSession::refuse(std::uint64_t request, const std::string& text, const std::string& why) {
  refuse(request, {{{1, text, {}, why}}, 0});
}

void EditSession::take(const std::string& line) {
  const auto words = scene::words_of(line);
  if (words && words->empty()) return;
  if (words && words->front().text == "commit" && batch_) return send(*std::exchange(batch_, std::nullopt));
  if (words && !batch_ && query(line, *words)) return;
  Batch one;
  Batch& batch = batch_ ? *batch_ : one;
  if (words)
    add(batch, line, *words);
  else
    batch.lines.push_back(line), batch.fail({}, describe(words.error()));
  if (!batch_) send(std::move(one));
}

void EditSession::end() {
  if (!batch_) return;
  forget_created(*batch_);
  batch_.reset();
  refuse(++requests_, "begin", "the lines end without its `commit`: nothing of the batch was done");
}

void EditSession::add(Batch& batch, const std::string& line, const std::vector<scene::TextWord>& words) {
  if (batch.commands.empty() && is_settled()) names_.paints.worn.clear();
  batch.lines.push_back(line);
  const std::string thing = words.size() > 1 ? words[1].text : std::string();
  if (words.front().text == "lifetime") {
    auto lifetime = editor::lifetime_of(words, client_.store(), names_);
    if (lifetime)
      batch.lifetimes.push_back(std::move(*lifetime));
    else if (!is_about(words, batch.not_made))
      batch.fail(thing, describe(lifetime.error()));
    return;
  }
  auto edit = editor::edit_of(words, client_.store(), names_);
  if (!edit) {
    if (!is_about(words, batch.not_made)) batch.fail(thing, describe(edit.error()));
    if (makes(words)) batch.not_made.insert(thing);
    return;
  }
  batch.line_of.insert(batch.line_of.end(), edit->commands.size(), batch.lines.size());
  batch.commands.insert(batch.commands.end(), std::make_move_iterator(edit->commands.begin()),
                        std::make_move_iterator(edit->commands.end()));
  batch.messages.insert(batch.messages.end(), edit->messages.begin(), edit->messages.end());
}

void EditSession::send(Batch batch) {
  const std::uint64_t request = batch.was_asked ? ++requests_ : 0;
  if (!batch.wrong.empty()) {
    forget_created(batch);
    return refuse(request, {batch.wrong, batch.wrong_untold});
  }
  if (batch.commands.empty()) {
    const auto& ticks = client_.link().history();
    const Tick now = batch.lifetimes.empty() || ticks.empty() ? 0 : ticks.newest().snapshot.tick;
    end_lifetimes(batch, now);
    return output_.done(request, now, {});
  }
  later_.push_back({request, std::move(batch)});
  if (ahead_.empty()) send_later();
}

/// Sends what waits, in its order, up to the next batch that its contents go ahead of: what shows them is sent when the
/// server has them.
void EditSession::send_later() {
  while (!later_.empty()) {
    Batch& batch = later_.front().batch;
    editor::SplitBatch split = editor::split_content(batch.commands);
    std::string why_not;
    for (const std::vector<scene::Command>& content : split.ahead)
      if (const auto number = client_.request(content, 0))
        ahead_.insert(*number);
      else
        why_not = describe(number.error());
    if (!why_not.empty()) content_refused_ = why_not;
    if (split.ahead.empty()) {
      send_whole(std::exchange(later_.front(), {}));
      later_.pop_front();
      continue;
    }
    std::vector<std::size_t> line_of;
    for (const std::size_t from : split.rest_from)
      if (from < batch.line_of.size()) line_of.push_back(batch.line_of[from]);
    batch.line_of = std::move(line_of);
    batch.commands = std::move(split.rest);
    if (!ahead_.empty()) return;
    end_content();
  }
}

/// All contents of the first batch that waits are answered.
void EditSession::end_content() {
  const Waiting waiting = std::exchange(later_.front(), {});
  later_.pop_front();
  if (const std::string why = std::exchange(content_refused_, {}); !why.empty())
    fail(waiting, why);
  else
    send_whole(waiting);
}

void EditSession::send_whole(Waiting waiting) {
  const auto number = client_.request(waiting.batch.commands, waiting.batch.tick);
  if (!number) return fail(waiting, describe(number.error()));
  waiting_.emplace(*number, std::move(waiting));
}

void EditSession::fail(const Waiting& waiting, const std::string& why) {
  const Batch& batch = waiting.batch;
  forget_created(batch);
  if (!batch.was_asked) return output_.message(why);
  refuse(waiting.request, batch.lines.empty() ? "" : batch.lines.front(), why);
}

/// True for the answer to a batch of contents.
bool EditSession::hear_content(const EditAnswer& answer) {
  if (ahead_.erase(answer.batch) == 0) return false;
  if (answer.refused) content_refused_ = why_of(*answer.refused);
  if (!ahead_.empty()) return true;
  end_content();
  send_later();
  return true;
}

void EditSession::forget_created(const Batch& batch) {
  for (const scene::Command& command : batch.commands)
    if (const auto* create = std::get_if<scene::NodeCreate>(&command)) {
      names_.objects.erase(create->node);
      std::erase_if(names_.fresh, [&](const auto& entry) { return entry.second == create->node; });
    }
}

/// The server keeps the removals until their ticks, whether this editor is still there or not.
void EditSession::end_lifetimes(const Batch& batch, Tick from) {
  for (const editor::Lifetime& lifetime : batch.lifetimes) {
    const double ticks = std::max(1.0, std::round(lifetime.seconds * client_.link().welcome()->tick_rate_hz));
    auto removal = editor::removal_of(lifetime.node, client_.store(), names_.own_ids, batch.commands);
    const auto number = client_.request(removal, from + static_cast<Tick>(ticks));
    if (number)
      ends_.emplace(*number, End{lifetime.thing, std::move(removal)});
    else
      output_.message(fmt::format("{} stays: {}", lifetime.thing, describe(number.error())));
  }
}

void EditSession::hear() {
  for (const EditAnswer& answer : client_.take_answers()) {
    if (const auto end = ends_.extract(answer.batch)) {
      if (answer.refused)
        output_.message(fmt::format("{} stays: {}", end.mapped().thing, why_of(*answer.refused)));
      else
        editor::forget_destroyed(names_, end.mapped().removal);
      continue;
    }
    if (hear_content(answer)) continue;
    const auto found = waiting_.find(answer.batch);
    if (found == waiting_.end()) continue;
    const Waiting waiting = std::move(found->second);
    waiting_.erase(found);
    const Batch& batch = waiting.batch;
    if (!batch.was_asked) {
      output_.message(answer.refused ? fmt::format("{}: {}", batch.lines.front(), why_of(*answer.refused))
                                     : fmt::format("{}: {} changes, from tick {} on", batch.lines.front(),
                                                   batch.commands.size(), answer.tick));
      continue;
    }
    if (answer.refused) {
      forget_created(batch);
      refuse(waiting.request, by_line(answer.refused->refusal, batch.line_of, batch.lines));
      continue;
    }
    end_lifetimes(batch, answer.tick);
    std::vector<std::string> messages = batch.messages;
    std::ranges::move(constants_.news_of(batch.commands, [&](scene::NodeId id) { return called(id); }),
                      std::back_inserter(messages));
    output_.done(waiting.request, answer.tick, messages);
  }
  for (const control::OperatorAnswer& answer : client_.take_operator_answers()) {
    const auto found = operating_.find(answer.number);
    if (found == operating_.end()) continue;
    const auto [request, line] = std::move(found->second);
    operating_.erase(found);
    if (answer.why_not.empty())
      output_.done(request, answer.tick, {});
    else
      refuse(request, line, answer.why_not);
  }
  for (const std::string& message : client_.take_messages()) output_.message(message);
  if (tells_ticks_) tell_ticks();
}

/// A tick waits for its events. What happened after a tick was sent goes with the next one.
void EditSession::tell_ticks() {
  for (control::DriveEvent& event : client_.events().take_all()) untold_.push_back(std::move(event));
  for (const frame::HistoryTick& tick : client_.link().history().ticks()) {
    if (told_tick_ && tick.snapshot.tick <= *told_tick_) continue;
    if (!client_.link().has_events_of(tick)) break;
    told_tick_ = tick.snapshot.tick;
    const auto later = std::ranges::find_if(untold_, [&](const auto& event) { return event.tick > *told_tick_; });
    output_.tick(tick.snapshot, std::span(untold_.begin(), later), client_.events().take_dropped());
    untold_.erase(untold_.begin(), later);
  }
}

/// A line that changes nothing, or begins a batch.
bool EditSession::query(const std::string& line, const std::vector<scene::TextWord>& words) {
  const std::string& verb = words.front().text;
  const auto is_number = [](const std::string& text, std::uint64_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
  };
  if (verb == "begin") {
    Batch batch;
    const bool at = words.size() == 3 && words[1].text == "at" && is_number(words[2].text, batch.tick);
    if (words.size() != 1 && !at) batch.lines.push_back(line), batch.fail({}, "write `begin`, or `begin at TICK`");
    batch_ = std::move(batch);
  } else if (verb == "ticks") {
    tells_ticks_ = words.size() != 2 || words[1].text != "off";
    if (tells_ticks_) client_.hear_events();
    output_.done(++requests_, 0, {});
  } else if (verb == "wait") {
    output_.done(++requests_, 0, {});
  } else if (verb == "find") {
    const std::uint64_t request = ++requests_;
    const Snapshot at = now();
    auto found = editor::found_nodes(words, client_.store(), at);
    if (!found) {
      refuse(request, line, describe(found.error()));
      return true;
    }
    const bool has_more = found->size() > editor::most_nodes_found;
    if (has_more) found->resize(editor::most_nodes_found);
    output_.nodes(request, *found, names(), at);
    if (has_more)
      output_.message(
          fmt::format("more than {} nodes are of this kind, and the others are not told: write a longer "
                      "name, or near X Y METRES",
                      editor::most_nodes_found));
  } else if (verb == "read") {
    read(++requests_, words);
  } else if (verb == "save") {
    const std::uint64_t request = ++requests_;
    const auto saved = words.size() == 2
                           ? document::write_text_file(words[1].text, scene::edits_between(before_, client_.store()))
                           : failure("a file is needed", "save FILE", "write save FILE");
    if (saved)
      output_.done(request, 0, {});
    else
      refuse(request, line, describe(saved.error()));
  } else if (verb == "export") {
    export_model(++requests_, line, words);
  } else if (verb == "undo") {
    operate(++requests_, line, "undo");
  } else if (verb == "operate") {
    operate(line);
  } else if (verb == "call") {
    call(line, words);
  } else if (verb == "watch") {
    watch(line, words);
  } else {
    return false;
  }
  return true;
}

/// The lines that make a node; long runs of values are cut.
void EditSession::read(std::uint64_t request, const std::vector<scene::TextWord>& words) {
  constexpr std::size_t longest = 400;
  const auto id = words.size() == 2 ? scene::node_of(names(), words[1]) : std::nullopt;
  const scene::Node* node = id ? client_.store().find(*id) : nullptr;
  if (!node) return refuse(request, "read", "write read NODE, a node that exists");
  std::vector<std::string> lines;
  scene::describe_node(*node, [&](const scene::Command& command) {
    std::string text = scene::to_text(command, names());
    if (text.size() > longest) text = text.substr(0, longest) + " …";
    lines.push_back(std::move(text));
  });
  output_.lines(request, lines);
}

void EditSession::export_model(std::uint64_t request, const std::string& line,
                               const std::vector<scene::TextWord>& words) {
  const auto id = words.size() == 3 ? scene::node_of(names(), words[1]) : std::nullopt;
  const scene::Node* node = id ? client_.store().find(*id) : nullptr;
  if (!node || !std::holds_alternative<scene::ObjectData>(node->data))
    return refuse(request, line, "write export NODE FILE.glb, of an object that exists");
  auto written = exported_model(client_.store(), *id, words[1].text);
  if (written) {
    const auto saved = write_whole_file(words[2].text, "model", *written);
    if (!saved) written = tl::unexpected(saved.error());
  }
  if (!written) return refuse(request, line, describe(written.error()));
  output_.done(request, 0, {});
}

/// What stands behind the word is the server's to read.
void EditSession::operate(const std::string& line) {
  const std::uint64_t request = ++requests_;
  const auto begin = line.find_first_not_of(" \t", line.find("operate") + std::string_view("operate").size());
  const std::string text = begin == std::string::npos ? std::string() : line.substr(begin);
  if (text.empty() || text.size() > control::most_operator_line_bytes)
    return refuse(request, line.substr(0, 80), "write operate and a line of an operator's: docs/editing.md");
  operate(request, line, text);
}

void EditSession::operate(std::uint64_t request, const std::string& line, const std::string& text) {
  operating_[++operated_] = {request, line};
  client_.operate(operated_, text);
}

/// A node by any of its words: its name goes out where it has one that is its own, else its number.
void EditSession::call(const std::string& line, const std::vector<scene::TextWord>& words) {
  const std::uint64_t request = ++requests_;
  const auto wrong = [&](const std::string& why) { refuse(request, line.substr(0, 200), why); };
  const auto node = words.size() < 3 ? std::nullopt : scene::node_of(names(), words[1]);
  if (!node) return wrong("write call NODE NAME [PARAMETER=VALUE …], NODE being a node that exists, or none");
  Call call{.name = words[2].text, .node = *node == scene::no_node ? std::string() : called(*node)};
  for (const scene::TextWord& word : std::span(words).subspan(3)) {
    const auto equals = word.text.find('=');
    if (equals == std::string::npos) return wrong(word.text + " has no value: write PARAMETER=VALUE");
    call.parameters.emplace_back(word.text.substr(0, equals), word.text.substr(equals + 1));
  }
  // What a value may not hold is told by the same rule as to all who call.
  const std::string text = text_of(call);
  const auto read = read_call(text);
  if (!read) return wrong(describe(read.error()));
  if (*read != call) return wrong("name, node and by are no names of parameters");
  operate(request, line, "call " + text);
}

/// The name that means this node alone, or its number.
std::string EditSession::called(scene::NodeId id) const {
  const scene::Node* node = client_.store().find(id);
  return node && scene::node_of(names(), {node->name}) == id ? node->name : fmt::format("#{}", id);
}

void EditSession::watch(const std::string& line, const std::vector<scene::TextWord>& words) {
  Batch batch;
  batch.lines = {line};
  auto watched = watched_of(words, client_.store(), names_);
  if (!watched) {
    batch.fail(words.size() > 1 ? words[1].text : std::string(), describe(watched.error()));
    return send(std::move(batch));
  }
  auto first = watched->read();
  if (!first) {
    batch.fail(words[1].text, describe(first.error()));
    return send(std::move(batch));
  }
  batch.commands = std::move(first->commands);
  batch.messages = std::move(first->messages);
  watched_.push_back(std::move(*watched));
  send(std::move(batch));
}

void EditSession::look_at_files(double now_s) {
  for (WatchedModel& watched : watched_) {
    if (!watched.is_saved(now_s)) continue;
    auto line = watched.read();
    if (!line) {
      output_.message(describe(line.error()));
      continue;
    }
    for (const std::string& message : line->messages) output_.message(message);
    Batch batch;
    batch.lines = {watched.file().string()};
    batch.commands = std::move(line->commands);
    batch.was_asked = false;
    if (!batch.commands.empty()) send(std::move(batch));
  }
}

}  // namespace septet::server
