#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/core/printable.hpp"
#include "engine/document/table_reader.hpp"
#include "engine/document/toml_table.hpp"
#include "logging/study/lesson/lesson.hpp"

namespace septet::logging {
namespace {

constexpr const char* lesson_document = "docs/lessons.md";
constexpr std::size_t most_tasks = 100;

struct MeasureName {
  LessonMeasure measure;
  std::string_view name, unit;
};
constexpr std::array measure_names{
    MeasureName{LessonMeasure::speed, "speed", "km/h"},     MeasureName{LessonMeasure::gap, "gap", "s"},
    MeasureName{LessonMeasure::position, "position", "m"},  MeasureName{LessonMeasure::indicator, "indicator", "s"},
    MeasureName{LessonMeasure::mirror, "mirror", "s"},      MeasureName{LessonMeasure::lookout, "lookout", "s"},
    MeasureName{LessonMeasure::stop, "stop", "m"},          MeasureName{LessonMeasure::hazard, "hazard", "s"},
    MeasureName{LessonMeasure::collision, "collision", ""}, MeasureName{LessonMeasure::yielding, "yielding", "s"},
    MeasureName{LessonMeasure::turn, "turn", "s"},          MeasureName{LessonMeasure::limit, "limit", "km/h"},
    MeasureName{LessonMeasure::braking, "braking", "m/s²"}, MeasureName{LessonMeasure::perception, "perception", "s"},
};

LessonTask read_task(const toml::table& table, std::string_view file, std::set<std::string>& taken, Error& error) {
  document::TableReader reader(table, file, "task", error);
  LessonTask task;
  task.id = reader.get_string("id", "");
  if (task.id.empty() || !printable_characters(task.id) || task.id.size() > 60 || !taken.insert(task.id).second)
    reader.report("id", fmt::format("the id is \"{}\"", printable(task.id, 60)), "give each task a word of its own");
  task.says = reader.get_string("says", "");
  if (task.says.empty() || !printable_characters(task.says))
    reader.report("says", "the task tells the learner nothing", "give a sentence, on one line");
  std::vector<std::string_view> names;
  names.reserve(measure_names.size());
  for (const auto& each : measure_names) names.push_back(each.name);
  if (!table.contains("measure")) reader.report("measure", "the task measures nothing", "give its measure");
  task.measure = measure_names[reader.get_choice("measure", 0, names)].measure;
  task.bound = reader.get_double("bound", 0.0, 0.0, 1e6);
  task.tolerance = reader.get_double("tolerance", 1.0, 1e-6, 1e6);
  task.weight = reader.get_double("weight", 1.0, 0.0, 1e6);
  task.from_s = reader.get_double("from_s", 0.0, 0.0, 1e9);
  task.to_s = reader.get_double("to_s", 1e9, 0.0, 1e9);
  reader.finish(lesson_document);
  return task;
}

}  // namespace

std::string_view name_of(LessonMeasure measure) {
  return std::ranges::find(measure_names, measure, &MeasureName::measure)->name;
}

std::string_view unit_of(LessonMeasure measure) {
  return std::ranges::find(measure_names, measure, &MeasureName::measure)->unit;
}

Expected<Lesson> read_lesson(std::string_view text, std::string_view name) {
  const auto table = document::parse_toml(text, name);
  if (!table) return tl::unexpected(table.error());
  Error error;
  document::TableReader reader(*table, name, "lesson", error);
  Lesson lesson;
  lesson.title = reader.get_string("title", "");
  lesson.aim = reader.get_string("aim", "");
  lesson.pass_mark = reader.get_double("pass_mark", 6.0, 0.0, 10.0);
  lesson.shortest_s = reader.get_double("shortest_s", 0.0, 0.0, 1e6);
  std::set<std::string> taken;
  const auto tasks = reader.get_tables("task");
  if (tasks.empty() || tasks.size() > most_tasks)
    reader.report("task", "the lesson marks nothing, or more than a hundred things", "give each its [[task]]");
  else
    for (const toml::table* task : tasks) lesson.tasks.push_back(read_task(*task, name, taken, error));
  reader.finish(lesson_document);
  if (!error.what.empty()) return tl::unexpected(std::move(error));
  return lesson;
}

}  // namespace septet::logging
