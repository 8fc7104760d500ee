#pragma once
/// A small web server for one page and its WebSocket, on this machine's own addresses (127.0.0.1 and [::1]) alone.
///
/// Every user of this machine may connect, and a browser does so for any site that its user looks at; so before the
/// rest of a request is read its Host must be this machine or an allowed name (a foreign name that resolves to this
/// machine is refused), a WebSocket's Origin must be that same host, and it must hold the token, which no other site
/// can read. One thread of its own does all network input and output; handlers are called there. It never waits for a
/// browser: of states only the newest is sent, messages go into a bounded queue, and a browser that does not take them
/// is closed. Bytes from outside end a connection at worst, and connections without a whole request make room for new
/// ones.
///
/// Standards: RFC 9112 (HTTP/1.1), RFC 6455 (WebSocket), by Boost.Beast.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-server/page/listening_socket.hpp"

namespace septet::page {

/// Reply to a GET.
struct Resource {
  std::string path;  ///< "/", "/page.js".
  std::string type;  ///< "text/html; charset=utf-8".
  std::string_view body;
};

/// Content-Security-Policy of the resources: the page may load and reach this server alone.
inline constexpr std::string_view page_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

/// A resource made or read on request.
struct FoundResource {
  std::string type, body;
  std::string content_policy;  ///< Its Content-Security-Policy.
};

struct WebServerOptions {
  std::uint16_t port = 0;                  ///< 0: any free one.
  std::vector<std::string> allowed_hosts;  ///< Beside localhost, 127.0.0.1 and [::1]: names of a proxy.
  std::string token;                       ///< Required as one of the WebSocket's subprotocols.
  std::string socket_path = "/live";
  std::vector<Resource> resources;
  /// Further resources, called in the server's thread; an empty result is 404. May be empty. The path is any bytes.
  std::function<std::optional<FoundResource>(std::string_view path)> find;
  /// Listening socket made before (listening_socket.hpp), which is copied; null: at `port`.
  const ListeningSocket* listening = nullptr;
  double silence_s = 20.0;  ///< A browser that is silent for this long, and returns no ping, is closed.
};

inline constexpr std::size_t most_browsers = 16, most_connections = 256;
inline constexpr std::size_t most_header_bytes = 8192, most_message_bytes = 16384;
inline constexpr std::size_t most_read_bytes = std::size_t{1} << 20;  ///< A longer message ends its connection.
inline constexpr std::size_t most_waiting_messages = 256;

using BrowserId = std::uint64_t;
using Text = std::shared_ptr<const std::string>;
inline Text shared_text(std::string words) { return std::make_shared<const std::string>(std::move(words)); }

/// Called in the server's thread; may call send, send_newest and close.
struct WebHandlers {
  std::function<void(BrowserId)> opened;
  /// A text message, any bytes; of one longer than most_message_bytes its first most_message_bytes + 1.
  std::function<void(BrowserId, std::string_view)> said;
  std::function<void(BrowserId)> closed;
};

struct WebCounters {
  std::uint64_t connections = 0, refused = 0, opened = 0, closed = 0;
  std::uint64_t states_left_out = 0;  ///< Older states dropped before a slow browser took them.
};

class WebServer {
 public:
  /// Error: the port is not available.
  static Expected<std::unique_ptr<WebServer>> start(WebServerOptions options, WebHandlers handlers);
  /// Closes everything and waits for the thread.
  ~WebServer();

  std::uint16_t port() const;
  /// Runs `work` in the server's thread, soon. From any thread; never waits for a browser.
  void post(std::function<void()> work);

  /// In the server's thread. A message that must arrive.
  void send(BrowserId browser, Text text);
  /// In the server's thread. A state: replaces an unsent one.
  void send_newest(BrowserId browser, Text text);
  /// The same for a picture, per name.
  void send_newest_picture(BrowserId browser, const std::string& name, Text text);
  void close(BrowserId browser);
  /// Waits until every browser has been sent its queue, at most this long. From any other thread.
  void flush(double patience_s);
  WebCounters counters() const;

 private:
  struct Running;
  explicit WebServer(std::unique_ptr<Running> running);
  std::unique_ptr<Running> running_;
};

}  // namespace septet::page
