#include "logging/study/report/pool.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "logging/session/session_reader.hpp"

namespace septet::logging {
namespace {

constexpr double between_drives_s = 10.0;

struct Opened {
  std::filesystem::path path;
  SessionReader reader;
  Subject subject;
  std::string label;
};

std::string label_of(const Subject& subject) {
  if (subject.part.empty() || subject.condition.empty()) return subject.part + subject.condition;
  return subject.part + ' ' + subject.condition;
}

/// Answers and playing time.
Expected<void> take_answers(const Opened& session, PooledDrive& pooled) {
  auto answers = session.reader.questionnaire();
  if (!answers) return tl::unexpected(answers.error());
  leave_out_impossible(*answers, pooled.measures.impossible);
  for (const QuestionnaireRecord& answer : *answers) {
    if (answer.item == "playing_time") {
      pooled.playing_time = ObservedTime{answer.observed_s, !answer.censored};
      pooled.reason = answer.reason;
    } else if (answer.item == "drive_completed") {
      // A drop-out is the moment at which the driver stopped.
      pooled.playing_time = ObservedTime{answer.observed_s, answer.censored};
      pooled.reason = answer.reason;
    } else if (answer.value) {
      pooled.answers[answer.item] = *answer.value;
    }
  }
  return {};
}

/// Answers of the drives that are the person's own.
void take_agreed(PooledSubject& pooled) {
  if (std::ranges::adjacent_find(pooled.drives, std::ranges::not_equal_to{}, &PooledDrive::order) !=
      pooled.drives.end())
    pooled.subject.order.clear();
  std::map<std::string, std::vector<double>> values;
  std::vector<const PooledDrive*> timed;
  for (const PooledDrive& drive : pooled.drives) {
    for (const auto& [item, value] : drive.answers) values[item].push_back(value);
    if (drive.playing_time) timed.push_back(&drive);
  }
  for (const auto& [item, own] : values)
    if (std::ranges::adjacent_find(own, std::ranges::not_equal_to{}) == own.end()) pooled.answers[item] = own.front();
  const auto differ = [](const PooledDrive* a, const PooledDrive* b) {
    return a->playing_time->time_s != b->playing_time->time_s || a->playing_time->stopped != b->playing_time->stopped ||
           a->reason != b->reason;
  };
  if (timed.empty() || std::ranges::adjacent_find(timed, differ) != timed.end()) return;
  pooled.playing_time = timed.front()->playing_time;
  pooled.reason = timed.front()->reason;
}

Expected<PooledDrive> pool_drive(const std::vector<const Opened*>& sessions, const MeasureSettings& settings) {
  PooledDrive drive;
  drive.label = sessions.front()->label;
  drive.order = sessions.front()->subject.order;
  DriveRecords all;
  for (const Opened* session : sessions) {
    auto records = read_drive_records(session->reader);
    if (!records) return tl::unexpected(records.error());
    append(all, std::move(*records));
    drive.sessions.push_back(session->path);
    drive.ended_cleanly = drive.ended_cleanly && session->reader.ended_cleanly();
    const auto& seeds = session->reader.info().seeds;
    if (const auto seed = seeds.find("drive"); seed != seeds.end()) drive.seeds.push_back(seed->second);
  }
  drive.measures = compute_drive_measures(all, settings);
  for (const Opened* session : sessions)
    if (auto taken = take_answers(*session, drive); !taken) return tl::unexpected(taken.error());
  return drive;
}

}  // namespace

void append(DriveRecords& all, DriveRecords next) {
  if (all.samples.empty() && all.inputs.empty() && all.events.empty()) {
    all = std::move(next);
    return;
  }
  Tick last = 0;
  if (!all.samples.empty()) last = std::max(last, all.samples.back().tick);
  if (!all.inputs.empty()) last = std::max(last, all.inputs.back().tick);
  if (!all.events.empty()) last = std::max(last, all.events.back().tick);
  const Tick later = last + static_cast<Tick>(between_drives_s * all.ticks_per_second);
  const double later_s = static_cast<double>(later) / all.ticks_per_second;
  for (Sample& sample : next.samples) {
    sample.tick += later;
    sample.simulated_time_s += later_s;
  }
  for (InputRecord& input : next.inputs) input.tick += later;
  for (Event& event : next.events) {
    event.tick += later;
    event.simulated_time_s += later_s;
  }
  all.speed_limits_mps.resize(all.samples.size());
  next.speed_limits_mps.resize(next.samples.size());
  const auto move_behind = [](auto& target, auto& source) {
    target.insert(target.end(), std::make_move_iterator(source.begin()), std::make_move_iterator(source.end()));
  };
  move_behind(all.samples, next.samples);
  move_behind(all.inputs, next.inputs);
  move_behind(all.events, next.events);
  move_behind(all.speed_limits_mps, next.speed_limits_mps);
  all.impossible.samples += next.impossible.samples;
  all.impossible.inputs += next.impossible.inputs;
  if (all.impossible.first.empty()) all.impossible.first = std::move(next.impossible.first);
  all.car_width_m = std::max(all.car_width_m, next.car_width_m);  // Parts of one drive belong to one car.
}

Expected<std::vector<PooledSubject>> pool_sessions(std::span<const std::filesystem::path> sessions,
                                                   const MeasureSettings& settings) {
  std::map<std::string, std::vector<Opened>> by_participant;
  for (const auto& path : sessions) {
    auto reader = SessionReader::open(path);
    if (!reader) return tl::unexpected(reader.error());
    Subject subject = subject_of(reader->info());
    if (subject.participant.empty())
      subject.participant = path.has_parent_path() ? path.parent_path().string() : path.string();
    const std::string label = label_of(subject), participant = subject.participant;
    by_participant[participant].push_back({path, std::move(*reader), std::move(subject), label});
  }
  std::vector<PooledSubject> subjects;
  for (const auto& [participant, opened] : by_participant) {
    PooledSubject pooled;
    pooled.subject = opened.front().subject;
    const auto& other = opened.front().reader.info().other;
    if (const auto driver = other.find("driver"); driver != other.end()) pooled.driver = driver->second;
    std::vector<std::string> labels;
    for (const Opened& session : opened)
      if (std::ranges::find(labels, session.label) == labels.end()) labels.push_back(session.label);
    for (const auto& label : labels) {
      std::vector<const Opened*> of_label;
      for (const Opened& session : opened)
        if (session.label == label) of_label.push_back(&session);
      auto drive = pool_drive(of_label, settings);
      if (!drive) return tl::unexpected(drive.error());
      pooled.drives.push_back(std::move(*drive));
    }
    take_agreed(pooled);
    subjects.push_back(std::move(pooled));
  }
  return subjects;
}

std::vector<std::string> items_of(std::span<const PooledSubject> subjects, const std::string& label) {
  std::set<std::string> items;
  for (const PooledSubject& subject : subjects)
    for (const PooledDrive& drive : subject.drives)
      if (drive.label == label)
        for (const auto& answer : drive.answers) items.insert(answer.first);
  return {items.begin(), items.end()};
}

std::vector<std::string> labels_of(std::span<const PooledSubject> subjects) {
  std::vector<std::string> labels;
  for (const PooledSubject& subject : subjects)
    for (const PooledDrive& drive : subject.drives)
      if (std::ranges::find(labels, drive.label) == labels.end()) labels.push_back(drive.label);
  return labels;
}

std::vector<std::string> groups_of(std::span<const PooledSubject> subjects) {
  std::vector<std::string> groups;
  for (const PooledSubject& subject : subjects)
    if (std::ranges::find(groups, subject.subject.group) == groups.end()) groups.push_back(subject.subject.group);
  return groups;
}

}  // namespace septet::logging
