#pragma once
/// The operator's page of one drive: shows it in a browser, and hands over the operator's requests.
///
///     auto page = OperatorPage::open(options, facts, roads);
///     each tenth of a second: page->show(view);
///     between two ticks:      for (auto& wish : page->take_wishes()) page->answer(wish, …);
///
/// All of that is called by the drive's thread and is cheap: a view goes into a slot where the next one replaces it,
/// requests lie in a bounded queue. The rest happens in the page's own thread, for which the drive never waits. Any
/// number may look on, one commands: the first to ask for it, until it lets go, is gone, or another takes the command
/// by force. All holders of the token are trusted alike.

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-server/page/drive_view.hpp"
#include "sim-server/page/messages.hpp"
#include "sim-server/page/placing_view.hpp"
#include "sim-server/page/web_server.hpp"
#include "sim-server/page/wish_box.hpp"

namespace septet::page {

struct PageOptions {
  std::uint16_t port = 0;                                   ///< On 127.0.0.1; 0: any free one.
  std::vector<std::string> allowed_hosts;                   ///< Host names of a proxy.
  std::string token;                                        ///< Token of web_server.hpp.
  std::optional<ListeningSocket> listening = std::nullopt;  ///< Instead of the port: handed over by the parent program.
};

class OperatorPage {
 public:
  static Expected<std::unique_ptr<OperatorPage>> open(PageOptions options, DriveFacts facts,
                                                      const road::RoadNetwork& roads);
  /// Viewers get the last view, as far as it can be sent within a moment.
  ~OperatorPage();

  /// Address with the token, whose holder may command.
  const std::string& url() const { return url_; }

  void show(DriveView view);
  std::vector<OperatorWish> take_wishes();
  /// `why_not`: reason for a refusal.
  void answer(const OperatorWish& wish, const std::optional<std::string>& why_not);
  /// The answer to FindNear, and to a SaveEdits that was done.
  void answer_found(const OperatorWish& wish, const std::vector<PlacedThing>& found);
  void answer_saved(const OperatorWish& wish, const std::string& file);
  /// Screens being watched, by the names that browsers gave.
  std::set<std::string> watched() const;
  /// For the list of events on the page.
  void tell(const PageEvent& event);
  WebCounters counters() const;

 private:
  struct Shared;
  explicit OperatorPage(std::unique_ptr<Shared> shared);
  std::unique_ptr<Shared> shared_;
  std::string url_;
};

}  // namespace septet::page
