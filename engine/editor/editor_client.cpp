#include "engine/editor/editor_client.hpp"

#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "engine/control/control_message.hpp"
#include "engine/core/whole_file.hpp"
#include "engine/editor/content_ahead.hpp"
#include "engine/editor/edit_verbs.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/net/udp_socket.hpp"
#include "engine/replication/replication_client.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/scene/edit_file.hpp"

namespace septet::editor {
namespace {

constexpr double waits_at_once_s = 0.02;

net::UdpOptions beside(const net::Address& server) {
  return {{server.ip == net::loopback_ip ? net::loopback_ip : 0, 0}};
}

}  // namespace

struct EditorClient::State {
  State(EditPlace at, Clock now, double wait_s, net::UdpSocket to_server, net::UdpSocket for_ticks)
      : place(std::move(at)),
        clock(std::move(now)),
        within_s(wait_s),
        socket(std::move(to_server)),
        ticks(std::move(for_ticks)),
        lane(socket, {place.server, place.server_key, place.identity, {}}) {}

  void hear(const net::ClientEvent& event) {
    if (event.kind == net::ClientEvent::Kind::connected) {
      scene.connected();
      const control::Hello hello{place.name, ticks.local_address().port};
      lane.send(net::share(control::encode_control(hello)), net::Reliability::reliable);
    } else if (event.kind == net::ClientEvent::Kind::lost) {
      scene.disconnected();
      has_arrived = is_welcome = false;
    } else if (control::lane_of(event.bytes) == control::LaneMessage::scene) {
      if (auto received = scene.receive(std::span(event.bytes).subspan(1)); !received) trouble = received.error();
    } else if (const auto message = control::decode_control(event.bytes)) {
      if (std::holds_alternative<control::Welcome>(*message)) is_welcome = true;
      if (std::holds_alternative<control::Finish>(*message))
        trouble = Error{"the drive has ended", net::to_text(place.server), "start another one"};
      if (const auto* refusal = std::get_if<control::Refusal>(&*message))
        trouble = Error{"the server refuses this editor: " + refusal->reason, net::to_text(place.server),
                        "check the rights of its key in allowed-clients"};
    }
  }

  void pump() {
    for (const net::ClientEvent& event : lane.pump(clock())) hear(event);
    while (ticks.receive()) continue;  // Nobody reads them here, and a full socket would drop what comes later.
    if (lane.state() != net::ClientState::connected) return;
    scene.pump([&](std::span<const std::byte> message) {
      return lane.send(control::scene_message(message), net::Reliability::reliable) == net::SendResult::queued;
    });
    if (!scene.complete() || std::exchange(has_arrived, true)) return;
    const control::SceneArrived arrived{scene.complete_revision()};
    lane.send(net::share(control::encode_control(arrived)), net::Reliability::reliable);
  }

  bool is_ready() const { return is_welcome && has_arrived && scene.own_ids() != 0; }

  /// Pumps until `is_done`. Error: what ends this editor, or that it takes too long.
  Expected<void> until(const std::function<bool()>& is_done, const std::string& what) {
    const double until_s = clock() + within_s;
    const net::UdpSocket* const waiting[] = {&socket, &ticks};
    for (;;) {
      pump();
      if (trouble) return tl::unexpected(*trouble);
      if (is_done()) return {};
      if (clock() > until_s)
        return failure(what, net::to_text(place.server),
                       "check that the drive runs, that its list names this key, and that no other program holds it");
      net::wait_readable(waiting, waits_at_once_s);
    }
  }

  /// A new connection may have given other ids; what lines have named is in the mirror by then.
  void renew_names() {
    if (names.own_ids != scene.own_ids()) names = {scene.own_ids(), scene.own_ids()};
    names.fresh.clear();
    names.objects.clear();
    names.paints.worn.clear();
  }

  Expected<std::uint64_t> answer_of(std::uint64_t batch) {
    std::optional<Expected<std::uint64_t>> answer;
    const auto look = [&] {
      for (const replication::Done& done : scene.take_done())
        if (done.sequence == batch) answer = done.tick;
      for (const replication::Refused& refused : scene.take_refusals()) {
        if (refused.sequence != batch) continue;
        const replication::Failure& first = refused.refusal.failures.front();
        answer = failure(first.why, first.node, "change the line; nothing of its batch was done");
      }
      return answer.has_value() && scene.complete();
    };
    if (auto heard = until(look, "the server does not answer this editor"); !heard)
      return tl::unexpected(heard.error());
    return *answer;
  }

  EditPlace place;
  Clock clock;
  double within_s;
  net::UdpSocket socket, ticks;
  net::SecureClient lane;
  replication::ReplicationClient scene;
  EditNames names;
  scene::Store before;  ///< The scene as this editor found it.
  std::optional<Error> trouble;
  bool is_welcome = false, has_arrived = false;
};

Expected<std::unique_ptr<EditorClient>> EditorClient::connect(EditPlace place, Clock clock, double within_s) {
  auto socket = net::UdpSocket::open(beside(place.server));
  if (!socket) return tl::unexpected(socket.error());
  auto ticks = net::UdpSocket::open(beside(place.server));
  if (!ticks) return tl::unexpected(ticks.error());
  auto state =
      std::make_unique<State>(std::move(place), std::move(clock), within_s, std::move(*socket), std::move(*ticks));
  State& here = *state;
  if (auto ready = here.until([&] { return here.is_ready(); }, "the server does not let this editor in"); !ready)
    return tl::unexpected(ready.error());
  here.before = here.scene.store();
  return std::unique_ptr<EditorClient>(new EditorClient(std::move(state)));
}

Expected<std::unique_ptr<EditorClient>> EditorClient::connect(const std::filesystem::path& keys, Clock clock,
                                                              double within_s) {
  auto place = find_edit_place(keys, {}, {});
  if (!place) return tl::unexpected(place.error());
  return connect(std::move(*place), std::move(clock), within_s);
}

EditorClient::EditorClient(std::unique_ptr<State> state) : state_(std::move(state)) {}
EditorClient::~EditorClient() {
  state_->lane.close();
  state_->pump();
}

Expected<Taken> EditorClient::take(const std::vector<std::string>& lines, std::uint64_t tick) {
  if (auto whole = state_->until([&] { return state_->is_ready(); }, "the server is gone"); !whole)
    return tl::unexpected(whole.error());
  state_->renew_names();
  std::vector<scene::Command> commands;
  Taken taken;
  for (const std::string& line : lines) {
    const auto words = scene::words_of(line);
    if (!words) return tl::unexpected(words.error());
    if (words->empty()) continue;
    auto edit = edit_of(*words, state_->scene.store(), state_->names);
    if (!edit) return tl::unexpected(edit.error());
    commands.insert(commands.end(), std::make_move_iterator(edit->commands.begin()),
                    std::make_move_iterator(edit->commands.end()));
    taken.messages.insert(taken.messages.end(), edit->messages.begin(), edit->messages.end());
  }
  if (commands.empty()) return taken;
  SplitBatch split = split_content(commands);
  const auto ask = [&](const std::vector<scene::Command>& batch, std::uint64_t at) -> Expected<void> {
    const auto number = state_->scene.request_batch(batch, at);
    if (!number) return tl::unexpected(number.error());
    const auto shown_from = state_->answer_of(*number);
    if (!shown_from) return tl::unexpected(shown_from.error());
    taken.tick = *shown_from;
    return {};
  };
  for (const std::vector<scene::Command>& batch : split.ahead)
    if (auto done = ask(batch, 0); !done) return tl::unexpected(done.error());
  if (!split.rest.empty())
    if (auto done = ask(split.rest, tick); !done) return tl::unexpected(done.error());
  return taken;
}

Expected<void> EditorClient::save(const std::filesystem::path& file) {
  if (auto whole = state_->until([&] { return state_->scene.complete(); }, "the scene does not arrive"); !whole)
    return whole;
  const std::string text = scene::edits_between(state_->before, state_->scene.store());
  return write_whole_file(file, "edits", std::as_bytes(std::span(text)));
}

void EditorClient::pump() { state_->pump(); }
const scene::Store& EditorClient::scene() const { return state_->scene.store(); }

}  // namespace septet::editor
