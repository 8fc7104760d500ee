#include "command-line/command/input_table.hpp"

#include <array>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "engine/document/table_line.hpp"
#include "engine/math/angle_units.hpp"

namespace septet::server {
namespace {

constexpr std::size_t most_rows = 1'000'000;
constexpr double radians_per_degree = 1.0 / degrees_per_radian;

struct Column {
  std::string_view name;
  double low, high;
  void (*set)(vehicle::TimedInput&, double);
};
constexpr std::array<Column, 7> columns{{
    {"time_s", -1e6, 1e6, [](vehicle::TimedInput& row, double value) { row.time_s = value; }},
    {"steering_wheel_deg", -1500.0, 1500.0,
     [](vehicle::TimedInput& row, double value) { row.input.steering_wheel_rad = value * radians_per_degree; }},
    {"accelerator", 0.0, 1.0, [](vehicle::TimedInput& row, double value) { row.input.accelerator = value; }},
    {"brake", 0.0, 1.0, [](vehicle::TimedInput& row, double value) { row.input.brake = value; }},
    {"clutch", 0.0, 1.0, [](vehicle::TimedInput& row, double value) { row.input.clutch = value; }},
    {"gear", -1.0, 10.0,
     [](vehicle::TimedInput& row, double value) {
       row.input.selector = GearSelector::manual;
       row.input.gear = static_cast<std::int8_t>(std::lround(value));
     }},
    {"parking_brake", 0.0, 1.0, [](vehicle::TimedInput& row, double value) { row.input.parking_brake = value > 0.5; }},
}};

std::string known_columns() {
  std::string known;
  for (const Column& column : columns) known += (known.empty() ? "" : ", ") + std::string(column.name);
  return known;
}

Expected<std::vector<const Column*>> read_header(const std::vector<std::string_view>& cells, const std::string& where) {
  std::vector<const Column*> header;
  bool has_time = false;
  for (const std::string_view cell : cells) {
    const Column* found = nullptr;
    for (const Column& column : columns)
      if (column.name == cell) found = &column;
    if (!found) return failure(fmt::format("\"{}\" is no column", cell.substr(0, 60)), where, "use " + known_columns());
    has_time |= found == &columns[0];
    header.push_back(found);
  }
  if (!has_time) return failure("there is no column time_s", where, "use " + known_columns());
  return header;
}

}  // namespace

Expected<std::vector<vehicle::TimedInput>> read_input_table(std::string_view text, std::string_view name) {
  std::vector<const Column*> header;
  std::vector<vehicle::TimedInput> rows;
  document::TableLines lines(text);
  while (const auto line = lines.next()) {
    const std::string where = fmt::format("{}:{}", name, line->number);
    const auto& cells = line->cells;
    if (header.empty()) {
      auto read = read_header(cells, where);
      if (!read) return tl::unexpected(read.error());
      header = std::move(*read);
      continue;
    }
    if (cells.size() != header.size())
      return failure(fmt::format("{} numbers for {} columns", cells.size(), header.size()), where,
                     "give each column one");
    vehicle::TimedInput row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = document::number_in<double>(cells[i]);
      if (!value || !(*value >= header[i]->low && *value <= header[i]->high))
        return failure(fmt::format("{} is \"{}\"", header[i]->name, cells[i].substr(0, 60)), where,
                       fmt::format("give a number from {:g} to {:g}", header[i]->low, header[i]->high));
      header[i]->set(row, *value);
    }
    if (!rows.empty() && row.time_s <= rows.back().time_s)
      return failure(fmt::format("time_s {} follows {}", row.time_s, rows.back().time_s), where,
                     "give ascending times");
    if (rows.size() == most_rows)
      return failure(fmt::format("has more than {} rows", most_rows), where,
                     "give fewer: between rows inputs change evenly");
    rows.push_back(row);
  }
  if (rows.size() < 2)
    return failure("has fewer than two rows of inputs", std::string(name),
                   "name the columns in the first line, then give one line for each time");
  return rows;
}

}  // namespace septet::server
