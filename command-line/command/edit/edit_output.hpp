#pragma once
/// What `septet edit` says: for people a line each, for programs one JSON object a line (docs/editing.md).

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/control/control_message.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::server {

/// A line of a request that could not be done.
struct FailedLine {
  std::size_t line = 0;  ///< From 1.
  std::string text;      ///< The line.
  std::string node;      ///< What it was about, by name or number; empty: no node.
  std::string why;
};

/// Why nothing of a request is done.
struct FailedLines {
  std::vector<FailedLine> lines;  ///< In their order; one at least.
  std::uint64_t others = 0;       ///< Commands that could not be done either, which the server does not tell.
};

class EditOutput {
 public:
  EditOutput(std::ostream& out, bool json) : out_(out), json_(json) {}

  void hello(const std::string& name, double tick_rate_hz, bool lockstep, Tick tick,
             const std::vector<std::pair<std::string, std::uint32_t>>& names) const;
  /// `request`: number of the request, from 1.
  void done(std::uint64_t request, Tick tick, const std::vector<std::string>& messages) const;
  void refused(std::uint64_t request, const FailedLines& failed) const;
  /// Places are those at `now`.
  void nodes(std::uint64_t request, const std::vector<scene::NodeId>& found, const scene::TextNames& names,
             const Snapshot& now) const;
  void lines(std::uint64_t request, const std::vector<std::string>& lines) const;
  /// `events`: those told since the last tick; `dropped`: those that were lost on the way.
  void tick(const Snapshot& snapshot, std::span<const control::DriveEvent> events, std::uint64_t dropped) const;
  void message(const std::string& text) const;
  void end(const std::string& why) const;

 private:
  std::ostream& out_;
  bool json_;
};

}  // namespace septet::server
