#include "sim-server/drive/operator_desk.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/simulation/car_faults.hpp"
#include "engine/simulation/effects/effects_stage.hpp"
#include "engine/simulation/operator_command.hpp"
#include "logging/study/questionnaire.hpp"
#include "program/child_process.hpp"
#include "program/resources.hpp"
#include "sim-server/drive/kept_state.hpp"
#include "sim-server/drive/operated.hpp"
#include "sim-server/drive/told_on_page.hpp"
#include "sim-server/page/request_checks.hpp"

namespace septet::server {
namespace {

constexpr double show_every_s = 0.1;

bool changes_world(const page::OperatorWish& wish) {
  return std::holds_alternative<page::Change>(wish.wish) || std::holds_alternative<page::Edit>(wish.wish);
}

/// The scale for the driver's well-being. Without it the drive goes on, and the page does not ask.
std::optional<DriverRating> find_rating() {
  const auto file = program::find_resource("misc", "scenarios/questionnaires", ".toml");
  if (!file) return std::nullopt;
  const auto text = read_regular_file(*file);
  if (!text) return std::nullopt;
  const auto rating = logging::read_questionnaire(*text, file->string()).and_then(DriverRating::of);
  return rating ? std::optional(*rating) : std::nullopt;
}

/// The rules for the marks, if the drive is a lesson. They were checked when the drive was loaded.
std::unique_ptr<LessonWatch> find_lesson(const LoadedDrive& loaded) {
  const auto source = std::ranges::find(loaded.sources, logging::lesson_role, &logging::SourceFile::role);
  if (source == loaded.sources.end()) return nullptr;
  auto lesson = logging::read_lesson(source->content, source->name);
  return lesson ? std::make_unique<LessonWatch>(std::move(*lesson)) : nullptr;
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
  for (const std::string_view fault : simulation::fault_names()) facts.faults.emplace_back(fault);
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
                     .thumbnail = screen.thumbnail,
                     .large_picture = screen.large_picture});
  return views;
}

}  // namespace

Expected<std::unique_ptr<OperatorDesk>> OperatorDesk::open(const ServerOptions& options, const LoadedDrive& loaded,
                                                           WorldGate& gate) {
  const LiveDrive& drive = gate.drive();
  page::PageOptions page_options{.port = static_cast<std::uint16_t>(options.page_port.value_or(0)),
                                 .allowed_hosts = options.page_hosts};
  if (options.page_handover) {
    auto listening = page::ListeningSocket::take(options.page_handover->files);
    if (!listening) return tl::unexpected(listening.error());
    page_options.listening.emplace(std::move(*listening));
  }
  page_options.token = options.page_handover ? options.page_handover->token : page::random_token();
  auto rating = find_rating();
  auto lesson = find_lesson(loaded);
  page::DriveFacts facts = facts_of(options, loaded, rating);
  if (lesson) facts.lesson = lesson->facts();
  Speaker speaker(program::find_program("espeak-ng"));
  facts.speaks = speaker.is_there();
  auto no_restart = why_no_restart(options);
  if (!no_restart) facts.kept_states = {drive.state().time_s(), state_kept_every_s};
  auto placing = std::make_unique<Placing>(
      gate, *loaded.model,
      std::vector{std::filesystem::path(options.scenario).parent_path(), std::filesystem::path(".")}, options.out);
  facts.placing = placing->facts();
  auto page = page::OperatorPage::open(std::move(page_options), std::move(facts), loaded.model->roads);
  if (!page) return tl::unexpected(page.error());
  std::unique_ptr<OperatorDesk> desk(new OperatorDesk(std::move(*page), std::move(rating), std::move(lesson),
                                                      std::move(speaker), std::move(placing), loaded, gate));
  desk->no_restart_ = std::move(no_restart);
  return desk;
}

void OperatorDesk::log_to(SessionLog& log) {
  log_ = &log;
  log.watch(
      [this](const logging::Sample& sample) {
        way_back_.add(sample);
        if (lesson_) lesson_->add(sample);
      },
      [this](const logging::Event& event) {
        if (lesson_) lesson_->add(event);
        if (auto told = told_on_page(event)) page_->tell(*told);
      });
}

/// True if a watched screen has sent a large picture since the last call.
bool OperatorDesk::has_new_large_picture(const std::vector<HostedScreen>& screens) {
  std::vector<std::shared_ptr<const std::string>> pictures;
  pictures.reserve(screens.size());
  for (const HostedScreen& screen : screens) pictures.push_back(screen.large_picture);
  if (pictures == large_pictures_) return false;
  large_pictures_ = std::move(pictures);
  return true;
}

/// Takes the newest picture of the screen ahead, for the stills of faults.
void OperatorDesk::keep_still(const std::vector<HostedScreen>& screens) {
  if (!lesson_) return;
  const auto ahead = std::ranges::find(screens, rig::screen_ahead(loaded_.rig).name, &HostedScreen::name);
  if (ahead == screens.end() || !ahead->thumbnail || ahead->thumbnail == seen_ahead_) return;
  seen_ahead_ = ahead->thumbnail;
  lesson_->add_still(static_cast<double>(ahead->thumbnail_tick) / simulation::tick_rate_hz, seen_ahead_);
}

void OperatorDesk::attend(const std::shared_ptr<const TakenSnapshot>& newest, const std::string& what,
                          const std::vector<HostedScreen>& screens, double now_s, bool is_being_drawn) {
  newest_ = newest ? newest : drive_.first();
  now_s_ = now_s;
  from_ = gate_.shown_from(what);
  if (brake_until_s_ && now_s > *brake_until_s_) hold_brake({}, false);
  if (const auto trouble = speaker_.attend(); trouble && log_) log_->record_message("screen", *trouble);
  std::vector<page::OperatorWish> wishes = std::exchange(waiting_, {});
  for (page::OperatorWish& wish : page_->take_wishes()) wishes.push_back(std::move(wish));
  for (page::OperatorWish& wish : wishes) {
    if (is_being_drawn && changes_world(wish))
      waiting_.push_back(std::move(wish));
    else
      answer(wish);
  }
  // Two large pictures within one interval are both shown: a watched screen moves at the rate at which it is sent.
  if (!has_new_large_picture(screens) && shown_s_ && now_s - *shown_s_ < show_every_s) return;
  if (!shown_s_ || now_s - since_s_ >= 1.0) {
    const double time_s = drive_.state().time_s();
    if (shown_s_) real_time_factor_ = (time_s - since_time_s_) / (now_s - since_s_);
    since_s_ = now_s;
    since_time_s_ = time_s;
  }
  shown_s_ = now_s;
  keep_still(screens);
  show(what, screens, now_s);
}

void OperatorDesk::show(const std::string& what, const std::vector<HostedScreen>& screens, double now_s) {
  page::DriveView view{.newest = newest_,
                       .phase = what,
                       .is_paused = is_paused_,
                       .wall_s = now_s,
                       .real_time_factor = real_time_factor_,
                       .has_actuators = drive_.has_actuators(),
                       .fault = drive_.actuators_cut(),
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
  view.instructor_brakes = brake_until_s_.has_value();
  for (std::size_t fault = 0; fault < simulation::fault_names().size(); ++fault)
    view.faults.push_back(simulation::has_failed(fault, drive_.state()));
  if (lesson_) view.lesson = lesson_->view();
  view.placed = placing_->view();
  view.triggers = simulation::triggers(loaded_.model->scenario, scenario);
  view.hazards = simulation::settable_hazards(loaded_.model->scenario, scenario);
  page_->show(std::move(view));
}

void OperatorDesk::show_end(const std::string& text, const std::vector<HostedScreen>& screens, double now_s) {
  if (!newest_) newest_ = drive_.first();
  if (rating_ && log_)
    for (auto& row : rating_->unanswered(begun_s_, drive_.state().time_s())) log_->record_answer(std::move(row));
  if (lesson_) lesson_->finish();
  show(text, screens, now_s);
}

std::optional<logging::DriveEnd> OperatorDesk::end_requested() const {
  if (!is_ended_) return std::nullopt;
  return restart_at_s_ ? logging::DriveEnd::restart : logging::DriveEnd::by_operator;
}

void OperatorDesk::answer(const page::OperatorWish& wish) {
  if (const auto* near = std::get_if<page::FindNear>(&wish.wish))
    return page_->answer_found(wish, placing_->near({near->x_m, near->y_m}, near->within_m));
  if (const auto* saving = std::get_if<page::SaveEdits>(&wish.wish)) {
    const auto file = placing_->save(saving->name);
    if (!file) return page_->answer(wish, file.error().what);
    note(wish, "operator", "save_edits " + file->filename().string());
    return page_->answer_saved(wish, file->string());
  }
  page_->answer(wish, fulfil(wish));
}

/// Executes a request; returns the reason for a refusal.
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
    if (std::exchange(is_ended_, true)) return "the drive is ending already";
    note(wish, "operator", (end->participant_stops ? "end participant_stops=1 reason=" : "end reason=") + end->reason);
    if (end->participant_stops && log_) log_->record_answer(logging::drop_out(drive_.state().time_s(), end->reason));
  } else if (const auto* changed = std::get_if<page::Change>(&wish.wish)) {
    return change(wish, changed->command);
  } else if (const auto* edited = std::get_if<page::Edit>(&wish.wish)) {
    return edit(wish, edited->lines);
  } else if (const auto* brake = std::get_if<page::Brake>(&wish.wish)) {
    return hold_brake(wish, brake->held);
  } else if (const auto* back = std::get_if<page::Back>(&wish.wish)) {
    return put_back(wish, back->seconds);
  } else if (const auto* again = std::get_if<page::Restart>(&wish.wish)) {
    return restart(wish, again->at_s);
  } else if (const auto* word = std::get_if<page::Say>(&wish.wish)) {
    return say(wish, *word);
  } else if (const auto* rated = std::get_if<page::Rate>(&wish.wish)) {
    return rate(wish, rated->value);
  } else {
    return "a drive goes on";
  }
  return std::nullopt;
}

/// Releases the brake by itself for a browser that is gone or hangs.
std::optional<std::string> OperatorDesk::hold_brake(const page::OperatorWish& wish, bool held) {
  constexpr double silence_s = 1.0;
  const bool was_held = brake_until_s_.has_value();
  brake_until_s_ = held ? std::optional(now_s_ + silence_s) : std::nullopt;
  if (held == was_held) return std::nullopt;
  drive_.brake(held ? 1.0 : 0.0);
  note(wish, "operator", held ? "brake" : "brake_off");
  return std::nullopt;
}

std::optional<std::string> OperatorDesk::put_back(const page::OperatorWish& wish, double seconds) {
  const auto place = way_back_.place(seconds, drive_.state().time_s());
  if (!place) return "the car was in no lane then";
  return change(wish, simulation::text_of(*place));
}

std::optional<std::string> OperatorDesk::restart(const page::OperatorWish& wish, double at_s) {
  if (no_restart_) return no_restart_;
  if (at_s > drive_.state().time_s()) return "the drive has not come so far";
  if (at_s > 0.0 && at_s < begun_s_) return "this drive began later";
  if (std::exchange(is_ended_, true)) return "the drive is ending already";
  restart_at_s_ = at_s;
  note(wish, "operator", fmt::format("restart at_s={}", at_s));
  return std::nullopt;
}

std::optional<std::string> OperatorDesk::say(const page::OperatorWish& wish, const page::Say& word) {
  // Time that a driving person needs to read a sentence.
  constexpr double least_s = 6.0, most_s = 15.0, a_character_s = 0.12;
  if (word.text.find_first_not_of(" \t\r\n") == std::string::npos) return "there is no word";
  word_ = word.text;
  word_until_s_ = now_s_ + std::clamp(a_character_s * static_cast<double>(word.text.size()), least_s, most_s);
  if (word.aloud) speaker_.say(word.text, word.language);
  note(wish, "word", word.text);
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
  const auto done = do_command(text, {wish.name, the_page()}, from_, gate_);
  if (!done) return done.error().what;
  if (!done->empty()) note(wish, "operator", *done);
  return std::nullopt;
}

std::optional<std::string> OperatorDesk::edit(const page::OperatorWish& wish, const std::string& lines) {
  if (auto done = placing_->take(lines, from_); !done) return done.error().what;
  note(wish, "operator", "edit " + printable(lines));
  return std::nullopt;
}

void OperatorDesk::note(const page::OperatorWish& wish, const std::string& kind, const std::string& what) {
  if (log_) note_operator(wish.name, kind, what, *log_);
}

}  // namespace septet::server
