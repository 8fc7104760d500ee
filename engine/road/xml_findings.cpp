#include "engine/road/xml_findings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <pugixml.hpp>

namespace septet::road {
namespace {

constexpr std::size_t most_findings = 1000;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// The whole text as a number, or empty.
template <class Number>
std::optional<Number> parse(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Number value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A text from the file, made fit for a message.
std::string shown(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 40)) result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return text.size() > 40 ? result + "…" : result;
}

}  // namespace

XmlFindings::XmlFindings(std::string_view text, std::string_view name) : name_(name), line_starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts_.push_back(i + 1);
  }
}

int XmlFindings::line_of(std::ptrdiff_t offset) const {
  if (offset < 0) return 0;
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), static_cast<std::size_t>(offset));
  return static_cast<int>(after - line_starts_.begin());
}

std::string XmlFindings::where(int line, std::string_view element) const {
  const std::string place = line > 0 ? fmt::format("{}:{}", name_, line) : name_;
  return element.empty() ? place : place + fmt::format(", <{}>", shown(element));
}

std::string XmlFindings::where(const pugi::xml_node& node) const {
  return where(line_of(node.offset_debug()), node.name());
}

void XmlFindings::add(Severity severity, int line, std::string_view element, std::string what, std::string remedy,
                      std::string_view rule) {
  Error error{std::move(what), where(line, element), std::move(remedy)};
  if (severity == Severity::error && !first_error_) first_error_ = error;
  if (findings_.size() < most_findings - 1) {
    findings_.push_back({severity, line, std::move(error), std::string(rule)});
  } else if (findings_.size() == most_findings - 1) {
    findings_.push_back({severity, line, {"there is more wrong than is listed here", name_, "repair these first"}});
  }
}

void XmlFindings::error(const pugi::xml_node& node, std::string what, std::string remedy, std::string_view rule) {
  add(Severity::error, line_of(node.offset_debug()), node.name(), std::move(what), std::move(remedy), rule);
}

void XmlFindings::warning(const pugi::xml_node& node, std::string what, std::string remedy, std::string_view rule) {
  add(Severity::warning, line_of(node.offset_debug()), node.name(), std::move(what), std::move(remedy), rule);
}

void XmlFindings::error_at(std::ptrdiff_t offset, std::string what, std::string remedy, std::string_view rule) {
  add(Severity::error, line_of(offset), {}, std::move(what), std::move(remedy), rule);
}

void XmlFindings::warning_at(std::ptrdiff_t offset, std::string what, std::string remedy) {
  add(Severity::warning, line_of(offset), {}, std::move(what), std::move(remedy), {});
}

std::vector<Finding> XmlFindings::findings() const {
  std::vector<Finding> sorted = findings_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Finding& a, const Finding& b) { return a.line < b.line; });
  return sorted;
}

double XmlFindings::number(const pugi::xml_node& node, const char* attribute, double most) {
  if (!node.attribute(attribute)) {
    error(node, fmt::format("attribute {} is missing", attribute), fmt::format("add {}=\"…\", a number", attribute));
    return 0.0;
  }
  const std::string_view text = node.attribute(attribute).value();
  const auto value = parse<double>(text);
  if (!value || !(std::abs(*value) <= most)) {
    error(node, fmt::format("{}=\"{}\" is not a number within ±{}", attribute, shown(text), most),
          "write a number of that range, with a decimal point");
    return 0.0;
  }
  return *value;
}

double XmlFindings::number_or(const pugi::xml_node& node, const char* attribute, double fallback, double most) {
  return trimmed(node.attribute(attribute).value()).empty() ? fallback : number(node, attribute, most);
}

double XmlFindings::amount_or(const pugi::xml_node& node, const char* attribute, double fallback, double most) {
  // Exporters write an unknown size so.
  if (const auto given = parse<double>(node.attribute(attribute).value()); given && std::isnan(*given)) {
    warning(node, fmt::format("{} is not a number; it is taken as not given", attribute),
            "give a number of at least 0");
    return fallback;
  }
  const double value = number_or(node, attribute, fallback, most);
  if (value >= 0.0) return value;
  warning(node, fmt::format("{}={} is below 0; it is taken as 0", attribute, value), "give a number of at least 0");
  return 0.0;
}

std::optional<int> XmlFindings::integer(const pugi::xml_node& node, const char* attribute) {
  const std::string_view text = node.attribute(attribute).value();
  const auto value = parse<int>(text);
  if (value && std::abs(static_cast<long>(*value)) <= 10'000) return value;
  error(node, fmt::format("{}=\"{}\" is not a lane number", attribute, shown(text)),
        "write a whole number within ±10000");
  return std::nullopt;
}

std::string XmlFindings::text(const pugi::xml_node& node, const char* attribute) {
  const std::string value = node.attribute(attribute).value();
  if (value.empty())
    error(node, fmt::format("attribute {} is missing or empty", attribute), fmt::format("add {}=\"…\"", attribute));
  return value;
}

}  // namespace septet::road
