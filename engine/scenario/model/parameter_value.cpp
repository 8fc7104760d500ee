#include "engine/scenario/model/parameter_value.hpp"

#include <cctype>
#include <cmath>
#include <limits>

#include "engine/scenario/model/expression.hpp"

namespace septet::scenario {
namespace {

bool is_whole(std::string_view value, double low, double high) {
  const auto number = parse_number(value);
  return number && *number == std::floor(*number) && *number >= low && *number <= high;
}

/// "2026-01-31T12:00:00", with any fractions and time zone behind it.
bool is_date_time(std::string_view value) {
  constexpr std::string_view form = "0000-00-00T00:00:00";
  if (value.size() < form.size()) return false;
  for (std::size_t i = 0; i < form.size(); ++i) {
    const bool digit = std::isdigit(static_cast<unsigned char>(value[i])) != 0;
    if (form[i] == '0' ? !digit : value[i] != form[i]) return false;
  }
  return true;
}

template <class Value>
bool compare(Rule rule, const Value& left, const Value& right) {
  switch (rule) {
    case Rule::equal:
      return left == right;
    case Rule::not_equal:
      return left != right;
    case Rule::less:
      return left < right;
    case Rule::less_or_equal:
      return left <= right;
    case Rule::greater:
      return left > right;
    case Rule::greater_or_equal:
      return left >= right;
  }
  return false;
}

}  // namespace

bool is_of_type(std::string_view value, std::string_view type) {
  if (type == "double") return parse_number(value).has_value();
  if (type == "integer" || type == "int")
    return is_whole(value, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  if (type == "unsignedInt") return is_whole(value, 0.0, std::numeric_limits<unsigned>::max());
  if (type == "unsignedShort") return is_whole(value, 0.0, std::numeric_limits<unsigned short>::max());
  if (type == "boolean") return value == "true" || value == "false" || value == "1" || value == "0";
  return type != "dateTime" || is_date_time(value);
}

bool compare_values(Rule rule, std::string_view left, std::string_view right) {
  const auto left_number = parse_number(left), right_number = parse_number(right);
  if (left_number && right_number) return compare(rule, *left_number, *right_number);
  return compare(rule, left, right);
}

}  // namespace septet::scenario
