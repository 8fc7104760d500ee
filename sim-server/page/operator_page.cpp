#include "sim-server/page/operator_page.hpp"

#include <algorithm>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "sim-server/page/helm.hpp"
#include "sim-server/page/page_files.hpp"

namespace septet::page {
namespace {

constexpr std::size_t remembered_events = 200;  ///< For who opens the page later.

}  // namespace

struct OperatorPage::Shared {
  // Handed over between the two threads.
  std::mutex mutex;
  std::optional<DriveView> newest;  ///< The slot.
  bool is_due = false;              ///< The page's thread has been told of it.
  WishBox wishes;

  // The page's thread's own.
  DriveFacts facts;
  RoadMap map;
  Helm helm;
  std::uint64_t states = 0;
  DriveView shown;
  std::deque<Text> events;

  std::unique_ptr<WebServer> server;  ///< Last: its thread is gone before the rest.

  void opened(BrowserId browser) {
    helm.opened(browser);
    server->send(browser, shared_text(hello_text(facts, map, browser)));
    for (const Text& event : events) server->send(browser, event);
    send_state();
    for (const ScreenView& screen : shown.screens)
      if (screen.thumbnail)
        server->send_newest_picture(browser, screen.name, shared_text(thumbnail_text(screen.name, *screen.thumbnail)));
  }
  void closed(BrowserId browser) {
    helm.closed(browser);
    send_state();
  }
  void said(BrowserId browser, std::string_view words) {
    auto message = read_browser_message(words);
    if (!message) return server->send(browser, shared_text(answer_text(0, message.error().what)));
    const auto answer = [&](const std::optional<std::string>& why_not) {
      server->send(browser, shared_text(answer_text(message->id, why_not)));
    };
    if (const auto reply = helm.judge(browser, message->wish)) {
      answer(reply->why_not);
      return reply->why_not ? void() : send_state();
    }
    // The drive answers.
    if (!wishes.put({browser, message->id, helm.commander()->name, std::move(message->wish)}))
      answer("the drive has not yet done what was asked before");
  }

  void take_view() {
    std::optional<DriveView> taken;
    {
      const std::lock_guard lock(mutex);
      is_due = false;
      taken.swap(newest);
    }
    const DriveView before = std::exchange(shown, taken ? std::move(*taken) : shown);
    send_state();
    for (const ScreenView& screen : shown.screens) {
      const auto same = std::ranges::find(before.screens, screen.name, &ScreenView::name);
      if (!screen.thumbnail || (same != before.screens.end() && same->thumbnail == screen.thumbnail)) continue;
      const Text picture = shared_text(thumbnail_text(screen.name, *screen.thumbnail));
      for (const BrowserId browser : std::set(helm.browsers()))
        server->send_newest_picture(browser, screen.name, picture);
    }
  }
  void send_state() {
    if (helm.browsers().empty()) return;
    const Text state = shared_text(state_text(shown, facts, ++states, helm.commander(), helm.browsers().size()));
    for (const BrowserId browser : std::set(helm.browsers())) server->send_newest(browser, state);
  }
};

Expected<std::unique_ptr<OperatorPage>> OperatorPage::open(PageOptions options, DriveFacts facts,
                                                           const road::RoadNetwork& roads) {
  auto shared = std::make_unique<Shared>();
  shared->facts = std::move(facts);
  shared->map = road_map(roads);
  WebServerOptions web{.port = options.port,
                       .allowed_hosts = std::move(options.allowed_hosts),
                       .token = options.token,
                       .resources = page_files(),
                       .listening = options.listening ? &*options.listening : nullptr};
  Shared* const here = shared.get();
  // Nothing that needs the server may be done before it is kept: until then its thread waits here.
  std::unique_lock starting(shared->mutex);
  const auto once_kept = [here] { const std::lock_guard kept(here->mutex); };
  auto server = WebServer::start(std::move(web),
                                 {[here, once_kept](BrowserId browser) {
                                    once_kept();
                                    here->opened(browser);
                                  },
                                  [here](BrowserId browser, std::string_view words) { here->said(browser, words); },
                                  [here](BrowserId browser) { here->closed(browser); }});
  if (!server) return tl::unexpected(server.error());
  shared->server = std::move(*server);
  starting.unlock();
  auto page = std::unique_ptr<OperatorPage>(new OperatorPage(std::move(shared)));
  page->url_ = fmt::format("http://127.0.0.1:{}/#{}", here->server->port(), options.token);
  return page;
}

OperatorPage::OperatorPage(std::unique_ptr<Shared> shared) : shared_(std::move(shared)) {}
OperatorPage::~OperatorPage() { shared_->server->flush(0.5); }

void OperatorPage::show(DriveView view) {
  std::optional<DriveView> before;  // Its end is nothing to wait for with a lock in hand.
  {
    const std::lock_guard lock(shared_->mutex);
    before.swap(shared_->newest);
    shared_->newest.emplace(std::move(view));
    if (std::exchange(shared_->is_due, true)) return;
  }
  shared_->server->post([shared = shared_.get()] { shared->take_view(); });
}

std::vector<OperatorWish> OperatorPage::take_wishes() { return shared_->wishes.take(); }

void OperatorPage::answer(const OperatorWish& wish, const std::optional<std::string>& why_not) {
  send_answer(*shared_->server, wish, why_not);
}

void OperatorPage::tell(double simulated_s, const std::string& words) {
  shared_->server->post([shared = shared_.get(), event = shared_text(event_text(simulated_s, words))] {
    shared->events.push_back(event);
    if (shared->events.size() > remembered_events) shared->events.pop_front();
    for (const BrowserId browser : std::set(shared->helm.browsers())) shared->server->send(browser, event);
  });
}

WebCounters OperatorPage::counters() const { return shared_->server->counters(); }

}  // namespace septet::page
