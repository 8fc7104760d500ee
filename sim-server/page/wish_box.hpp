#pragma once
/// What operators want, on its way from the page's thread to whoever runs the drive: a few wait, those beyond are refused.

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

/// Something that the one who commands wants: Start, Cancel or Answer without a drive; Pause, GoOn, Rearm, End, Mark, Rate or Change of one.
struct OperatorWish {
  BrowserId browser = 0;
  std::uint64_t id = 0;
  std::string name;  ///< Of the operator, as he calls himself; may be empty.
  Wish wish;
};

inline constexpr std::size_t most_waiting_wishes = 64;

/// Any thread.
class WishBox {
 public:
  /// False: it is full.
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

/// Tells who asked that it was done, or why not. Any thread.
inline void send_answer(WebServer& server, const OperatorWish& wish, const std::optional<std::string>& why_not) {
  server.post([&server, browser = wish.browser, words = shared_text(answer_text(wish.id, why_not))] {
    server.send(browser, words);
  });
}

}  // namespace septet::page
