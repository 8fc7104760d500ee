#pragma once
/// Notices changes of the list of allowed clients, so that removing a key disconnects its client at once.
///
/// Checks the file's inode, size and time of change four times a second, and reads it once two successive checks agree:
/// an editor that writes it piece by piece disconnects no client. Time only as an argument. One thread.

#include <ctime>
#include <filesystem>
#include <optional>
#include <vector>

#include <sys/types.h>

#include "engine/net/keys.hpp"

namespace septet::net {

class AllowedClientsWatch {
 public:
  /// Takes the file as it stands now for the known list.
  explicit AllowedClientsWatch(std::filesystem::path file);

  /// The new list, or the reason why it cannot be read: then the known one still holds. Empty where nothing has
  /// changed.
  std::optional<Expected<std::vector<AllowedClient>>> changed(double now_s);

 private:
  struct Stamp {
    bool exists = false;
    dev_t device = 0;
    ino_t inode = 0;
    off_t bytes = 0;
    std::time_t changed_s = 0;
    long changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  Stamp look() const;

  std::filesystem::path file_;
  Stamp known_, seen_;
  double next_look_s_ = 0.0;
};

}  // namespace septet::net
