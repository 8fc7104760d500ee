#include "sim-server/page/start_page.hpp"

#include <algorithm>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/core/regular_file.hpp"
#include "sim-server/page/helm.hpp"
#include "sim-server/page/page_files.hpp"
#include "sim-server/page/request_checks.hpp"
#include "sim-server/page/start_messages.hpp"

namespace septet::page {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view past_begin = "/past/";
constexpr std::size_t token_characters = 32, most_looks = 64;
/// A report is a page of its own, without scripts and without network access.
constexpr const char* past_policy =
    "default-src 'none'; style-src 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'";

/// A browser shows a film by itself in a page of its own making.
constexpr const char* film_policy =
    "default-src 'none'; media-src 'self'; style-src 'unsafe-inline'; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'";

/// A word of a file's name, as Septet makes them.
bool is_plain(std::string_view word) {
  return !word.empty() && word.size() <= 60 && std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

/// A temporary permission to read a past session's file: its address carries no information and cannot be guessed.
struct PastLook {
  std::string token;
  fs::path folder;
};

std::optional<FoundResource> read_past(const fs::path& folder, std::string_view name) {
  if (!is_past_file(name)) return std::nullopt;
  std::error_code error;
  const fs::path file = fs::canonical(folder / name, error);
  if (error) return std::nullopt;
  // A link in the folder leads nowhere else.
  const fs::path within = fs::canonical(folder, error);
  if (error || std::ranges::mismatch(within, file).in1 != within.end()) return std::nullopt;
  const bool is_film = name.ends_with(".mp4");
  auto bytes = read_regular_file(file, is_film ? largest_film_bytes : largest_past_file_bytes);
  if (!bytes) return std::nullopt;
  if (is_film) return FoundResource{"video/mp4", std::move(*bytes), film_policy};
  return FoundResource{name.ends_with(".png") ? "image/png" : "text/html; charset=utf-8", std::move(*bytes),
                       past_policy};
}

}  // namespace

bool is_past_file(std::string_view name) {
  if (name == "report.html" || name == "debrief.html" || name == "panorama.png" || name == "film.mp4") return true;
  constexpr std::string_view screens = "screens/", png = ".png";
  if (!name.starts_with(screens) || !name.ends_with(png)) return false;
  name = name.substr(screens.size(), name.size() - screens.size() - png.size());
  const auto slash = name.find('/');
  return slash != name.npos && is_plain(name.substr(0, slash)) && is_plain(name.substr(slash + 1));
}

struct StartPage::Shared {
  std::mutex starting;  ///< Held until the server is stored: handlers that need it wait.
  WishBox wishes;

  // The page's thread's own.
  Choices choices;
  Helm helm;
  StartView view;
  std::vector<fs::path> folders;  ///< Folders of view.sessions.
  std::deque<PastLook> looks;     ///< The newest last.

  std::unique_ptr<WebServer> server;  ///< Last: its thread is gone before the rest.

  void opened(BrowserId browser) {
    helm.opened(browser);
    server->send(browser, shared_text(start_hello_text(choices, browser)));
    send_state();
  }
  void closed(BrowserId browser) {
    helm.closed(browser);
    send_state();
  }
  void send_state() {
    if (helm.browsers().empty()) return;
    const Text state = shared_text(start_state_text(view, helm.commander(), helm.browsers().size()));
    for (const BrowserId browser : std::set(helm.browsers())) server->send_newest(browser, state);
  }
  void said(BrowserId browser, std::string_view words) {
    auto message = read_browser_message(words);
    if (!message) return server->send(browser, shared_text(refusal_text(words, message.error())));
    const auto answer = [&](const std::optional<std::string>& why_not) {
      server->send(browser, shared_text(answer_text(message->id, why_not)));
    };
    if (const auto* look = std::get_if<Look>(&message->wish)) {
      const auto session = std::ranges::find(view.sessions, look->session, &PastSession::id);
      if (session == view.sessions.end()) return answer("there is no such session any more");
      if (!is_past_file(look->file)) return answer("there is no such file");
      looks.push_back({random_token(), folders[static_cast<std::size_t>(session - view.sessions.begin())]});
      if (looks.size() > most_looks) looks.pop_front();
      return server->send(browser, shared_text(look_text(message->id, std::string(past_begin.substr(1)) +
                                                                          looks.back().token + '/' + look->file)));
    }
    if (const auto reply = helm.judge(browser, message->wish)) {
      answer(reply->why_not);
      return reply->why_not ? void() : send_state();
    }
    if (!std::holds_alternative<Start>(message->wish) && !std::holds_alternative<Cancel>(message->wish) &&
        !std::holds_alternative<Answer>(message->wish) && !std::holds_alternative<Make>(message->wish) &&
        !std::holds_alternative<StopMaking>(message->wish))
      return answer("no drive goes on");
    if (!wishes.put({browser, message->id, helm.commander()->name, std::move(message->wish)}))
      answer("what was asked before has not yet been done");
  }
  std::optional<FoundResource> find(std::string_view path) const {
    if (!path.starts_with(past_begin)) return std::nullopt;
    path.remove_prefix(past_begin.size());
    if (path.size() <= token_characters || path[token_characters] != '/') return std::nullopt;
    for (const PastLook& look : looks)
      if (holds_token(path.substr(0, token_characters), look.token))
        return read_past(look.folder, path.substr(token_characters + 1));
    return std::nullopt;
  }
};

Expected<std::unique_ptr<StartPage>> StartPage::open(const ListeningSocket& listening, std::string token,
                                                     std::vector<std::string> allowed_hosts, Choices choices) {
  auto shared = std::make_unique<Shared>();
  shared->choices = std::move(choices);
  Shared* const here = shared.get();
  WebServerOptions web{.allowed_hosts = std::move(allowed_hosts),
                       .token = std::move(token),
                       .resources = page_files(),
                       .find = [here](std::string_view path) { return here->find(path); },
                       .listening = &listening};
  std::unique_lock starting(shared->starting);
  auto server = WebServer::start(std::move(web),
                                 {[here](BrowserId browser) {
                                    { const std::lock_guard kept(here->starting); }
                                    here->opened(browser);
                                  },
                                  [here](BrowserId browser, std::string_view words) { here->said(browser, words); },
                                  [here](BrowserId browser) { here->closed(browser); }});
  if (!server) return tl::unexpected(server.error());
  shared->server = std::move(*server);
  starting.unlock();
  return std::unique_ptr<StartPage>(new StartPage(std::move(shared)));
}

StartPage::StartPage(std::unique_ptr<Shared> shared) : shared_(std::move(shared)) {}
StartPage::~StartPage() {
  shared_->server->post([shared = shared_.get()] {
    for (const BrowserId browser : std::set(shared->helm.browsers()))
      shared->server->send(browser, shared_text(moved_text()));
  });
  shared_->server->flush(0.5);
}

void StartPage::show(StartView view, std::vector<fs::path> folders) {
  shared_->server->post([shared = shared_.get(), view = std::move(view), folders = std::move(folders)] {
    shared->view = view;
    shared->folders = folders;
    shared->send_state();
  });
}

std::vector<OperatorWish> StartPage::take_wishes() { return shared_->wishes.take(); }

void StartPage::answer(const OperatorWish& wish, const std::optional<std::string>& why_not) {
  send_answer(*shared_->server, wish, why_not);
}

}  // namespace septet::page
