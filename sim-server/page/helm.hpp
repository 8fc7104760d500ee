#pragma once
/// Viewers of a page and the one in command: the first to ask for it, until it lets go, is gone, or another takes the
/// command by force.

#include <optional>
#include <set>
#include <string>
#include <variant>

#include "sim-server/page/messages.hpp"
#include "sim-server/page/web_server.hpp"

namespace septet::page {

class Helm {
 public:
  /// Immediate reply: nothing to do, or done.
  struct Reply {
    std::optional<std::string> why_not;
  };

  void opened(BrowserId browser) { browsers_.insert(browser); }
  void closed(BrowserId browser) {
    browsers_.erase(browser);
    if (commands(browser)) commander_.reset();
  }
  bool commands(BrowserId browser) const { return commander_ && commander_->browser == browser; }
  const std::optional<Commander>& commander() const { return commander_; }
  const std::set<BrowserId>& browsers() const { return browsers_; }

  /// Empty if the message is for the drive.
  std::optional<Reply> judge(BrowserId browser, const Wish& wish) {
    if (const auto* take = std::get_if<Take>(&wish)) {
      if (commander_ && !commands(browser) && !take->by_force) return Reply{"somebody else commands"};
      commander_ = Commander{browser, take->name};
      return Reply{};
    }
    if (!commands(browser)) return Reply{"only who commands may do that: take the command first"};
    if (!std::holds_alternative<Release>(wish)) return std::nullopt;
    commander_.reset();
    return Reply{};
  }

 private:
  std::set<BrowserId> browsers_;
  std::optional<Commander> commander_;
};

}  // namespace septet::page
