#pragma once
/// What `septet edit` says: for people a line each, for programs one JSON object a line (docs/editing.md).

#include <cstdint>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/command_text.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::server {

class EditOutput {
 public:
  EditOutput(std::ostream& out, bool json) : out_(out), json_(json) {}

  void hello(const std::string& name, double tick_rate_hz, bool lockstep, Tick tick,
             const std::vector<std::pair<std::string, std::uint32_t>>& names) const;
  /// `request`: number of the request, from 1.
  void done(std::uint64_t request, Tick tick, const std::vector<std::string>& messages) const;
  /// `line`: of its lines, from 1, which could not be done.
  void refused(std::uint64_t request, std::size_t line, const std::string& text, const std::string& why) const;
  void nodes(std::uint64_t request, const std::vector<scene::NodeId>& found, const scene::TextNames& names) const;
  void lines(std::uint64_t request, const std::vector<std::string>& lines) const;
  void tick(const Snapshot& snapshot) const;
  void message(const std::string& text) const;
  void end(const std::string& why) const;

 private:
  std::ostream& out_;
  bool json_;
};

}  // namespace septet::server
