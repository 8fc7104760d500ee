#pragma once
/// Past drives below a folder, as the operator's page lists them.
///
/// The folder is untrusted: files that are no session are skipped, names are any bytes, and only the newest are read.
/// Opening a session and marking its lesson takes a moment, for a long one seconds, so a thread of its own does it, and
/// each is listed once it is read.

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

/// Sessions found so far, the newest first.
struct FoundSessions {
  std::vector<page::PastSession> sessions;
  std::vector<std::filesystem::path> folders;  ///< Folders of these sessions, in the same order.
  bool is_looking = false;                     ///< More may follow.
};

class PastSessions {
 public:
  explicit PastSessions(std::filesystem::path folder);
  /// Waits for the session being read, if there is one.
  ~PastSessions();

  /// Starts a new search soon. Unchanged files are not read again. Never waits.
  void look();
  /// True if the search has found more, or ended, since the last call.
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

  // Guards both.
  mutable std::mutex mutex_;
  std::condition_variable wanted_;
  bool is_wanted_ = false, is_over_ = false, has_news_ = false;
  FoundSessions found_;

  std::thread thread_;  ///< Last member: it starts after the rest is constructed.
};

}  // namespace septet::server
