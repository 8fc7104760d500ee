#include "sim-server/page/web_server.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <exception>
#include <future>
#include <map>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "sim-server/page/request_checks.hpp"
#include "sim-server/page/signals_away.hpp"

namespace septet::page {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

constexpr auto patience = std::chrono::seconds(10);         // For a browser to take its reply.
constexpr auto request_patience = std::chrono::seconds(2);  // For a whole request: browsers send it at once.
constexpr std::string_view subprotocol = "septet";

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }
beast::string_view view(std::string_view text) { return {text.data(), text.size()}; }

/// The connections' view of their server.
struct Shared {
  WebServerOptions options;
  WebHandlers handlers;
  std::atomic<std::uint64_t> connections{0}, refused{0}, opened{0}, closed{0}, states_left_out{0};
};

/// A page's WebSocket: one write at a time, further messages queue.
class Browser : public std::enable_shared_from_this<Browser> {
 public:
  Browser(tcp::socket&& socket, BrowserId id, Shared& shared) : socket_(std::move(socket)), id_(id), shared_(shared) {}

  /// `opened` and `closed` come once each, or neither of the two.
  void accept(Request request, std::function<void()> opened, std::function<void()> closed) {
    closed_ = std::move(closed);
    const auto silence = std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * shared_.options.silence_s));
    socket_.set_option(websocket::stream_base::timeout{patience, silence, true});
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, view(subprotocol));
      response.set(http::field::server, "septet");
    }));
    socket_.read_message_max(most_read_bytes);
    socket_.auto_fragment(false);
    const auto kept = std::make_shared<Request>(std::move(request));
    socket_.async_accept(*kept, [self = shared_from_this(), kept, opened = std::move(opened)](error_code error) {
      if (error) return self->end();
      self->is_open_ = true;
      opened();
      self->read();
    });
  }

  void send(Text text) {
    if (is_ended_) return;
    if (messages_.size() >= most_waiting_messages) return end();
    messages_.push_back(std::move(text));
    write();
  }
  void send_newest(Text text) {
    if (is_ended_) return;
    if (std::exchange(newest_, std::move(text))) ++shared_.states_left_out;
    write();
  }
  void send_newest_picture(const std::string& name, Text text) {
    if (is_ended_) return;
    pictures_[name] = std::move(text);
    write();
  }
  void hang_up() {
    error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(tcp::socket::shutdown_both, ignored);
  }
  bool has_more() const { return is_open_ && (writing_ || newest_ || !messages_.empty() || !pictures_.empty()); }
  void end() {
    if (std::exchange(is_ended_, true)) return;
    error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
    closed_();
  }

 private:
  /// A message comes in parts: what is beyond the longest one is dropped as it comes.
  void read() {
    socket_.async_read_some(buffer_, read_at_once_bytes, [self = shared_from_this()](error_code error, std::size_t) {
      if (error || self->is_ended_) return self->end();
      const auto bytes = self->buffer_.cdata();
      self->said_.append(static_cast<const char*>(bytes.data()),
                         std::min(bytes.size(), most_message_bytes + 1 - self->said_.size()));
      self->buffer_.consume(bytes.size());
      if (self->socket_.is_message_done()) {
        if (self->socket_.got_text()) self->shared_.handlers.said(self->id_, self->said_);
        self->said_.clear();
      }
      if (!self->is_ended_) self->read();
    });
  }
  void write() {
    if (writing_ || !is_open_ || is_ended_) return;
    if (!messages_.empty()) {
      writing_ = std::move(messages_.front());
      messages_.pop_front();
    } else if (newest_) {
      writing_ = std::exchange(newest_, nullptr);
    } else if (!pictures_.empty()) {
      writing_ = std::move(pictures_.begin()->second);
      pictures_.erase(pictures_.begin());
    }
    if (!writing_) return;
    socket_.text(true);
    socket_.async_write(asio::buffer(*writing_), [self = shared_from_this()](error_code error, std::size_t) {
      self->writing_ = nullptr;
      if (error) return self->end();
      self->write();
    });
  }

  websocket::stream<beast::tcp_stream> socket_;
  BrowserId id_;
  Shared& shared_;
  static constexpr std::size_t read_at_once_bytes = 4096;
  beast::flat_buffer buffer_{read_at_once_bytes};
  std::string said_;  ///< The message so far, up to a byte more than the longest one.
  std::deque<Text> messages_;
  Text newest_, writing_;
  std::map<std::string, Text> pictures_;  ///< The newest of each name.
  bool is_open_ = false, is_ended_ = false;
  std::function<void()> closed_;
};

/// One request and its reply; then the connection is closed, or has become a browser's.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  using Upgrade = std::function<void(tcp::socket&&, Request&&)>;

  Connection(tcp::socket&& socket, Shared& shared, std::function<bool()> has_room, Upgrade upgrade)
      : stream_(std::move(socket)), shared_(shared), has_room_(std::move(has_room)), upgrade_(std::move(upgrade)) {
    parser_.header_limit(most_header_bytes);
    parser_.body_limit(0);
  }

  void start() {
    stream_.expires_after(request_patience);
    // The header is a whole request: a body is never awaited.
    http::async_read_header(stream_, buffer_, parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (!self->stream_.socket().is_open()) return;  // It had to make room.
      if (!error) return self->answer(std::move(self->parser_.get()));
      if (error.category() == make_error_code(http::error::bad_method).category() &&
          error != http::error::end_of_stream && error != http::error::partial_message)
        return self->refuse(http::status::bad_request, "this is no request that this server reads");
    });
  }
  void end() {
    error_code ignored;
    stream_.socket().close(ignored);
  }
  /// Expendable: it has sent no whole request, or its whole reply is out.
  bool may_go() const { return !is_answering_; }

 private:
  void answer(Request request) {
    is_answering_ = true;
    const auto host = view(request[http::field::host]);
    if (request.count(http::field::host) != 1 || !is_allowed_host(host, shared_.options.allowed_hosts))
      return refuse(http::status::forbidden, "this server answers on 127.0.0.1 and localhost only");
    if (!parser_.is_done()) return refuse(http::status::bad_request, "a request with a body is not read");
    const auto target = view(request.target());
    if (target == shared_.options.socket_path) return open_socket(std::move(request), host);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return refuse(http::status::method_not_allowed, "only GET is answered");
    // Additions to the address, as of messengers and mail programs, are ignored.
    const auto path = target.substr(0, target.find('?'));
    for (const Resource& resource : shared_.options.resources)
      if (resource.path == path)
        return send(http::status::ok, resource.type, std::string(resource.body), request.method() == http::verb::head);
    if (shared_.options.find)
      if (auto found = shared_.options.find(target))
        return send(http::status::ok, found->type, std::move(found->body), request.method() == http::verb::head,
                    found->content_policy);
    refuse(http::status::not_found, "there is nothing of this name");
  }

  void open_socket(Request request, std::string_view host) {
    if (!websocket::is_upgrade(request)) return refuse(http::status::upgrade_required, "this is a WebSocket");
    const auto origins = request.count(http::field::origin);
    if (origins > 1 || (origins == 1 && !is_own_origin(view(request[http::field::origin]), host)))
      return refuse(http::status::forbidden, "another site may not connect");
    if (request.count(http::field::sec_websocket_protocol) != 1 ||
        !holds_token(view(request[http::field::sec_websocket_protocol]), shared_.options.token))
      return refuse(http::status::forbidden, "the token is wrong: use the address that the server printed");
    if (!has_room_()) return refuse(http::status::service_unavailable, "too many browsers look on");
    stream_.expires_never();
    upgrade_(stream_.release_socket(), std::move(request));
  }

  void refuse(http::status status, std::string_view why) {
    ++shared_.refused;
    send(status, "text/plain; charset=utf-8", std::string(why), false);
  }

  void send(http::status status, std::string_view type, std::string body, bool without_body,
            std::string_view content_policy = page_policy) {
    response_ = Response(status, 11);
    response_.set(http::field::server, "septet");
    response_.set(http::field::content_type, view(type));
    response_.set("Content-Security-Policy", view(content_policy));
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("X-Frame-Options", "DENY");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set(http::field::cache_control, "no-store");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.keep_alive(false);
    response_.content_length(body.size());
    if (!without_body) response_.body() = std::move(body);
    stream_.expires_after(patience);
    serializer_.emplace(response_);
    if (without_body)
      http::async_write_header(stream_, *serializer_,
                               [self = shared_from_this()](error_code, std::size_t) { self->finish(); });
    else
      http::async_write(stream_, *serializer_,
                        [self = shared_from_this()](error_code, std::size_t) { self->finish(); });
  }
  /// Shuts down the sending side, and reads on until the other side has read everything: closing at once would discard
  /// sent data.
  void finish() {
    is_answering_ = false;
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    drain();
  }
  void drain() {
    stream_.async_read_some(asio::buffer(rest_), [self = shared_from_this()](error_code error, std::size_t count) {
      if (error || (self->drained_ += count) > (std::size_t{1} << 20)) return self->end();
      self->drain();
    });
  }

  beast::tcp_stream stream_;
  Shared& shared_;
  std::function<bool()> has_room_;
  Upgrade upgrade_;
  beast::flat_buffer buffer_{most_header_bytes + 1024};
  http::request_parser<http::empty_body> parser_;
  Response response_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  std::array<char, 4096> rest_{};
  std::size_t drained_ = 0;
  bool is_answering_ = false;
};

}  // namespace

struct WebServer::Running {
  Shared shared;
  asio::io_context context{1};
  std::array<tcp::acceptor, 2> acceptors{tcp::acceptor(context), tcp::acceptor(context)};  ///< IPv4, IPv6.
  std::array<asio::steady_timer, 2> retries{asio::steady_timer(context), asio::steady_timer(context)};
  std::map<BrowserId, std::shared_ptr<Browser>> browsers;  ///< Includes those that are still opening.
  std::vector<std::weak_ptr<Connection>> connections;      ///< The oldest first.
  BrowserId next_browser = 1;
  std::uint16_t port = 0;
  std::thread thread;

  void accept(std::size_t which) {
    tcp::acceptor& acceptor = acceptors[which];
    acceptor.async_accept([this, which, &acceptor](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted || !acceptor.is_open()) return;
      if (error) {  // For example without a free file descriptor: others may become free.
        retries[which].expires_after(std::chrono::milliseconds(100));
        retries[which].async_wait([this, which](error_code stopped) {
          if (!stopped) accept(which);
        });
        return;
      }
      ++shared.connections;
      ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
      make_room();
      const auto connection = std::make_shared<Connection>(
          std::move(socket), shared, [this] { return browsers.size() < most_browsers; },
          [this](tcp::socket&& taken, Request&& request) { open(std::move(taken), std::move(request)); });
      connections.push_back(connection);
      connection->start();
      accept(which);
    });
  }

  /// If all places are taken, closes the oldest connection without a whole request, or with its reply sent: idle
  /// connections cannot keep out others, which send their request at once. If all are being served, closes the oldest
  /// of them.
  void make_room() {
    std::erase_if(connections, [](const auto& connection) { return connection.expired(); });
    if (connections.size() < most_connections) return;
    const auto may_go = [](const auto& connection) { return connection.lock()->may_go(); };
    const auto found = std::ranges::find_if(connections, may_go);
    const auto oldest = found == connections.end() ? connections.begin() : found;
    oldest->lock()->end();
    connections.erase(oldest);
    ++shared.refused;
  }

  void open(tcp::socket&& socket, Request&& request) {
    const BrowserId id = next_browser++;
    const auto browser = std::make_shared<Browser>(std::move(socket), id, shared);
    browsers.emplace(id, browser);
    const auto was_opened = std::make_shared<bool>(false);
    browser->accept(
        std::move(request),
        [this, id, was_opened] {
          *was_opened = true;
          ++shared.opened;
          shared.handlers.opened(id);
        },
        [this, id, was_opened] {
          browsers.erase(id);
          if (!*was_opened) return;
          ++shared.closed;
          shared.handlers.closed(id);
        });
  }

  /// May be gone by now.
  std::shared_ptr<Browser> find(BrowserId id) const {
    const auto found = browsers.find(id);
    return found == browsers.end() ? nullptr : found->second;
  }

  void run() {
    while (true) {
      try {
        context.run();
        return;
      } catch (const std::exception&) {  // A fault of one connection, which is gone with its handler.
      }
    }
  }
};

Expected<std::unique_ptr<WebServer>> WebServer::start(WebServerOptions options, WebHandlers handlers) {
  auto running = std::make_unique<Running>();
  auto here =
      options.listening
          ? options.listening->copy()
          : ListeningSocket::open(options.port).and_then([](const ListeningSocket& made) { return made.copy(); });
  if (!here) return tl::unexpected(here.error());
  running->shared.options = std::move(options);
  running->shared.handlers = std::move(handlers);
  error_code error;
  const auto listen_on = [&](std::size_t which, tcp protocol, int& file) {
    if (file < 0 || error) return;
    running->acceptors[which].assign(protocol, file, error);
    if (!error) file = -1;  // The acceptor owns it now.
  };
  listen_on(0, tcp::v4(), here->ipv4);
  listen_on(1, tcp::v6(), here->ipv6);
  here->close();
  if (error) return failure(error.message(), "the operator's page", "close other programs");
  running->port = running->acceptors[0].local_endpoint(error).port();
  for (std::size_t which = 0; which < running->acceptors.size(); ++which)
    if (running->acceptors[which].is_open()) running->accept(which);
  const SignalsAway away;
  running->thread = std::thread([&running = *running] { running.run(); });
  return std::unique_ptr<WebServer>(new WebServer(std::move(running)));
}

WebServer::WebServer(std::unique_ptr<Running> running) : running_(std::move(running)) {}
WebServer::~WebServer() {
  running_->context.stop();
  running_->thread.join();
  // Browsers hear at once that this server is gone, even if a child program holds a copy of the socket.
  for (const auto& [id, browser] : running_->browsers) browser->hang_up();
}

std::uint16_t WebServer::port() const { return running_->port; }
void WebServer::post(std::function<void()> work) { asio::post(running_->context, std::move(work)); }
void WebServer::send(BrowserId browser, Text text) {
  if (const auto found = running_->find(browser)) found->send(std::move(text));
}
void WebServer::send_newest(BrowserId browser, Text text) {
  if (const auto found = running_->find(browser)) found->send_newest(std::move(text));
}
void WebServer::send_newest_picture(BrowserId browser, const std::string& name, Text text) {
  if (const auto found = running_->find(browser)) found->send_newest_picture(name, std::move(text));
}
void WebServer::close(BrowserId browser) {
  if (const auto found = running_->find(browser)) found->end();
}
void WebServer::flush(double patience_s) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (std::chrono::steady_clock::now() < until) {
    const auto more = std::make_shared<std::promise<bool>>();
    auto answer = more->get_future();
    post([&running = *running_, more] {
      more->set_value(std::ranges::any_of(running.browsers, [](const auto& one) { return one.second->has_more(); }));
    });
    if (answer.wait_until(until) != std::future_status::ready || !answer.get()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}
WebCounters WebServer::counters() const {
  const Shared& shared = running_->shared;
  return {shared.connections, shared.refused, shared.opened, shared.closed, shared.states_left_out};
}

}  // namespace septet::page
