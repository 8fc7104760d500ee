#pragma once
/// Operators' requests, on their path from the page's thread to the drive: a bounded queue; requests beyond it are
/// refused.

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim-server/page/messages.hpp"
#include "sim-server/page/web_server.hpp"

namespace septet::page {

/// A request of the browser in command: Start, Cancel or Answer without a drive; Pause, GoOn, Rearm, End, Mark, Rate or
/// Change during one.
struct OperatorWish {
  BrowserId browser = 0;
  std::uint64_t id = 0;
  std::string name;  ///< The operator's own name; may be empty.
  Wish wish;
};

inline constexpr std::size_t most_waiting_wishes = 64;

/// Any thread.
class WishBox {
 public:
  /// Returns false if it is full.
  bool put(OperatorWish wish) {
    const std::lock_guard lock(mutex_);
    if (wishes_.size() >= most_waiting_wishes) return false;
    wishes_.push_back(std::move(wish));
    return true;
  }
  std::vector<OperatorWish> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(wishes_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<OperatorWish> wishes_;
};

/// Tells the browser that its request was done, or the reason for a refusal. Any thread.
inline void send_answer(WebServer& server, const OperatorWish& wish, const std::optional<std::string>& why_not) {
  server.post([&server, browser = wish.browser, words = shared_text(answer_text(wish.id, why_not))] {
    server.send(browser, words);
  });
}

}  // namespace septet::page
