#include "car-io/can/dbc_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace septet::car_io::dbc {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_identifier(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

}  // namespace

void Scanner::advance(std::size_t count) {
  const auto passed = text_.substr(place_, count);
  line_ += static_cast<int>(std::ranges::count(passed, '\n'));
  place_ += passed.size();
}

void Scanner::skip_space() {
  std::size_t count = 0;
  while (place_ + count < text_.size() && is_space(text_[place_ + count])) ++count;
  advance(count);
}

bool Scanner::at_end() {
  skip_space();
  return place_ == text_.size();
}

char Scanner::peek() { return at_end() ? '\0' : text_[place_]; }

bool Scanner::take(char wanted) {
  if (at_end() || text_[place_] != wanted) return false;
  advance(1);
  return true;
}

std::optional<std::string_view> Scanner::peek_identifier() {
  if (at_end() || !begins_identifier(text_[place_])) return std::nullopt;
  return peek_name();
}

std::optional<std::string_view> Scanner::peek_name() {
  skip_space();
  std::size_t count = 0;
  while (place_ + count < text_.size() && (begins_identifier(text_[place_ + count]) || is_digit(text_[place_ + count])))
    ++count;
  return count > 0 ? std::optional(text_.substr(place_, count)) : std::nullopt;
}

std::optional<std::string_view> Scanner::take_name() {
  const auto found = peek_name();
  if (found) advance(found->size());
  return found;
}

std::optional<std::string_view> Scanner::take_name_in(int line) {
  return !at_end() && line_ == line ? take_name() : std::nullopt;
}

std::optional<std::string_view> Scanner::take_identifier() {
  const auto found = peek_identifier();
  if (found) advance(found->size());
  return found;
}

std::optional<double> Scanner::take_number() {
  if (at_end()) return std::nullopt;
  const std::size_t sign = text_[place_] == '+' ? 1 : 0;
  const char* begin = text_.data() + place_ + sign;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (problem != std::errc() || !std::isfinite(value)) return std::nullopt;
  advance(sign + static_cast<std::size_t>(end - begin));
  return value;
}

std::optional<std::uint64_t> Scanner::take_unsigned() {
  if (at_end()) return std::nullopt;
  const char* begin = text_.data() + place_;
  std::uint64_t value = 0;
  const auto [end, problem] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (problem != std::errc()) return std::nullopt;
  advance(static_cast<std::size_t>(end - begin));
  return value;
}

std::optional<std::string> Scanner::take_string() {
  if (peek() != '"') return std::nullopt;
  std::string text;
  for (std::size_t i = place_ + 1; i < text_.size(); ++i) {
    if (text_[i] == '\\' && i + 1 < text_.size() && text_[i + 1] == '"')
      ++i;
    else if (text_[i] == '"') {
      advance(i + 1 - place_);
      return text;
    }
    text += text_[i];
  }
  return std::nullopt;
}

bool Scanner::skip_word() {
  if (at_end()) return false;
  if (take_identifier()) return true;
  if (text_[place_] == '"') return take_string().has_value();
  advance(1);
  return true;
}

std::string_view Scanner::rest_of_line() {
  skip_space();
  const std::string_view rest = text_.substr(place_);
  return rest.substr(0, rest.find('\n'));
}

void Scanner::skip_line() {
  const std::size_t end = text_.find('\n', place_);
  advance(end == std::string_view::npos ? text_.size() - place_ : end - place_);
}

}  // namespace septet::car_io::dbc
