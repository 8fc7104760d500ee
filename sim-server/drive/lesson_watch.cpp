#include "sim-server/drive/lesson_watch.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace septet::server {
namespace {

constexpr std::size_t samples_a_job = 10;  // One second's worth.
constexpr std::size_t most_pictures = 20;  // One a second: longer than any fault takes to settle.

}  // namespace

LessonWatch::LessonWatch(logging::Lesson lesson)
    : lesson_(std::move(lesson)), so_far_(lesson_), thread_(2, [this](Job& job) { return mark(job); }) {
  so_far_.shortest_s = 0.0;
}

page::LessonFacts LessonWatch::facts() const {
  page::LessonFacts facts{
      .title = lesson_.title, .aim = lesson_.aim, .pass_mark = lesson_.pass_mark, .shortest_s = lesson_.shortest_s};
  for (const logging::LessonTask& task : lesson_.tasks)
    facts.tasks.push_back({task.says, std::string(name_of(task.measure)), std::string(unit_of(task.measure)),
                           task.bound, is_at_most(task.measure)});
  return facts;
}

void LessonWatch::add(const logging::Sample& sample) {
  new_samples_.push_back(sample);
  if (new_samples_.size() < samples_a_job || !thread_.is_idle()) return;
  thread_.give_if_idle({std::exchange(new_samples_, {}), std::exchange(new_events_, {})});
}

void LessonWatch::finish() {
  if (!thread_.give({std::exchange(new_samples_, {}), std::exchange(new_events_, {})})) return;
  [[maybe_unused]] const auto done = thread_.wait();
}

void LessonWatch::add_still(double simulated_s, std::shared_ptr<const std::string> picture) {
  pictures_.emplace_back(simulated_s, std::move(picture));
  if (pictures_.size() > most_pictures) pictures_.pop_front();
}

Expected<void> LessonWatch::mark(Job& job) {
  samples_.insert(samples_.end(), job.samples.begin(), job.samples.end());
  events_.insert(events_.end(), std::make_move_iterator(job.events.begin()), std::make_move_iterator(job.events.end()));
  if (samples_.empty()) return {};
  const double now_s = samples_.back().simulated_time_s;
  Found found{logging::mark_lesson(so_far_, samples_, events_), logging::find_faults(lesson_, samples_, events_)};
  std::erase_if(found.faults, [&](const logging::LessonFault& fault) {
    return fault.from_s + logging::settles_s(lesson_.tasks[fault.task].measure) > now_s;
  });
  const std::lock_guard lock(mutex_);
  found_ = std::move(found);
  return {};
}

std::shared_ptr<const page::LessonView> LessonWatch::view() {
  std::optional<Found> found;
  {
    const std::lock_guard lock(mutex_);
    found.swap(found_);
  }
  if (found) take_over(*found);
  return view_;
}

void LessonWatch::take_over(const Found& found) {
  page::LessonView view{.tasks = {}, .mark = found.marks.mark, .passed = found.marks.passed, .faults = {}};
  for (const logging::TaskMark& task : found.marks.tasks)
    view.tasks.push_back({task.mark, std::string(name_of(task.severity)), task.faults});
  for (std::size_t i = 0; i < view.tasks.size(); ++i)
    view.tasks[i].faults = static_cast<std::size_t>(std::ranges::count(found.faults, i, &logging::LessonFault::task));
  for (const logging::LessonFault& fault : found.faults) {
    page::LessonFaultView& told = told_[{fault.task, fault.from_s}];
    if (told.number == 0) {
      told.number = ++faults_;
      const auto nearest = std::ranges::min_element(
          pictures_, {}, [&](const auto& picture) { return std::abs(picture.first - fault.worst_s); });
      if (nearest != pictures_.end()) told.still = nearest->second;
    }
    told.task = fault.task;
    told.from_s = fault.from_s;
    told.to_s = fault.to_s;
    told.worst = fault.worst;
    told.at = fault.worst_at;
    told.severity = name_of(fault.severity);
    view.faults.push_back(told);
  }
  view_ = std::make_shared<const page::LessonView>(std::move(view));
}

}  // namespace septet::server
