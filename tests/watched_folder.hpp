#pragma once
// Records changes to the files of a folder: by inotify while it is watched, and by listing, sizes, times and bytes
// before and after. Reading alone is no change.

#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace septet {

class WatchedFolder {
 public:
  explicit WatchedFolder(std::filesystem::path folder)
      : folder_(std::move(folder)), inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)), before_(listing()) {
    ::inotify_add_watch(inotify_, folder_.c_str(), IN_MODIFY | IN_CREATE | IN_DELETE | IN_MOVE | IN_ATTRIB);
  }
  WatchedFolder(const WatchedFolder&) = delete;
  WatchedFolder& operator=(const WatchedFolder&) = delete;
  ~WatchedFolder() { ::close(inotify_); }

  /// One line per change since construction, empty if there is none.
  std::string changes() const {
    std::string text;
    alignas(inotify_event) std::array<char, 65536> buffer{};
    for (ssize_t bytes; (bytes = ::read(inotify_, buffer.data(), buffer.size())) > 0;)
      for (const char* at = buffer.data(); at < buffer.data() + bytes;) {
        const auto* event = reinterpret_cast<const inotify_event*>(at);
        const std::string name = event->len > 0 ? event->name : "the folder";
        // As root, SQLite gives a WAL and its index their owner when it opens them.
        const bool is_owner =
            event->mask == IN_ATTRIB && (name.ends_with("-wal") || name.ends_with("-shm")) && ::geteuid() == 0;
        if (!is_owner) text += name + ": event " + std::to_string(event->mask) + "\n";
        at += sizeof(inotify_event) + event->len;
      }
    const auto after = listing();
    for (const auto& [name, state] : before_)
      if (!after.contains(name))
        text += name + ": gone\n";
      else if (after.at(name) != state)
        text += name + ": changed\n";
    for (const auto& [name, state] : after)
      if (!before_.contains(name)) text += name + ": new\n";
    return text;
  }

 private:
  std::map<std::string, std::string> listing() const {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      struct stat state {};
      ::lstat(entry.path().c_str(), &state);
      std::string text = std::to_string(state.st_ino) + " " + std::to_string(state.st_size) + " " +
                         std::to_string(state.st_mtim.tv_sec) + "." + std::to_string(state.st_mtim.tv_nsec) + " ";
      if (S_ISREG(state.st_mode)) {
        std::ifstream in(entry.path(), std::ios::binary);
        text.append(std::istreambuf_iterator<char>(in), {});
      }
      found[entry.path().filename().string()] = text;
    }
    return found;
  }

  std::filesystem::path folder_;
  int inotify_;
  std::map<std::string, std::string> before_;
};

}  // namespace septet
