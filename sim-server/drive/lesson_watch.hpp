#pragma once
/// A lesson while it is driven: marks so far, and faults as they happen, each with what the screen ahead showed.
///
/// The drive's thread hands over samples, events and pictures and takes what is known; marking is done on a thread of its own, once a
/// simulated second, for it looks at the whole drive each time. Whoever hands over never waits.

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/job_thread.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "sim-server/page/drive_view.hpp"

namespace septet::server {

class LessonWatch {
 public:
  explicit LessonWatch(logging::Lesson lesson);

  page::LessonFacts facts() const;
  /// Each sample, ascending; whenever a second of them is there, it is marked.
  void add(const logging::Sample& sample);
  void add(const logging::Event& event) { new_events_.push_back(event); }
  /// What the screen ahead showed at that time: a picture of any bytes, not null.
  void add_still(double simulated_s, std::shared_ptr<const std::string> picture);
  /// The newest that is known; null before the first second was marked. Another one whenever it changes.
  std::shared_ptr<const page::LessonView> view();
  /// Marks what was handed over and waits for that.
  void finish();

 private:
  /// What has been handed over since the last job.
  struct Job {
    std::vector<logging::Sample> samples;
    std::vector<logging::Event> events;
  };
  struct Found {
    logging::LessonMarks marks;
    std::vector<logging::LessonFault> faults;  ///< That nothing to come can excuse.
  };
  Expected<void> mark(Job& job);
  void take_over(const Found& found);

  const logging::Lesson lesson_;
  logging::Lesson so_far_;  ///< The same without a shortest time: a mark from the first second on.
  std::vector<logging::Sample> new_samples_;
  std::vector<logging::Event> new_events_;
  std::deque<std::pair<double, std::shared_ptr<const std::string>>> pictures_;  ///< Of the last seconds, ascending.
  std::map<std::pair<std::size_t, double>, page::LessonFaultView> told_;        ///< By task and beginning.
  std::uint32_t faults_ = 0;
  std::shared_ptr<const page::LessonView> view_;
  // The marking thread's own.
  std::vector<logging::Sample> samples_;
  std::vector<logging::Event> events_;
  // Handed over between the two.
  std::mutex mutex_;
  std::optional<Found> found_;
  JobThread<Job> thread_;  ///< Last: it is gone before the rest.
};

}  // namespace septet::server
