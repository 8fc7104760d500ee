#include "sim-server/drive/operator_desk.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "engine/core/regular_file.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "engine/simulation/operator_command.hpp"
#include "logging/questionnaire.hpp"
#include "program/resources.hpp"
#include "sim-server/page/request_checks.hpp"

namespace septet::server {
namespace {

constexpr double show_every_s = 0.1;

/// The scale by which the driver is asked how he feels. A drive without it goes on: the page does not ask.
std::optional<DriverRating> find_rating() {
  const auto file = program::find_resource("misc", "scenarios/questionnaires", ".toml");
  if (!file) return std::nullopt;
  const auto text = read_regular_file(*file);
  if (!text) return std::nullopt;
  const auto rating = logging::read_questionnaire(*text, file->string()).and_then(DriverRating::of);
  return rating ? std::optional(*rating) : std::nullopt;
}

page::DriveFacts facts_of(const ServerOptions& options, const LoadedDrive& loaded,
                          const std::optional<DriverRating>& rating) {
  page::DriveFacts facts{.scenario = std::filesystem::path(options.scenario).stem().string(),
                         .rig = loaded.rig.name,
                         .vehicle = loaded.vehicle_name(),
                         .participant = options.participant,
                         .seed = options.seed,
                         .tick_rate_hz = simulation::tick_rate_hz,
                         .planned_s = options.seconds,
                         .has_traffic = simulation::first_swarm(loaded.model->scenario) != nullptr,
                         .driver = simulation::driver_participant};
  if (rating)
    facts.rating = page::RatingScale{rating->title(), rating->item().text, rating->item().least, rating->item().labels};
  for (const std::string_view part : simulation::part_names()) facts.things.emplace_back(part);
  for (const auto& condition : simulation::conditions())
    facts.conditions.push_back({std::string(condition.name), condition.least, condition.most});
  return facts;
}

std::vector<page::ScreenView> view_of(const std::vector<HostedScreen>& screens) {
  std::vector<page::ScreenView> views;
  views.reserve(screens.size());
  for (const HostedScreen& screen : screens)
    views.push_back({.name = screen.name,
                     .live = screen.live(),
                     .frames = screen.frames,
                     .frame_ms = screen.frame_ms,
                     .presented = screen.has_presented ? std::optional(screen.presented) : std::nullopt,
                     .lost_baselines = screen.lost_baselines,
                     .drop_outs = screen.left_s.size(),
                     .thumbnail = screen.thumbnail});
  return views;
}

}  // namespace

Expected<std::unique_ptr<OperatorDesk>> OperatorDesk::open(const ServerOptions& options, const LoadedDrive& loaded,
                                                           LiveDrive& drive) {
  page::PageOptions page_options{.port = static_cast<std::uint16_t>(options.page_port.value_or(0)),
                                 .allowed_hosts = options.page_hosts};
  if (options.page_handover) {
    auto listening = page::ListeningSocket::take(options.page_handover->files);
    if (!listening) return tl::unexpected(listening.error());
    page_options.listening.emplace(std::move(*listening));
  }
  page_options.token = options.page_handover ? options.page_handover->token : page::random_token();
  auto rating = find_rating();
  auto page = page::OperatorPage::open(std::move(page_options), facts_of(options, loaded, rating), loaded.model->roads);
  if (!page) return tl::unexpected(page.error());
  auto desk = std::unique_ptr<OperatorDesk>(new OperatorDesk(std::move(*page), std::move(rating), loaded, drive));
  drive.watch_events([desk = desk.get()](const simulation::Event& event, double at_s) {
    desk->page_->tell(at_s, event.kind + ": " + event.detail);
  });
  return desk;
}

void OperatorDesk::attend(const std::shared_ptr<const TakenSnapshot>& newest, const std::string& what,
                          const std::vector<HostedScreen>& screens, double now_s) {
  newest_ = newest ? newest : drive_.first();
  for (const auto& wish : page_->take_wishes()) page_->answer(wish, fulfil(wish));
  if (shown_s_ && now_s - *shown_s_ < show_every_s) return;
  if (!shown_s_ || now_s - since_s_ >= 1.0) {
    const double time_s = drive_.state().time_s();
    if (shown_s_) real_time_factor_ = (time_s - since_time_s_) / (now_s - since_s_);
    since_s_ = now_s;
    since_time_s_ = time_s;
  }
  shown_s_ = now_s;
  show(what, screens, now_s);
}

void OperatorDesk::show(const std::string& what, const std::vector<HostedScreen>& screens, double now_s) {
  page::DriveView view{.newest = newest_,
                       .phase = what,
                       .is_paused = is_paused_,
                       .wall_s = now_s,
                       .real_time_factor = real_time_factor_,
                       .has_actuators = drive_.has_actuators(),
                       .actuators_cut = drive_.actuators_cut(),
                       .alarm = drive_.alarm(),
                       .leader = {},
                       .screens = view_of(screens)};
  if (const auto leader = find_leader(newest_->snapshot(), loaded_.model->roads))
    view.leader = {leader->participant, leader->distance_gap_m, leader->speed_mps};
  const auto& scenario = drive_.state().scenario;
  for (const auto& condition : simulation::conditions())
    view.conditions.push_back(simulation::value_of(condition, scenario));
  if (rating_) {
    view.rating.minute = DriverRating::minute_of(drive_.state().time_s());
    const auto answered = rating_->answers().find(view.rating.minute);
    if (answered != rating_->answers().end()) view.rating.value = answered->second;
  }
  for (auto& entity : simulation::hideable(*loaded_.model, scenario))
    view.entities.emplace_back(std::move(entity.name), entity.shown);
  for (const auto& piece : simulation::lying_pieces(drive_.state().effects))
    view.lying.push_back({piece.id, std::string(piece.part), piece.position_m.x, piece.position_m.y});
  view.triggers = simulation::triggers(loaded_.model->scenario, scenario);
  page_->show(std::move(view));
}

void OperatorDesk::show_end(const std::string& text, const std::vector<HostedScreen>& screens, double now_s) {
  if (!newest_) newest_ = drive_.first();
  if (rating_ && log_)
    for (auto& row : rating_->unanswered(drive_.state().time_s())) log_->record_answer(std::move(row));
  show(text, screens, now_s);
}

std::optional<logging::DriveEnd> OperatorDesk::end_requested() const {
  return is_ended_ ? std::optional(logging::DriveEnd::by_operator) : std::nullopt;
}

/// Nothing where it was done, else why not.
std::optional<std::string> OperatorDesk::fulfil(const page::OperatorWish& wish) {
  if (const auto* mark = std::get_if<page::Mark>(&wish.wish)) {
    note(wish, "mark", mark->note);
  } else if (std::holds_alternative<page::Pause>(wish.wish)) {
    if (is_paused_) return "it stands still already";
    is_paused_ = true;
    note(wish, "operator", "pause");
  } else if (std::holds_alternative<page::GoOn>(wish.wish)) {
    told_to_go_ = true;
    if (std::exchange(is_paused_, false)) note(wish, "operator", "go_on");
  } else if (std::holds_alternative<page::Rearm>(wish.wish)) {
    if (auto why_not = drive_.rearm_actuators(wish.name.empty() ? "operator" : wish.name)) return why_not;
    note(wish, "operator", "rearm");
  } else if (const auto* end = std::get_if<page::End>(&wish.wish)) {
    is_ended_ = true;
    note(wish, "operator", (end->participant_stops ? "end participant_stops=1 reason=" : "end reason=") + end->reason);
    if (end->participant_stops && log_) log_->record_answer(logging::drop_out(drive_.state().time_s(), end->reason));
  } else if (const auto* changed = std::get_if<page::Change>(&wish.wish)) {
    return change(wish, changed->command);
  } else if (const auto* rated = std::get_if<page::Rate>(&wish.wish)) {
    return rate(wish, rated->value);
  } else {
    return "a drive goes on";
  }
  return std::nullopt;
}

std::optional<std::string> OperatorDesk::rate(const page::OperatorWish& wish, int value) {
  if (!rating_) return "this drive has no scale for it";
  auto record = rating_->answer(drive_.state().time_s(), value);
  if (!record) return record.error().what;
  note(wish, "rating", fmt::format("{} value={}", record->item, value));
  if (log_) log_->record_answer(std::move(*record));
  return std::nullopt;
}

std::optional<std::string> OperatorDesk::change(const page::OperatorWish& wish, const std::string& text) {
  const auto command = simulation::parse_operator_command(text);
  if (!command) return command.error().what;
  if (auto done = drive_.command(*command); !done) return done.error().what;
  note(wish, "operator", simulation::text_of(*command));
  return std::nullopt;
}

void OperatorDesk::note(const page::OperatorWish& wish, const std::string& kind, const std::string& what) {
  const std::string by = wish.name.empty() ? "operator" : wish.name;
  if (log_) log_->record_message(kind, fmt::format("by={} {}={}", by, kind == "mark" ? "note" : "wish", what));
  page_->tell(drive_.state().time_s(), fmt::format("{}: {} ({})", kind, what, by));
}

}  // namespace septet::server
