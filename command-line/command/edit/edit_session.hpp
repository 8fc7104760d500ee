#pragma once
/// Lines of an editor to batches, and the server's answers to what is said.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command-line/command/edit/edit_client.hpp"
#include "command-line/command/edit/edit_output.hpp"
#include "command-line/command/edit/watched_model.hpp"
#include "engine/editor/edit_verbs.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/constants_told.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::server {

/// A line is a request of its own, or one of those between `begin [at TICK]` and `commit`, which are one batch. Requests
/// are numbered from 1, and each has one answer.
class EditSession {
 public:
  /// Both outlive it; the client is ready.
  EditSession(EditClient& client, const EditOutput& output);

  /// True if the line reads the scene, so that everything before it must have arrived.
  static bool reads_scene(std::string_view line);
  /// True if no answer is owed and the mirror is whole.
  bool is_settled() const { return answers_owed() + ahead_of_now() == 0 && client_.is_complete(); }
  /// The same but for batches that wait for a tick which is still ahead: nothing waits for those.
  bool is_settled_for_now() const { return answers_owed() == 0 && client_.is_complete(); }
  bool is_in_batch() const { return batch_.has_value(); }
  /// Without those of batches whose tick is ahead.
  std::size_t answers_owed() const { return waiting_.size() + later_.size() + operating_.size() - ahead_of_now(); }
  /// Batches that the server has, and that wait for a tick which is still ahead.
  std::size_t ahead_of_now() const;
  void take(const std::string& line);
  /// No more lines come: a batch without its `commit` is refused.
  void end();
  /// Says what the server has answered, and the ticks that have come.
  void hear();
  /// Sends what differs in files that are watched and were saved.
  void look_at_files(double now_s);
  bool is_watching() const { return !watched_.empty(); }
  std::uint64_t refusals() const { return refusals_; }

 private:
  struct Batch {
    std::uint64_t tick = 0;
    std::vector<std::string> lines;
    std::vector<scene::Command> commands;
    std::vector<std::size_t> line_of;  ///< Of each command.
    std::vector<std::string> messages;
    std::vector<editor::Lifetime> lifetimes;
    std::vector<FailedLine> wrong;     ///< The lines that cannot be read: the first, as many as a server tells.
    std::uint64_t wrong_untold = 0;    ///< The lines that cannot be read either.
    std::set<std::string> not_made{};  ///< Things that lines of it failed to make.
    bool was_asked = true;             ///< False: of a file that was saved; its answer is a message.

    /// Its newest line cannot be read.
    void fail(const std::string& node, const std::string& why) {
      if (wrong.size() < replication::most_failures_told)
        wrong.push_back({lines.size(), lines.back(), node, why});
      else
        ++wrong_untold;
    }
  };
  struct Waiting {
    std::uint64_t request = 0;
    Batch batch;
  };

  struct End {
    std::string thing;
    std::vector<scene::Command> removal;
  };

  /// The newest tick, with everybody's place; before the first one, nobody.
  Snapshot now() const {
    const auto& ticks = client_.link().history();
    return ticks.empty() ? Snapshot{} : ticks.newest().snapshot;
  }
  scene::TextNames names() const { return {client_.store(), names_.own_ids, nullptr, &names_.fresh}; }
  void add(Batch& batch, const std::string& line, const std::vector<scene::TextWord>& words);
  void send(Batch batch);
  void send_later();
  void end_content();
  void send_whole(Waiting waiting);
  void fail(const Waiting& waiting, const std::string& why);
  bool hear_content(const EditAnswer& answer);
  void refuse(std::uint64_t request, const FailedLines& failed);
  /// A request of one line.
  void refuse(std::uint64_t request, const std::string& text, const std::string& why);
  void forget_created(const Batch& batch);
  void tell_ticks();
  void end_lifetimes(const Batch& batch, Tick from);
  bool query(const std::string& line, const std::vector<scene::TextWord>& words);
  void read(std::uint64_t request, const std::vector<scene::TextWord>& words);
  void export_model(std::uint64_t request, const std::string& line, const std::vector<scene::TextWord>& words);
  void operate(const std::string& line);
  void operate(std::uint64_t request, const std::string& line, const std::string& text);
  std::string called(scene::NodeId id) const;
  void call(const std::string& line, const std::vector<scene::TextWord>& words);
  void watch(const std::string& line, const std::vector<scene::TextWord>& words);

  EditClient& client_;
  const EditOutput& output_;
  editor::EditNames names_;
  scene::Store before_;  ///< The scene as it was when the editor came.
  std::uint64_t requests_ = 0, refusals_ = 0;
  std::optional<Batch> batch_;
  std::map<std::uint64_t, Waiting> waiting_;  ///< By the batch's number.
  std::deque<Waiting> later_;                 ///< Not sent yet: the first one's contents are, or nothing.
  std::set<std::uint64_t> ahead_;             ///< Batches of contents that are not answered yet.
  std::string content_refused_;               ///< Why one of them was refused.
  std::map<std::uint64_t, End> ends_;         ///< Removals that the server keeps for their ticks; no answer is owed.
  std::vector<WatchedModel> watched_;
  scene::ConstantsTold constants_;
  std::map<std::uint32_t, std::pair<std::uint64_t, std::string>>
      operating_;  ///< Requests and lines, by the line's number.
  std::uint32_t operated_ = 0;
  bool tells_ticks_ = false;
  std::optional<Tick> told_tick_;
  std::vector<control::DriveEvent> untold_;  ///< Events of ticks that are not told yet.
};

}  // namespace septet::server
