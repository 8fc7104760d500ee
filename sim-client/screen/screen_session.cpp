#include "sim-client/screen/screen_session.hpp"

#include <chrono>
#include <fstream>
#include <functional>
#include <future>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/net/keys.hpp"
#include "engine/net/udp_socket.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/content_hash.hpp"
#include "engine/scene/resolve.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/frame/instruments.hpp"
#include "sim-client/frame/picture_writer.hpp"
#include "sim-client/frame/playout.hpp"
#include "sim-client/frame/screen_frames.hpp"
#include "sim-client/link/screen_link.hpp"
#include "sim-client/screen/departure.hpp"
#include "sim-client/screen/even_times.hpp"
#include "sim-client/screen/frame_times.hpp"
#include "sim-client/screen/pause_request.hpp"
#include "sim-client/screen/picture_rate.hpp"
#include "sim-client/screen/screen_display.hpp"
#include "sim-client/screen/thumbnail_maker.hpp"
#include "sim-client/screen/window_shape.hpp"

namespace septet::screen {
namespace {

/// State that outlives a welcome of the server.
class Session {
 public:
  Session(const ScreenOptions& options, net::UdpSocket lane_socket, net::UdpSocket tick_socket, ScreenLinkOptions link)
      : options_(options),
        lane_socket_(std::move(lane_socket)),
        tick_socket_(std::move(tick_socket)),
        link_(lane_socket_, tick_socket_, open_group, std::move(link)) {}
  /// However it ends, the server is told: it would let no other one with this key in before it has missed this one for
  /// seconds.
  ~Session() { link_.close(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Expected<void> run();

 private:
  static Expected<std::unique_ptr<net::DatagramSocket>> open_group(const net::Address& group,
                                                                   std::uint32_t interface_ip) {
    return net::UdpSocket::open_group(group, interface_ip)
        .map([](net::UdpSocket socket) -> std::unique_ptr<net::DatagramSocket> {
          return std::make_unique<net::UdpSocket>(std::move(socket));
        });
  }

  Expected<void> take_welcome();
  /// Whose eyes the server asks for; empty: the driver's.
  std::optional<frame::Eyes> eyes() const {
    const control::Welcome& welcome = *link_.welcome();
    if (welcome.eyes == 0) return std::nullopt;
    return frame::Eyes{welcome.eyes, welcome.eyes_name};
  }
  Expected<void> bring_scene_up();
  Expected<void> draw_lockstep();
  Expected<void> draw_real_time(double now_s);
  Expected<void> draw_lost(double now_s);
  /// A screen without a measured place is drawn in the window's own pixels, whatever its present shape.
  Expected<void> take_window_shape();
  Expected<void> draw(const Snapshot& snapshot, const std::optional<std::string>& message);
  /// Runs the renderer's `work` in a thread of its own: meanwhile keys are read and the server gets signs of life,
  /// however long a picture or a scene takes. `work` leaves the link alone; after it the link may belong to another
  /// drive.
  Expected<void> beside_lane(const std::function<Expected<void>()>& work);
  void send_controls();
  /// True if the server was restarted during the renderer's work, whose result is then discarded.
  bool has_begun_anew() const { return link_.welcomes() != welcomes_ || link_.history().empty(); }
  void count_frame();
  /// Takes the effects that `snapshot`'s instant shows, by the keyframes around it.
  void take_effects(const Snapshot& snapshot);
  Expected<void> keep_picture(Tick tick);
  /// Of the scene that the kept picture of this tick shows.
  Expected<void> keep_scene_hash(Tick tick);
  /// Sends the picture shown, if an operator watches closely and the next one is due.
  Expected<void> show_closely(Tick tick, double now_s);
  void send_pictures();
  void say_goodbye();
  /// Notice of a low picture rate, and on the screen ahead the driver's text; absent from kept pictures.
  std::vector<instant::OverlayText> driver_texts(const Snapshot& snapshot);
  void wait(double seconds);

  const ScreenOptions& options_;
  net::UdpSocket lane_socket_, tick_socket_;
  ScreenLink link_;
  scene::Resolver resolver_;
  std::uint64_t scene_generation_ = 0;
  std::uint64_t uploaded_revision_ = 0;
  std::uint32_t welcomes_ = 0;
  rig::Rig rig_;
  rig::Screen* screen_ = nullptr;
  rig::Screen screen_of_rig_;  ///< Screen as in the rig, whatever shape its window has.
  std::unique_ptr<Display> display_;
  frame::PictureWriter pictures_;
  ThumbnailMaker thumbnails_, large_pictures_{large_picture};
  EvenTimes looks_{control::look_every_s};           ///< Of large pictures.
  static constexpr double thumbnails_apart_s = 0.7;  ///< At least: a window's come once a second, give or take.
  double thumbnail_s_ = -thumbnails_apart_s;         ///< Time of the newest thumbnail.
  FrameTimes frame_times_, submit_times_;
  std::optional<double> last_picture_s_;
  PictureRate picture_rate_;
  std::uint64_t frames_ = 0, frames_off_tick_ = 0;
  std::optional<Tick> drawn_tick_;
  std::optional<Snapshot> last_shown_;
  frame::ScreenFrames screen_frames_;
  double lost_drawn_s_ = 0.0;
  static constexpr std::chrono::milliseconds keys_every{8};
  static constexpr double keys_shown_for_s = 30.0;  ///< Duration from the start, until the first key is pressed.
  std::optional<bool> keys_shown_;                  ///< Chosen by the driver's keys; empty: no key was pressed yet.
  bool was_touched_ = false;
  float last_submit_ms_ = 0.0f;
};

Expected<void> Session::take_welcome() {
  if (link_.welcomes() == welcomes_) return {};
  welcomes_ = link_.welcomes();
  auto rig = rig::read_rig(link_.welcome()->rig, "rig from the server");
  if (!rig) return tl::unexpected(rig.error());
  rig_ = std::move(*rig);
  screen_ = nullptr;
  for (auto& screen : rig_.screens)
    if (screen.name == options_.name) screen_ = &screen;
  if (!screen_) return failure("the rig has no such screen", options_.name, "start one of the rig's screens");
  if (auto seen = screen_frames_.look_through(rig_, *screen_, eyes()); !seen) return seen;
  drawn_tick_.reset();
  resolver_.forget();
  uploaded_revision_ = 0;
  const bool is_other_screen =
      screen_of_rig_.width_px != screen_->width_px || screen_of_rig_.height_px != screen_->height_px;
  screen_of_rig_ = *screen_;
  // A restarted server usually brings the same rig: its content is new, the picture's place is not.
  if (display_ && !is_other_screen) return {};
  // Opening the display takes a tenth of a second, in which the scene arrives.
  std::jthread receiving([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      link_.pump(program::monotonic_s());
      wait(0.001);
    }
  });
  auto display = Display::open(
      {screen_->width_px, screen_->height_px, options_.is_virtual, options_.full_screen || screen_->full_screen,
       options_.monitor ? options_.monitor : screen_->monitor, options_.validation, "Septet " + screen_->name});
  receiving.request_stop();
  receiving.join();
  if (!display) return tl::unexpected(display.error());
  display_ = std::move(*display);
  return {};
}

Expected<void> Session::bring_scene_up() {
  if (std::exchange(scene_generation_, link_.scene_generation()) != link_.scene_generation()) resolver_.forget();
  // The first picture is drawn whole or not at all; in real time a later change is spread over frames.
  const bool spread = !link_.welcome()->lockstep && uploaded_revision_ != 0;
  resolver_.update(link_.scene(), spread ? 64 : ~std::size_t{0});
  const auto& scene = resolver_.scene();
  if (scene.revision == uploaded_revision_) return {};
  uploaded_revision_ = scene.revision;
  return beside_lane([&] { return display_->renderer().upload(scene); });
}

Expected<void> Session::take_window_shape() {
  const auto size = display_->window_size();
  render::Renderer& renderer = display_->renderer();
  if (!size || !takes_window_shape(rig_, screen_of_rig_)) return {};
  if (*size != Display::Size{renderer.width(), renderer.height()})
    if (auto resized = renderer.resize(size->width_px, size->height_px); !resized) return resized;
  if (*size == Display::Size{screen_->width_px, screen_->height_px}) return {};
  *screen_ = shaped_to_window(screen_of_rig_, rig_.eye_point_m, size->width_px, size->height_px);
  return screen_frames_.look_through(rig_, *screen_, eyes());
}

Expected<void> Session::draw(const Snapshot& snapshot, const std::optional<std::string>& message) {
  const double begun_s = program::monotonic_s();
  if (auto shaped = take_window_shape(); !shaped) return shaped;
  auto input = screen_frames_.frame(snapshot, resolver_.scene(), message);
  const auto texts = message ? std::vector<instant::OverlayText>{} : driver_texts(snapshot);
  const auto work = [&] { return display_->renderer().draw(std::move(input), texts); };
  if (auto drawn = beside_lane(work); !drawn) return drawn;
  last_submit_ms_ = static_cast<float>(1e3 * (program::monotonic_s() - begun_s));
  return {};
}

Expected<void> Session::beside_lane(const std::function<Expected<void>()>& work) {
  const bool is_driven_at = display_->paces_itself() && !link_.server_is_gone() && !link_.welcome()->lockstep;
  auto working = std::async(std::launch::async, work);
  while (working.wait_for(keys_every) != std::future_status::ready) {
    if (is_driven_at) {
      display_->attend();
      send_controls();
    }
    link_.pump(program::monotonic_s());
  }
  return working.get();
}

void Session::send_controls() {
  const double speed_mps = last_shown_ ? last_shown_->driver_car.speed_mps : 0.0;
  if (auto controls = display_->controls(program::monotonic_s(), speed_mps))
    link_.send(control::Controls{*controls}, net::Reliability::unreliable);
}

/// Counts a picture; called after each. The parent program is notified of the first.
void Session::count_frame() {
  const double now_s = program::monotonic_s();
  if (last_picture_s_) frame_times_.add(1e3 * (now_s - *last_picture_s_));
  last_picture_s_ = now_s;
  submit_times_.add(last_submit_ms_);
  if (frames_++ == 0) program::announce("showing");
}

void Session::take_effects(const Snapshot& snapshot) {
  screen_frames_.show(snapshot, link_.history(), 1.0 / link_.welcome()->tick_rate_hz, resolver_.scene());
}

std::vector<instant::OverlayText> Session::driver_texts(const Snapshot& snapshot) {
  std::vector<instant::OverlayText> texts;
  const auto add = [&](const std::vector<instant::OverlayText>& more) {
    texts.insert(texts.end(), more.begin(), more.end());
  };
  if (!options_.is_virtual)
    if (auto slow = slowness(picture_rate_, display_->renderer().device_name().starts_with("llvmpipe")))
      texts.push_back(frame::low_line(std::move(*slow), *screen_));
  const bool is_ahead = screen_ == &rig::screen_ahead(rig_);
  const control::Notice& notice = link_.notice();
  const bool unasked = is_ahead && notice.keys && snapshot.simulated_time_s < keys_shown_for_s;
  if (display_->take_keys_request())
    keys_shown_ = !keys_shown_.value_or(unasked);
  else if (display_->is_touched() && !std::exchange(was_touched_, true))
    keys_shown_ = false;
  // Any window may have the keyboard: the table is on the one whose F1 was pressed.
  if (keys_shown_.value_or(unasked))
    add(frame::key_table(is_ahead ? notice.text : "", *screen_));
  else if (is_ahead)
    add(frame::notice(notice.text, *screen_));
  return texts;
}

Expected<void> Session::keep_picture(Tick tick) {
  // A drive that keeps each picture would else send a small one of each.
  const double now_s = program::monotonic_s();
  const bool is_thumbnail_due = link_.welcome()->thumbnails && now_s - thumbnail_s_ >= thumbnails_apart_s;
  if (options_.pictures.empty() && !is_thumbnail_due) return {};
  auto picture = display_->renderer().read_back();
  if (!picture) return tl::unexpected(picture.error());
  if (is_thumbnail_due) {
    thumbnail_s_ = now_s;
    thumbnails_.take(tick, *picture);
  }
  if (options_.pictures.empty()) return {};
  pictures_.write(options_.pictures / fmt::format("{}.png", tick), std::move(*picture));
  return keep_scene_hash(tick);
}

Expected<void> Session::keep_scene_hash(Tick tick) {
  if (options_.scene_hashes.empty()) return {};
  std::ofstream file(options_.scene_hashes, std::ios::app);
  file << fmt::format("{} {:016x}\n", tick, scene::content_hash(link_.scene())) << std::flush;
  if (!file) return failure("it cannot be written", options_.scene_hashes.string(), "name a file that can be");
  return {};
}

Expected<void> Session::show_closely(Tick tick, double now_s) {
  if (!link_.is_looked_at(now_s)) {
    looks_.reset();
    return {};
  }
  // Where the last one is still being made the next frame is taken.
  if (!looks_.is_due(now_s) || !large_pictures_.is_idle()) return {};
  looks_.done(now_s);
  const auto picture = display_->renderer().read_back();
  if (!picture) return tl::unexpected(picture.error());
  large_pictures_.take(tick, *picture);
  return {};
}

/// One at a time: a newer picture replaces one that waits for the lane. The large one goes first.
void Session::send_pictures() {
  if (link_.has_backlog()) return;
  if (auto large = large_pictures_.finished())
    link_.send(control::LargePicture{large->tick, std::move(large->picture)}, net::Reliability::reliable);
  else if (auto small = thumbnails_.finished())
    link_.send(control::Thumbnail{small->tick, std::move(small->picture)}, net::Reliability::reliable);
}

Expected<void> Session::draw_lockstep() {
  if (!link_.scene_arrived() || link_.history().empty()) return {};
  const Tick tick = link_.history().newest().snapshot.tick;
  if (drawn_tick_ && *drawn_tick_ >= tick) return {};
  if (!link_.has_scene_of(link_.history().newest())) return {};
  link_.show_scene(tick);
  last_shown_ = link_.history().newest().snapshot;  // The history goes on meanwhile.
  if (auto scene = bring_scene_up(); !scene || has_begun_anew()) return scene;
  take_effects(*last_shown_);
  if (auto drawn = draw(*last_shown_, std::nullopt); !drawn) return drawn;
  drawn_tick_ = tick;
  count_frame();
  const std::uint32_t every = link_.welcome()->picture_every_ticks;
  if (every != 0 && tick % every == 0)
    if (auto kept = keep_picture(tick); !kept) return kept;
  link_.send(control::Presented{tick, last_submit_ms_}, net::Reliability::reliable);
  return show_closely(tick, program::monotonic_s());
}

Expected<void> Session::draw_real_time(double now_s) {
  const auto server_s = link_.server_time_s(now_s);
  const bool nothing_yet = uploaded_revision_ == 0 && !link_.scene_arrived();
  if (!server_s || link_.history().empty() || nothing_yet) {
    wait(0.002);
    return {};
  }
  const auto due = link_.history().around(*frame::playout_time_s(link_.history(), frame::frame_number(*server_s)));
  if (due.before) link_.show_scene(due.before->snapshot.tick);
  if (auto scene = bring_scene_up(); !scene || has_begun_anew()) return scene;
  const double tick_s = 1.0 / link_.welcome()->tick_rate_hz;
  const auto shown =
      frame::show(link_.history(), *frame::playout_time_s(link_.history(), frame::frame_number(*server_s)), tick_s);
  take_effects(shown.snapshot);
  if (auto drawn = draw(shown.snapshot, std::nullopt); !drawn) return drawn;
  picture_rate_.add(now_s);
  last_shown_ = shown.snapshot;
  count_frame();
  if (!shown.on_tick && shown.tick != 0) ++frames_off_tick_;  // The first one is held until the driver is ready.
  link_.send(control::Presented{shown.tick, last_submit_ms_}, net::Reliability::unreliable);
  const std::uint32_t every = link_.welcome()->picture_every_ticks;
  if (every != 0 && (!drawn_tick_ || shown.tick / every != *drawn_tick_ / every))
    if (auto kept = keep_picture(shown.tick); !kept) return kept;
  if (auto shown_closely = show_closely(shown.tick, now_s); !shown_closely) return shown_closely;
  drawn_tick_ = shown.tick;
  send_controls();
  if (!display_->paces_itself()) wait(1.0 / frame::frame_rate_hz - 1e-3 * last_submit_ms_);
  return {};
}

Expected<void> Session::draw_lost(double now_s) {
  last_picture_s_.reset();
  // The last picture is held, with a line on the cause; ten times a second is enough for a still picture.
  if (!last_shown_ || now_s - lost_drawn_s_ < 0.1) {
    wait(0.01);
    return {};
  }
  lost_drawn_s_ = now_s;
  auto drawn = draw(*last_shown_, "The server is gone. This is the last picture; it goes on by itself.");
  if (drawn && !options_.pictures.empty()) {
    const auto picture = display_->renderer().read_back();
    if (picture) pictures_.write(options_.pictures / "server-lost.png", *picture);
    lost_drawn_s_ = now_s + 1.0;
  }
  return drawn;
}

void Session::wait(double seconds) {
  if (seconds <= 0.0) return;
  const net::UdpSocket* sockets[] = {&lane_socket_, &tick_socket_};
  net::wait_readable(sockets, seconds);
}

void Session::say_goodbye() {
  if (display_) {
    const auto& last = display_->renderer().statistics();
    program::say(
        fmt::format("{}: {} frames; the last one: {} triangles ({} of them for shadows), {} draws, {} instances",
                    options_.name, frames_, last.triangles, last.shadow_triangles, last.draws, last.instances));
  }
  const auto percentile = [](const FrameTimes& times, double fraction) {
    return static_cast<float>(times.percentile_ms(fraction));
  };
  control::ScreenReport report{.frames = frames_, .frames_off_tick = frames_off_tick_};
  report.frame_ms_p50 = percentile(frame_times_, 0.5);
  report.frame_ms_p99 = percentile(frame_times_, 0.99);
  report.submit_ms_p50 = percentile(submit_times_, 0.5);
  report.submit_ms_p99 = percentile(submit_times_, 0.99);
  link_.report(report);
  const double until_s = program::monotonic_s() + 1.0;
  while (program::monotonic_s() < until_s && link_.state() == net::ClientState::connected) {
    link_.pump(program::monotonic_s());
    wait(0.01);
  }
  link_.close();
}

Expected<void> Session::run() {
  std::optional<Departure> departure;
  PauseRequest pause;
  while (!program::should_stop()) {
    const double now_s = program::monotonic_s();
    link_.pump(now_s);
    send_pictures();  // Here the lane is free, if ever: what is drawn next adds its own message.
    for (const auto& text : link_.take_messages()) program::say(fmt::format("{}: {}", options_.name, text));
    if (link_.refusal()) return tl::unexpected(*link_.refusal());
    if (link_.finished()) {
      say_goodbye();
      return pictures_.finish();
    }
    if (departure) {
      // Drawing pauses: a server that had dropped this screen is to get the request as soon as it is back.
      if (departure->is_in_vain(link_, now_s)) break;
      wait(0.005);
      continue;
    }
    Expected<void> drawn;
    if (link_.welcome()) drawn = take_welcome();
    if (drawn && display_) {
      using enum Display::Leaving;
      const auto leaving = display_->poll_leaving();
      const bool can_ask = !link_.server_is_gone() && !link_.welcome()->lockstep;
      const bool is_paused = link_.notice().paused || pause.is_pausing();
      if (leaving == closed || (leaving == escape && !can_ask) ||
          ((leaving == enter || leaving == restart) && is_paused)) {
        using How = control::Quit::How;
        departure.emplace(leaving == closed    ? How::window_closed
                          : leaving == restart ? How::restart
                                               : How::escape,
                          now_s);
        continue;
      }
      if (leaving == escape) pause.toggle(link_);
      pause.tell(link_);
      if (link_.server_is_gone())
        drawn = draw_lost(now_s);
      else if (link_.welcome()->lockstep)
        drawn = draw_lockstep();
      else
        drawn = draw_real_time(now_s);
    }
    if (!drawn) return drawn;
    if (!display_ || link_.welcome()->lockstep) wait(link_.has_backlog() ? 0.0 : 0.005);
  }
  link_.close();
  return pictures_.finish();
}

}  // namespace

Expected<void> run_screen(const ScreenOptions& options) {
  program::catch_stop_signals();
  const auto identity = net::load_identity(options.keys / (options.name + ".key"));
  if (!identity) return tl::unexpected(identity.error());
  const auto server_key = net::load_public_key(options.keys / "server.public");
  if (!server_key) return tl::unexpected(server_key.error());
  std::error_code error;
  if (!options.pictures.empty()) std::filesystem::create_directories(options.pictures, error);
  if (error) return failure(error.message(), options.pictures.string(), "choose a folder that can be written");
  const net::Address any{net::is_loopback(options.server) ? net::loopback_ip : 0, 0};
  auto lane_socket = net::UdpSocket::open({any});
  if (!lane_socket) return tl::unexpected(lane_socket.error());
  auto tick_socket = net::UdpSocket::open({any});
  if (!tick_socket) return tl::unexpected(tick_socket.error());
  const std::uint16_t tick_port = tick_socket->local_address().port;
  net::SecureClientOptions lane{options.server, *server_key, *identity, {}};
  if (options.is_virtual)
    lane.limits.timeout_s = 10.0;  // On a slow machine a server may be silent for seconds and go on.
  Session session(options, std::move(*lane_socket), std::move(*tick_socket),
                  {options.name, tick_port, std::move(lane)});
  return session.run();
}

}  // namespace septet::screen
