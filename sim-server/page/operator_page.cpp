#include "sim-server/page/operator_page.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "sim-server/page/helm.hpp"
#include "sim-server/page/page_files.hpp"
#include "sim-server/page/placing_messages.hpp"

namespace septet::page {
namespace {

constexpr std::size_t remembered_events = 200;  ///< For browsers that open the page later.

}  // namespace

struct OperatorPage::Shared {
  // Handed over between the two threads.
  std::mutex mutex;
  std::optional<DriveView> newest;  ///< The slot.
  bool is_due = false;              ///< The page's thread has been notified.
  WishBox wishes;
  std::map<BrowserId, std::string> watching;  ///< The screen that each browser sees large.

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
    server->send(browser, shared_text(placing_facts_text(facts.placing)));
    for (const Text& event : events) server->send(browser, event);
    send_state();
    if (shown.placed) server->send_newest_picture(browser, "placed", shared_text(placed_text(*shown.placed)));
    for (const ScreenView& screen : shown.screens)
      if (screen.thumbnail)
        server->send_newest_picture(browser, screen.name, shared_text(thumbnail_text(screen.name, *screen.thumbnail)));
    if (shown.lesson) send_lesson(browser, nullptr);
  }
  void watch(BrowserId browser, const std::string& screen) {
    const std::lock_guard lock(mutex);
    if (screen.empty())
      watching.erase(browser);
    else
      watching[browser] = screen;
  }
  std::map<BrowserId, std::string> watchers() {
    const std::lock_guard lock(mutex);
    return watching;
  }
  void closed(BrowserId browser) {
    watch(browser, "");
    helm.closed(browser);
    send_state();
  }
  void said(BrowserId browser, std::string_view words) {
    auto message = read_browser_message(words);
    if (!message) return server->send(browser, shared_text(refusal_text(words, message.error())));
    const auto answer = [&](const std::optional<std::string>& why_not) {
      server->send(browser, shared_text(answer_text(message->id, why_not)));
    };
    if (const auto* wished = std::get_if<Watch>(&message->wish)) {
      watch(browser, wished->screen);
      return answer(std::nullopt);
    }
    if (const auto reply = helm.judge(browser, message->wish)) {
      answer(reply->why_not);
      return reply->why_not ? void() : send_state();
    }
    // The drive replies.
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
    if (shown.lesson && shown.lesson != before.lesson)
      for (const BrowserId browser : std::set(helm.browsers())) send_lesson(browser, before.lesson.get());
    if (shown.placed && shown.placed != before.placed) {
      const Text placed = shared_text(placed_text(*shown.placed));
      for (const BrowserId browser : std::set(helm.browsers())) server->send_newest_picture(browser, "placed", placed);
    }
    const auto large = watchers();
    for (const ScreenView& screen : shown.screens) {
      const auto last = std::ranges::find(before.screens, screen.name, &ScreenView::name);
      if (!screen.large_picture || (last != before.screens.end() && last->large_picture == screen.large_picture))
        continue;
      const Text picture = shared_text(large_picture_text(screen.name, *screen.large_picture));
      for (const auto& [browser, name] : large)
        if (name == screen.name) server->send_newest_picture(browser, "large " + name, picture);
    }
    for (const ScreenView& screen : shown.screens) {
      const auto same = std::ranges::find(before.screens, screen.name, &ScreenView::name);
      if (!screen.thumbnail || (same != before.screens.end() && same->thumbnail == screen.thumbnail)) continue;
      const Text picture = shared_text(thumbnail_text(screen.name, *screen.thumbnail));
      for (const BrowserId browser : std::set(helm.browsers()))
        server->send_newest_picture(browser, screen.name, picture);
    }
  }
  /// Each still once: those that `before` has were sent with it. A browser that is slow is sent the newest lesson
  /// alone.
  void send_lesson(BrowserId browser, const LessonView* before) {
    server->send_newest_picture(browser, "lesson", shared_text(lesson_text(*shown.lesson)));
    for (const LessonFaultView& fault : shown.lesson->faults) {
      const auto is_same = [&](const LessonFaultView& other) { return other.number == fault.number && other.still; };
      if (!fault.still || (before && std::ranges::any_of(before->faults, is_same))) continue;
      server->send_newest_picture(browser, fmt::format("still {}", fault.number),
                                  shared_text(still_text(fault.number, *fault.still)));
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
  // Handlers that need the server wait here until it is stored.
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
  std::optional<DriveView> before;  // Destroyed outside the lock.
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

void OperatorPage::answer_found(const OperatorWish& wish, const std::vector<PlacedThing>& found) {
  shared_->server->post([server = shared_->server.get(), browser = wish.browser,
                         words = shared_text(found_text(wish.id, found))] { server->send(browser, words); });
}

void OperatorPage::answer_saved(const OperatorWish& wish, const std::string& file) {
  shared_->server->post([server = shared_->server.get(), browser = wish.browser,
                         words = shared_text(saved_text(wish.id, file))] { server->send(browser, words); });
}

void OperatorPage::tell(const PageEvent& what) {
  shared_->server->post([shared = shared_.get(), event = shared_text(event_text(what))] {
    shared->events.push_back(event);
    if (shared->events.size() > remembered_events) shared->events.pop_front();
    for (const BrowserId browser : std::set(shared->helm.browsers())) shared->server->send(browser, event);
  });
}

std::set<std::string> OperatorPage::watched() const {
  std::set<std::string> names;
  for (const auto& [browser, screen] : shared_->watchers()) names.insert(screen);
  return names;
}

WebCounters OperatorPage::counters() const { return shared_->server->counters(); }

}  // namespace septet::page
