#pragma once
/// What is made of a past drive from the page: its film, or a replay on the screens of this machine; one at a time, by a `septet film` or
/// `septet replay` of its own, which ends with this.

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "program/child_process.hpp"
#include "sim-server/page/start_page.hpp"

namespace septet::server {

class PastWork {
 public:
  /// `log` takes what the program says. Error: something is being made already, or the program cannot be started.
  Expected<void> start(const page::Make& make, const std::filesystem::path& folder, const std::filesystem::path& log);
  /// Looks how far it is. Whether that has changed since the last call.
  bool attend();
  /// Ends it in order. False: nothing is being made.
  bool stop();
  /// The newest, also when it is over; nothing before the first.
  const std::optional<page::PastWorkView>& view() const { return view_; }
  bool is_running() const { return process_.has_value(); }

 private:
  std::optional<program::ChildProcess> process_;
  std::filesystem::path log_;
  bool is_stopped_ = false;
  std::optional<page::PastWorkView> view_;
};

}  // namespace septet::server
