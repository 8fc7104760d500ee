#pragma once
/// Products of a past drive from the page: its film, or a replay on the screens of this machine; one at a time, by a
/// `septet film` or `septet replay` of its own, which ends with this.

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "program/child_process.hpp"
#include "sim-server/page/start_page.hpp"

namespace septet::server {

class PastWork {
 public:
  /// `log` takes the program's output. Error: one is running already, or the program cannot be started.
  Expected<void> start(const page::Make& make, const std::filesystem::path& folder, const std::filesystem::path& log);
  /// Polls its progress. Returns true if it has changed since the last call.
  bool attend();
  /// Ends it in order. Returns false if none is running.
  bool stop();
  /// The newest, also after its end; empty before the first.
  const std::optional<page::PastWorkView>& view() const { return view_; }
  bool is_running() const { return process_.has_value(); }

 private:
  std::optional<program::ChildProcess> process_;
  std::filesystem::path log_;
  bool is_stopped_ = false;
  std::optional<page::PastWorkView> view_;
};

}  // namespace septet::server
