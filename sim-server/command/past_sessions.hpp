#pragma once
/// The drives of the past below a folder, as the operator's page lists them.
///
/// Nobody trusts what lies there: a file that is no session is left out, names are any bytes, and only the newest are read.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim-server/page/drive_choice.hpp"

namespace septet::server {

inline constexpr std::size_t most_listed_sessions = 200;

class PastSessions {
 public:
  explicit PastSessions(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Looks again. What has not changed since is not read anew.
  void look();
  /// The newest first.
  const std::vector<page::PastSession>& sessions() const { return sessions_; }
  /// Their folders, in the same order.
  const std::vector<std::filesystem::path>& folders() const { return folders_; }

 private:
  struct Known {
    std::filesystem::file_time_type written;
    bool is_session = false;
    page::PastSession session;
  };
  std::filesystem::path folder_;
  std::map<std::filesystem::path, Known> known_;  ///< By the session's file.
  std::uint64_t next_id_ = 1;
  std::vector<page::PastSession> sessions_;
  std::vector<std::filesystem::path> folders_;
};

}  // namespace septet::server
