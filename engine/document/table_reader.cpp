#include "engine/document/table_reader.hpp"

#include <cmath>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/document/toml_table.hpp"

namespace septet::document {

TableReader::TableReader(const toml::table& table, std::string_view file, std::string title, Error& error)
    : table_(table), file_(file), title_(std::move(title)), error_(error) {}

const toml::node* TableReader::find(std::string_view key) {
  known_.insert(std::string(key));
  return table_.get(key);
}

void TableReader::report(std::string_view key, std::string what, std::string remedy) {
  if (!error_.what.empty()) return;
  const toml::node* node = table_.get(key);
  const toml::node& place = node ? *node : static_cast<const toml::node&>(table_);
  error_ = {std::move(what), place_of(place, file_), std::move(remedy)};
}

std::string TableReader::get_string(std::string_view key, std::string fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (const auto value = node->value<std::string>()) return *value;
  report(key, fmt::format("{}.{} is not a text", title_, key), "put it in quotes");
  return fallback;
}

bool TableReader::get_bool(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (const auto value = node->value<bool>()) return *value;
  report(key, fmt::format("{}.{} is neither true nor false", title_, key), "write true or false");
  return fallback;
}

double TableReader::get_double(std::string_view key, double fallback, double low, double high) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  const auto value = node->value<double>();
  if (value && *value >= low && *value <= high) return *value;
  report(key, fmt::format("{}.{} is out of range", title_, key), fmt::format("give a number from {} to {}", low, high));
  return fallback;
}

std::int64_t TableReader::get_integer(std::string_view key, std::int64_t fallback, std::int64_t low,
                                      std::int64_t high) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  const auto value = node->value<std::int64_t>();
  if (value && *value >= low && *value <= high) return *value;
  report(key, fmt::format("{}.{} is out of range", title_, key),
         fmt::format("give a whole number from {} to {}", low, high));
  return fallback;
}

std::size_t TableReader::get_choice(std::string_view key, std::size_t fallback,
                                    const std::vector<std::string_view>& choices) {
  if (!find(key)) return fallback;
  const std::string text = get_string(key, "");
  std::string list;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (text == choices[i]) return i;
    list += (i ? ", " : "") + std::string(choices[i]);
  }
  report(key, fmt::format("{}.{} is \"{}\"", title_, key, text), "choose one of: " + list);
  return fallback;
}

Vec3 TableReader::get_point(std::string_view key) {
  const toml::node* node = find(key);
  const toml::array* array = node ? node->as_array() : nullptr;
  Vec3 point(0.0);
  bool good = array && array->size() == 3;
  for (int i = 0; good && i < 3; ++i) {
    const auto value = array->get(static_cast<std::size_t>(i))->value<double>();
    good = value && std::abs(*value) < 1000.0;
    point[i] = value.value_or(0.0);
  }
  if (good) return point;
  report(key, fmt::format("{}.{} is not a point", title_, key), "give three numbers in metres, [forward, left, up]");
  return Vec3(0.0);
}

std::vector<const toml::table*> TableReader::get_tables(std::string_view key) {
  std::vector<const toml::table*> tables;
  const toml::node* node = find(key);
  if (!node) return tables;
  if (const toml::array* array = node->as_array())
    for (const auto& element : *array)
      if (const toml::table* table = element.as_table()) tables.push_back(table);
  if (tables.empty())
    report(key, fmt::format("{}.{} is not a list of tables", title_, key), fmt::format("write [[{}]]", key));
  return tables;
}

const toml::array* TableReader::get_array(std::string_view key) {
  const toml::node* node = find(key);
  if (node && !node->is_array())
    report(key, fmt::format("{}.{} is no list", title_, key), fmt::format("write {} = [...]", key));
  return node ? node->as_array() : nullptr;
}

const toml::table* TableReader::get_table(std::string_view key) {
  const toml::node* node = find(key);
  return node ? node->as_table() : nullptr;
}

void TableReader::finish(std::string_view documented_in) {
  for (const auto& [key, node] : table_)
    if (!known_.contains(key.str()))
      report(key.str(), fmt::format("{} has no key \"{}\"", title_, key.str()),
             fmt::format("check its spelling against {}", documented_in));
}

}  // namespace septet::document
