#pragma once
/// A lesson during its drive: the marks so far, and faults as they happen, each with a picture of the screen ahead.
///
/// The drive's thread hands over samples, events and pictures and takes results, without ever waiting. Marking runs in
/// a thread of its own, once a simulated second, since each time it evaluates the whole drive.

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
  /// Adds a sample, in ascending order; after each second of them the drive is marked.
  void add(const logging::Sample& sample);
  void add(const logging::Event& event) { new_events_.push_back(event); }
  /// Adds a picture of the screen ahead at that time: any bytes, not null.
  void add_still(double simulated_s, std::shared_ptr<const std::string> picture);
  /// Newest result; null until the first second is marked. A new object whenever it changes.
  std::shared_ptr<const page::LessonView> view();
  /// Marks everything handed over, and waits for the result.
  void finish();

 private:
  /// Data handed over since the last job.
  struct Job {
    std::vector<logging::Sample> samples;
    std::vector<logging::Event> events;
  };
  struct Found {
    logging::LessonMarks marks;
    std::vector<logging::LessonFault> faults;  ///< Faults that later data cannot excuse.
  };
  Expected<void> mark(Job& job);
  void take_over(const Found& found);

  const logging::Lesson lesson_;
  logging::Lesson so_far_;  ///< The lesson without its minimum duration: gives a mark from the first second on.
  std::vector<logging::Sample> new_samples_;
  std::vector<logging::Event> new_events_;
  std::deque<std::pair<double, std::shared_ptr<const std::string>>> pictures_;  ///< From the last seconds, ascending.
  std::map<std::pair<std::size_t, double>, page::LessonFaultView> told_;        ///< By task and time of beginning.
  std::uint32_t faults_ = 0;
  std::shared_ptr<const page::LessonView> view_;
  // State of the marking thread.
  std::vector<logging::Sample> samples_;
  std::vector<logging::Event> events_;
  // Shared by the two threads.
  std::mutex mutex_;
  std::optional<Found> found_;
  JobThread<Job> thread_;  ///< Last member: its thread ends before the others are destroyed.
};

}  // namespace septet::server
