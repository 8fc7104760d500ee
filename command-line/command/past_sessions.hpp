#pragma once
/// The drives of the past below a folder, as the operator's page lists them.
///
/// Nobody trusts what lies there: a file that is no session is left out, names are any bytes, and only the newest are read. To open a session
/// and mark its lesson takes a moment, for a long one seconds, so that is done in a thread of its own, and each is listed once it is read.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "sim-server/page/drive_choice.hpp"

namespace septet::server {

inline constexpr std::size_t most_listed_sessions = 300;

/// What has been found so far, the newest first.
struct FoundSessions {
  std::vector<page::PastSession> sessions;
  std::vector<std::filesystem::path> folders;  ///< Theirs, in the same order.
  bool is_looking = false;                     ///< More may come.
};

class PastSessions {
 public:
  explicit PastSessions(std::filesystem::path folder);
  /// Waits for the session that is being read, if there is one.
  ~PastSessions();

  /// Looks again, soon. What has not changed since is not read anew. Never waits.
  void look();
  /// Whether anything has been found, or the end of looking come, since the last call.
  bool has_news();
  FoundSessions found() const;

 private:
  struct Known {
    std::filesystem::file_time_type written;
    bool is_session = false;
    page::PastSession session;
  };
  void run();
  void look_once();

  const std::filesystem::path folder_;
  // The thread's own.
  std::map<std::filesystem::path, Known> known_;  ///< By the session's file.
  std::uint64_t next_id_ = 1;

  // Of both.
  mutable std::mutex mutex_;
  std::condition_variable wanted_;
  bool is_wanted_ = false, is_over_ = false, has_news_ = false;
  FoundSessions found_;

  std::thread thread_;  ///< Last: it begins when the rest is there.
};

}  // namespace septet::server
