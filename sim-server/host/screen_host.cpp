#include "sim-server/host/screen_host.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet::server {

using namespace control;

namespace {

constexpr std::size_t scene_bytes_per_pump =
    1024 * 1024;  // Before packing, shared by all screens: a tick is not held up.
constexpr double deaf_after_s = 0.5, hung_after_s = 0.25;
constexpr double strangers_told_every_s = 10.0;

Bytes to_bytes(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::uint64_t instance_of(const net::SessionId& session) {
  std::uint64_t number = 0;
  std::memcpy(&number, session.data(), sizeof number);
  return number;
}

std::string other_protocol(std::uint16_t theirs) {
  return fmt::format(
      "it speaks version {} of the control messages, the server version {}; run the same Septet on all machines",
      theirs, protocol_version);
}

/// Keeps the earliest moments and the newest ones of a screen that reconnects all day.
void remember(std::vector<double>& moments_s, double now_s) {
  if (moments_s.size() == most_moments) moments_s.erase(moments_s.begin() + most_moments / 2);
  moments_s.push_back(now_s);
}

void pump_scene(replication::ReplicationServer& scene, net::SecureServer& lane, net::ClientId client,
                std::size_t most_bytes) {
  scene.pump(client, most_bytes, [&](std::span<const std::byte> message) {
    const auto sent = lane.send(client, control::scene_message(message), net::Reliability::reliable);
    return sent == net::SendResult::queued;
  });
}

/// In lockstep the next tick waits for a screen that lacks this one's baseline, however long it was silent before.
net::BaselineOptions baselines_for(bool lockstep) {
  if (!lockstep) return {};
  constexpr double forever_s = std::numeric_limits<double>::infinity();
  return {.silence_s = forever_s, .patience_s = forever_s};
}

/// True if lockstep need not wait for this screen at `tick`.
bool keeps_up(const HostedScreen& screen, Tick tick) {
  if (screen.left_behind) return true;
  if (!screen.live()) return !screen.expected;
  if (screen.joined_at && tick <= *screen.joined_at) return screen.scene_arrived;
  return screen.has_presented && screen.presented >= tick;
}

}  // namespace

ScreenHost::ScreenHost(net::DatagramSocket& lane_socket, net::DatagramSocket& tick_socket, const scene::Store& store,
                       ScreenHostOptions options)
    : options_(std::move(options)),
      lane_(lane_socket, {options_.identity, options_.session, options_.allowed, options_.limits}),
      publisher_(tick_socket, options_.identity, options_.session, {options_.max_datagram_bytes, true}),
      every_tick_(tick_socket, options_.identity, options_.session, {options_.max_datagram_bytes, true}, publisher_),
      baselines_(baselines_for(options_.welcome.lockstep)),
      store_(store),
      scene_(store, instance_of(options_.session)),
      planner_(options_.least_playout_delay_s, 1.0 / options_.welcome.tick_rate_hz) {
  if (options_.welcome.group_ip != 0)
    publisher_.add_destination({options_.welcome.group_ip, options_.welcome.group_port});
  for (const auto& name : options_.screens) screens_.push_back({.name = name});
}

HostedScreen* ScreenHost::screen_of(net::ClientId client) {
  const auto found = std::ranges::find(screens_, std::optional(client), &HostedScreen::client);
  return found == screens_.end() ? nullptr : &*found;
}

void ScreenHost::send(net::ClientId client, const ControlMessage& message) {
  lane_.send(client, net::share(encode_control(message)), net::Reliability::reliable);
}

void ScreenHost::pump(double now_s) {
  for (const net::ServerEvent& event : lane_.pump(now_s)) {
    switch (event.kind) {
      case net::ServerEvent::Kind::connected:
        on_connected(event, now_s);
        break;
      case net::ServerEvent::Kind::disconnected:
        on_disconnected(event.client, event.reason, now_s);
        break;
      case net::ServerEvent::Kind::message:
        on_message(event, now_s);
        break;
      case net::ServerEvent::Kind::refused:
        messages_.push_back("refused a client: " + event.reason);
        break;
    }
  }
  tell_of_strangers(now_s);
  if (options_.car)
    if (const auto feedback = options_.car->take_feedback(); feedback && car_client_)
      lane_.send(*car_client_, net::share(encode_control(*feedback)), net::Reliability::unreliable);
  const std::vector<net::ClientId> clients = lane_.clients();
  for (const net::ClientId client : clients) pump_scene(scene_, lane_, client, scene_bytes_per_pump / clients.size());
  events_.pump([&](std::uint32_t hearer, const DriveEvent& event) { send(hearer, event); });
  if (options_.welcome.group_ip != 0) send_unicast_to_the_deaf(now_s);
}

/// Sends ticks by unicast to a screen that speaks on its lane but acknowledges no tick: it does not receive the group,
/// because of a switch or a firewall.
void ScreenHost::send_unicast_to_the_deaf(double now_s) {
  for (HostedScreen& screen : screens_) {
    if (!screen.client || !screen.unanswered_since_s || unicast_.contains(*screen.client)) continue;
    const auto* info = lane_.info(*screen.client);
    if (!info) continue;
    // A silent screen hangs or has gone; its time counts from when it is heard again.
    if (now_s - info->heard_s > hung_after_s) screen.unanswered_since_s = now_s;
    if (now_s - *screen.unanswered_since_s < deaf_after_s) continue;
    add_unicast(*screen.client, screen.tick_port);
    // Its missing acknowledgements were counted against it; a new start lets it acknowledge.
    baselines_.leave(*screen.client);
    baselines_.join(*screen.client, now_s);
    messages_.push_back(
        fmt::format("screen {} acknowledges no multicast tick: it gets its ticks by unicast", screen.name));
  }
}

void ScreenHost::look_at(const std::set<std::string>& names, double now_s) {
  constexpr double again_after_s = 1.0;
  for (HostedScreen& screen : screens_) {
    const bool is_looked_at = names.contains(screen.name);
    if (!is_looked_at && screen.asked_to_look_s) {
      screen.asked_to_look_s.reset();
      screen.large_picture.reset();
      if (screen.client) send(*screen.client, Look{false});
    }
    if (!is_looked_at || !screen.client || (screen.asked_to_look_s && now_s - *screen.asked_to_look_s < again_after_s))
      continue;
    screen.asked_to_look_s = now_s;
    send(*screen.client, Look{true});
  }
}

void ScreenHost::add_unicast(net::ClientId client, std::uint16_t port) {
  const auto* info = lane_.info(client);
  if (!info) return;
  const net::Address destination{info->address.ip, port};
  if (const auto before = unicast_.find(client); before != unicast_.end()) remove_destination(before->second);
  unicast_[client] = destination;
  const bool is_told_every_tick = options_.welcome.lockstep && watchers_.contains(client);
  (is_told_every_tick ? every_tick_ : publisher_).add_destination(destination);
}

void ScreenHost::remove_destination(const net::Address& destination) {
  publisher_.remove_destination(destination);
  every_tick_.remove_destination(destination);
}

net::Rights ScreenHost::rights_of(const std::string& name) const {
  const auto listed = std::ranges::find(options_.allowed, name, &net::AllowedClient::name);
  return listed == options_.allowed.end() ? net::Rights{} : listed->rights;
}

bool ScreenHost::is_of_the_rig(const std::string& name) const {
  return name == car_client_name || std::ranges::find(screens_, name, &HostedScreen::name) != screens_.end();
}

void ScreenHost::on_connected(const net::ServerEvent& event, double now_s) {
  clients_[event.client] = event.name;
  scene_.connect(event.client, event.name);
  for (HostedScreen& screen : screens_)
    if (screen.name == event.name && !screen.client) screen.expected = true;
  if (!is_of_the_rig(event.name))
    tell(event.client,
         fmt::format("{} connected, which is no screen of this rig: it reads the world{}", event.name,
                     rights_of(event.name).edit ? " and " + net::describe(rights_of(event.name)) : std::string()),
         now_s);
}

void ScreenHost::on_message(const net::ServerEvent& event, double now_s) {
  // Messages from before another connection took its place arrive late, and are ignored.
  if (!clients_.contains(event.client)) return;
  baselines_.heard(event.client, now_s);
  switch (lane_of(event.bytes).value_or(LaneMessage::control)) {
    case LaneMessage::scene:
      on_scene(event, now_s);
      break;
    case LaneMessage::control:
      if (const auto message = decode_control(event.bytes))
        on_control(event.client, *message, now_s);
      else
        lane_.disconnect(event.client, message.error().what);
  }
}

void ScreenHost::on_scene(const net::ServerEvent& event, double now_s) {
  auto batch = scene_.receive(event.client, std::span(event.bytes).subspan(1));
  if (!batch) {
    lane_.disconnect(event.client, batch.error().what);
    return;
  }
  if (batch->changes.empty()) return;
  const std::string& name = clients_.at(event.client);
  const auto rights = rights_of(name).edit;
  SceneRequest request{
      event.client, {name, rights.value_or(net::EditRights{}), scene_.own_ids(event.client)}, std::move(*batch)};
  if (!rights)
    return refuse_scene(
        request, fmt::format("the key of {0} may look, not edit: allowed-clients needs `KEY {0} edit`", name), now_s);
  if (request.batch.has_too_many)
    return refuse_scene(request,
                        fmt::format("it has more than {} changes, and is done whole between two ticks: send it in "
                                    "several batches",
                                    replication::most_changes_of_batch),
                        now_s);
  std::size_t& waiting = edits_waiting_[event.client];
  if (request.batch.changes.size() > most_edits - waiting)
    return refuse_scene(request, fmt::format("{} changes wait for this tick already: send fewer", waiting), now_s);
  waiting += request.batch.changes.size();
  scene_requests_.push_back(std::move(request));
}

std::vector<SceneRequest> ScreenHost::take_scene_requests() {
  edits_waiting_.clear();
  return std::exchange(scene_requests_, {});
}

void ScreenHost::refuse_scene(const SceneRequest& request, const std::string& why, double now_s) {
  refuse_scene(request, replication::Refusal{{{0, {}, why}}, 0}, now_s);
}

void ScreenHost::refuse_scene(const SceneRequest& request, replication::Refusal refusal, double now_s) {
  const replication::Failure& first = refusal.failures.front();
  const auto& changes = request.batch.changes;
  const std::string_view what = first.index < changes.size() ? scene::name_of(changes[first.index]) : "nothing";
  const std::uint64_t more = refusal.failures.size() - 1 + refusal.others;
  const std::uint64_t refused = ++refused_changes_[request.editor.name];
  if (clients_.contains(request.client))
    tell(request.client,
         fmt::format(
             "{}: nothing of its {}{} changes of the scene was done, for command {} ({}): {}{}; refused so far: {}",
             request.editor.name, request.batch.has_too_many ? "more than " : "", changes.size(), first.index + 1, what,
             first.why, more == 0 ? "" : fmt::format("; {} more could not be done", more), refused),
         now_s);
  scene_.refuse(request.client, request.batch.number, std::move(refusal));
}

void ScreenHost::on_operator_line(net::ClientId client, const OperatorLine& line) {
  OperatorRequest request{client, clients_.at(client), line.number, line.line};
  const net::Rights rights = rights_of(request.name);
  const bool undoes = line.line == "undo";
  if (!rights.may_operate && !(undoes && rights.edit)) {
    const auto [deed, word] =
        undoes ? std::pair("undo, as it changes nothing", "edit") : std::pair("operate", "operate");
    return answer(
        request,
        fmt::format("the key of {0} may not {1}: allowed-clients needs `KEY {0} … {2}`", request.name, deed, word), 0);
  }
  if (operator_requests_.size() >= most_operator_lines)
    return answer(request, "too many lines wait for this tick already: send fewer", 0);
  operator_requests_.push_back(std::move(request));
}

void ScreenHost::answer(const OperatorRequest& request, const std::optional<std::string>& why_not, Tick tick) {
  if (!clients_.contains(request.client)) return;
  // The line may have changed the scene: who is answered has that already.
  pump_scene(scene_, lane_, request.client, scene_bytes_per_pump);
  send(request.client, OperatorAnswer{request.number, tick, why_not.value_or("")});
}

void ScreenHost::on_control(net::ClientId client, const ControlMessage& message, double now_s) {
  if (const auto* hello = std::get_if<Hello>(&message)) return on_hello(client, *hello, now_s);
  if (const auto* car = std::get_if<CarHello>(&message)) return on_car_hello(client, *car, now_s);
  if (const auto* report = std::get_if<CarReport>(&message)) {
    if (car_client_ == client) options_.car->device.receive(report->number, to_bytes(report->report), report->problem);
    return;
  }
  if (const auto* line = std::get_if<OperatorLine>(&message)) return on_operator_line(client, *line);
  if (std::holds_alternative<HearEvents>(message) && watchers_.contains(client))
    return send(client, EventsFrom{events_.join(client)});
  HostedScreen* screen = screen_of(client);
  if (const auto* arrived = std::get_if<TickArrived>(&message); arrived && watchers_.contains(client))
    return arrived->lost_baseline ? baselines_.join(client, now_s)
                                  : baselines_.acknowledge(client, arrived->tick, now_s);
  if (!screen) return;
  if (const auto* arrived = std::get_if<TickArrived>(&message)) {
    screen->unanswered_since_s.reset();
    if (arrived->lost_baseline) {
      ++screen->lost_baselines;
      return baselines_.join(client, now_s);
    }
    baselines_.acknowledge(client, arrived->tick, now_s);
    planner_.observe(arrived->lateness_s, now_s);
  } else if (std::holds_alternative<SceneArrived>(message)) {
    screen->scene_arrived = true;
  } else if (const auto* presented = std::get_if<Presented>(&message)) {
    if (!screen->has_presented)
      tell(client,
           fmt::format("screen {} shows tick {}, {:.2f} s after it connected", screen->name, presented->tick,
                       now_s - screen->joined_s),
           now_s);
    // A screen cannot have shown a tick that was not sent.
    const Tick newest = sent_.empty() ? 0 : sent_.back()->snapshot().tick;
    if (const auto begun = std::ranges::find(begun_s_, presented->tick, &std::pair<Tick, double>::first);
        begun != begun_s_.end() && screen->has_presented && presented->tick > screen->presented)
      screen->report_to_picture.add(now_s - begun->second);
    screen->presented = std::max(screen->presented, std::min(presented->tick, newest));
    screen->has_presented = true;
    screen->left_behind = false;
    ++screen->frames;
    screen->frame_ms = presented->frame_ms;
  } else if (const auto* controls = std::get_if<Controls>(&message)) {
    if (options_.drivers.contains(screen->name)) controls_ = controls->input;
  } else if (const auto* quit = std::get_if<Quit>(&message)) {
    using enum Quit::How;
    end_requested_ = quit->how == escape    ? logging::DriveEnd::escape
                     : quit->how == restart ? logging::DriveEnd::restart
                                            : logging::DriveEnd::window_closed;
  } else if (const auto* pause = std::get_if<Pause>(&message)) {
    pause_requested_ = pause->paused;
  } else if (const auto* thumbnail = std::get_if<Thumbnail>(&message)) {
    screen->thumbnail = std::make_shared<const std::string>(thumbnail->picture);
    screen->thumbnail_tick = thumbnail->tick;
  } else if (const auto* large = std::get_if<LargePicture>(&message)) {
    // A picture that arrives after the last viewer has left is dropped.
    if (screen->asked_to_look_s) screen->large_picture = std::make_shared<const std::string>(large->picture);
  } else if (const auto* report = std::get_if<ScreenReport>(&message)) {
    screen->report = *report;
  }
}

void ScreenHost::on_hello(net::ClientId client, const Hello& hello, double now_s) {
  const auto screen = std::ranges::find(screens_, hello.screen, &HostedScreen::name);
  const std::string& name = clients_.at(client);
  if (hello.protocol != protocol_version) return refuse(client, other_protocol(hello.protocol), now_s);
  if (hello.screen != name)
    return refuse(
        client,
        fmt::format("its key is called \"{}\" in allowed-clients, so it cannot be screen \"{}\"", name, hello.screen),
        now_s);
  if (screen == screens_.end() && rights_of(name).may_look) return begin_to_watch(client, hello, now_s);
  if (screen == screens_.end()) return refuse(client, fmt::format("the rig has no screen \"{}\"", hello.screen), now_s);
  // A screen that was killed and started again is heard before its old connection times out: the new connection takes
  // its place.
  if (screen->client && *screen->client != client) {
    const net::ClientId old = *screen->client;
    on_disconnected(old, "replaced by a new connection", now_s);
    lane_.disconnect(old, "replaced by a new connection");
  }
  screen->client = client;
  screen->expected = screen->scene_arrived = screen->has_presented = screen->left_behind = false;
  ++screen->joined;
  remember(screen->connected_s, simulated_time_s());
  screen->joined_s = now_s;
  screen->joined_at = sent_.empty() ? std::nullopt : std::optional(sent_.back()->snapshot().tick);
  baselines_.join(client, now_s);
  screen->tick_port = hello.tick_port;
  screen->unanswered_since_s.reset();
  if (options_.welcome.group_ip == 0) add_unicast(client, hello.tick_port);
  tell(client, fmt::format("screen {} connected", hello.screen), now_s);
  send(client, options_.welcome);
  send(client, notice_);
}

/// Its ticks come by unicast: it need not be able to hear the rig's group.
void ScreenHost::begin_to_watch(net::ClientId client, const Hello& hello, double now_s) {
  watchers_.insert(client);
  baselines_.join(client, now_s);
  add_unicast(client, hello.tick_port);
  Welcome welcome = options_.welcome;
  welcome.group_ip = 0;
  welcome.thumbnails = false;
  send(client, welcome);
}

void ScreenHost::on_car_hello(net::ClientId client, const CarHello& hello, double now_s) {
  const std::string& name = clients_.at(client);
  if (hello.protocol != protocol_version) return refuse(client, other_protocol(hello.protocol), now_s);
  if (!options_.car)
    return refuse(client,
                  "the rig's car is not on another machine (its [car] has no machine, or a simulated driver drives)",
                  now_s);
  if (name != car_client_name)
    return refuse(client, fmt::format("its key is called \"{}\" in allowed-clients, so it cannot be the car", name),
                  now_s);
  car_client_ = client;
  options_.car->device.lose("septet-car has connected and has not read its device yet");
  tell(client, "the car connected", now_s);
  send(client, CarWelcome{options_.welcome.rig});
}

void ScreenHost::refuse(net::ClientId client, const std::string& reason, double now_s) {
  const auto* info = lane_.info(client);
  tell(client,
       fmt::format("refused the client {} at {}: {}", clients_.at(client), info ? net::to_text(info->address) : "?",
                   reason),
       now_s);
  send(client, Refusal{printable(reason)});
}

void ScreenHost::tell(net::ClientId client, const std::string& text, double now_s) {
  if (auto said = limits_[clients_.at(client)].take(printable(text), now_s)) messages_.push_back(std::move(*said));
}

/// Reports datagrams from senders without a key, and damaged ones: an attack, a wrong server.public, another program on
/// the port.
void ScreenHost::tell_of_strangers(double now_s) {
  if (now_s - told_s_ < strangers_told_every_s) return;
  told_s_ = now_s;
  const net::ChannelCounters now = lane_.counters();
  // Counters of a connection that failed to open disappear with it.
  const auto rise = [](std::uint64_t after, std::uint64_t before) { return after > before ? after - before : 0; };
  const auto forged = rise(now.forged, told_.forged), malformed = rise(now.malformed, told_.malformed),
             cookies = rise(now.bad_cookies, told_.bad_cookies);
  told_ = now;
  if (forged + malformed + cookies == 0) return;
  messages_.push_back(
      fmt::format("datagrams that were refused in {:.0f} s: {} forged or sealed for another server's key, {} "
                  "malformed, {} with a bad cookie",
                  strangers_told_every_s, forged, malformed, cookies));
}

void ScreenHost::on_disconnected(net::ClientId client, const std::string& reason, double now_s) {
  const auto known = clients_.find(client);
  if (known == clients_.end()) return;
  for (HostedScreen& screen : screens_)
    if (screen.name == known->second) screen.expected = false;
  scene_.disconnect(client);
  baselines_.leave(client);
  if (const auto destination = unicast_.find(client); destination != unicast_.end()) {
    remove_destination(destination->second);
    unicast_.erase(destination);
  }
  watchers_.erase(client);
  events_.leave(client);
  if (!is_of_the_rig(known->second)) tell(client, fmt::format("the client {} left: {}", known->second, reason), now_s);
  if (car_client_ == client) {
    tell(client, fmt::format("the car left: {}", reason), now_s);
    options_.car->device.lose("the connection to septet-car was lost");
    car_client_.reset();
  }
  if (HostedScreen* screen = screen_of(client)) {
    tell(client, fmt::format("screen {} left: {}", screen->name, reason), now_s);
    screen->client.reset();
    screen->scene_arrived = false;
    if (!is_finishing_) remember(screen->left_s, simulated_time_s());
  }
  clients_.erase(known);
}

void ScreenHost::publish(std::shared_ptr<const TakenSnapshot> taken, double now_s) {
  send_tick(std::move(taken), now_s, true);
  for (HostedScreen& screen : screens_)
    if (screen.live() && !screen.unanswered_since_s) screen.unanswered_since_s = now_s;
}

void ScreenHost::publish_to_watchers(std::shared_ptr<const TakenSnapshot> taken, double now_s) {
  if (!every_tick_.destinations().empty()) send_tick(std::move(taken), now_s, false);
}

void ScreenHost::send_tick(std::shared_ptr<const TakenSnapshot> taken, double now_s, bool is_for_screens) {
  baselines_.advance_to(now_s);
  const WireSnapshot* baseline = nullptr;
  if (const auto tick = baselines_.baseline()) {
    const auto found = std::ranges::find(sent_, *tick, [](const auto& sent) { return sent->snapshot().tick; });
    if (found != sent_.end()) baseline = &(*found)->wire();
  }
  Bytes payload;
  ByteWriter writer(payload);
  TickHeader header = planner_.header(now_s, taken->snapshot().simulated_time_s);
  header.scene_revision = store_.revision();
  header.events = events_.count();
  put_tick_header(writer, header);
  encode_snapshot(taken->wire(), baseline, payload);
  last_tick_bytes_ = payload.size();
  if (is_for_screens) publisher_.publish(taken->snapshot().tick, payload);
  if (!every_tick_.destinations().empty()) every_tick_.publish(taken->snapshot().tick, payload);
  constexpr std::size_t most_begun = 480;  // Four seconds: a screen that shows a tick later has been away.
  if (!options_.welcome.lockstep) begun_s_.emplace_back(taken->snapshot().tick, now_s);
  if (begun_s_.size() > most_begun) begun_s_.pop_front();
  sent_.push_back(std::move(taken));
  if (sent_.size() > net::BaselineOptions{}.history) sent_.pop_front();
}

std::vector<std::string> ScreenHost::missing() const {
  std::vector<std::string> names;
  for (const HostedScreen& screen : screens_)
    if (!screen.live() || !screen.scene_arrived) names.push_back(screen.name);
  if (options_.car && !car_client_) names.push_back("the car");
  return names;
}

bool ScreenHost::all_presented(Tick tick) const {
  return std::ranges::all_of(screens_, [&](const HostedScreen& screen) { return keeps_up(screen, tick); });
}

void ScreenHost::leave_behind(Tick tick) {
  for (HostedScreen& screen : screens_)
    if (!keeps_up(screen, tick)) leave_behind(screen, tick);
}

void ScreenHost::leave_silent_behind(Tick tick, double since_s) {
  for (HostedScreen& screen : screens_) {
    if (keeps_up(screen, tick) || !screen.live() || !screen.has_presented) continue;
    const auto* info = lane_.info(*screen.client);
    if (!info || info->heard_s < since_s) leave_behind(screen, tick);
  }
}

void ScreenHost::leave_behind(HostedScreen& screen, Tick tick) {
  screen.left_behind = true;
  remember(screen.left_behind_s, simulated_time_s());
  messages_.push_back(fmt::format("screen {} has not shown tick {}: the others go on without it", screen.name, tick));
}

std::optional<DriverInput> ScreenHost::take_controls() { return std::exchange(controls_, std::nullopt); }

void ScreenHost::give_notice(const Notice& notice) {
  if (notice == notice_) return;
  notice_ = notice;
  for (const HostedScreen& screen : screens_)
    if (screen.client) send(*screen.client, notice_);
}

void ScreenHost::restart_shown_time() {
  planner_ = PlayoutPlanner(options_.least_playout_delay_s, 1.0 / options_.welcome.tick_rate_hz);
}

void ScreenHost::finish(const std::string& reason) {
  is_finishing_ = true;
  for (const auto& screen : screens_)
    if (screen.client) send(*screen.client, Finish{reason});
  if (car_client_) send(*car_client_, Finish{reason});
  for (const net::ClientId watcher : watchers_) send(watcher, Finish{reason});
}

bool ScreenHost::all_reported() const {
  return std::ranges::all_of(screens_, [](const HostedScreen& screen) { return !screen.live() || screen.report; });
}

const std::vector<HostedScreen>& screens_of(const ScreenHost* host) {
  static const std::vector<HostedScreen> none;
  return host ? host->screens() : none;
}

}  // namespace septet::server
