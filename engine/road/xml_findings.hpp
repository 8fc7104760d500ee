#pragma once
/// Reads attributes of XML that may be wrong, and collects the faults. Used by the reader only.
///
/// Every returned value is usable: after an error it is a harmless one, so that the reader continues and finds the
/// rest.

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/road/opendrive_reader.hpp"

namespace pugi {
class xml_node;
}

namespace septet::road {

class XmlFindings {
 public:
  XmlFindings(std::string_view text, std::string_view name);

  /// `rule`: the standard's broken checker rule, if there is one.
  void error(const pugi::xml_node& node, std::string what, std::string remedy, std::string_view rule = {});
  void warning(const pugi::xml_node& node, std::string what, std::string remedy, std::string_view rule = {});
  /// An error at a byte of the text, for text that is not XML at all.
  void error_at(std::ptrdiff_t offset, std::string what, std::string remedy, std::string_view rule = {});
  void warning_at(std::ptrdiff_t offset, std::string what, std::string remedy);

  /// "name:line, <element>", as in errors.
  std::string where(const pugi::xml_node& node) const;

  bool has_error() const { return first_error_.has_value(); }
  const Error& first_error() const { return *first_error_; }
  /// Sorted by line; at most 1,000, the last of them says so.
  std::vector<Finding> findings() const;

  static constexpr double largest_number = 1e12;
  /// A finite number within ±most (road_limits.hpp). Missing or beyond: an error and 0.
  double number(const pugi::xml_node& node, const char* attribute, double most = largest_number);
  /// A finite number; missing or empty: the fallback.
  double number_or(const pugi::xml_node& node, const char* attribute, double fallback, double most = largest_number);
  /// A number of at least 0; missing or empty: the fallback; "nan": a warning and the fallback; below 0: a warning and
  /// 0.
  double amount_or(const pugi::xml_node& node, const char* attribute, double fallback, double most = largest_number);
  /// A whole number in ±10,000 (lane ids). Missing or wrong: an error and an empty result.
  std::optional<int> integer(const pugi::xml_node& node, const char* attribute);
  /// A required text. Missing or empty: an error.
  std::string text(const pugi::xml_node& node, const char* attribute);

 private:
  void add(Severity severity, int line, std::string_view element, std::string what, std::string remedy,
           std::string_view rule);
  std::string where(int line, std::string_view element) const;
  int line_of(std::ptrdiff_t offset) const;

  std::string name_;
  std::vector<std::size_t> line_starts_;
  std::vector<Finding> findings_;
  std::optional<Error> first_error_;
};

}  // namespace septet::road
