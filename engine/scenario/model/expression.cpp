#include "engine/scenario/model/expression.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <fmt/format.h>

namespace septet::scenario {
namespace {

constexpr int deepest_nesting = 100;

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool goes_on_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

struct Function {
  std::string_view name;
  std::size_t arguments;
  double (*call)(double, double);
};
constexpr Function functions[] = {
    {"round", 1, [](double x, double) { return std::round(x); }},
    {"floor", 1, [](double x, double) { return std::floor(x); }},
    {"ceil", 1, [](double x, double) { return std::ceil(x); }},
    {"sqrt", 1, [](double x, double) { return std::sqrt(x); }},
    {"abs", 1, [](double x, double) { return std::abs(x); }},
    {"sign", 1, [](double x, double) { return x > 0.0   ? 1.0
                                              : x < 0.0 ? -1.0
                                                        : 0.0; }},
    {"sin", 1, [](double x, double) { return std::sin(x); }},
    {"cos", 1, [](double x, double) { return std::cos(x); }},
    {"tan", 1, [](double x, double) { return std::tan(x); }},
    {"asin", 1, [](double x, double) { return std::asin(x); }},
    {"acos", 1, [](double x, double) { return std::acos(x); }},
    {"atan", 1, [](double x, double) { return std::atan(x); }},
    {"pow", 2, [](double x, double y) { return std::pow(x, y); }},
    {"min", 2, [](double x, double y) { return std::fmin(x, y); }},
    {"max", 2, [](double x, double y) { return std::fmax(x, y); }},
};

/// Recursive descent; after the first error everything returns 0 and nothing is consumed.
class Expression {
 public:
  Expression(std::string_view text, const Parameters& parameters) : text_(text), parameters_(parameters) {}

  Expected<double> value() {
    const double result = disjunction();
    skip_space();
    if (error_.empty() && !text_.empty()) fail(fmt::format("\"{}\" is left over", text_.substr(0, 20)));
    if (error_.empty() && !std::isfinite(result)) fail("the value is not finite");
    if (!error_.empty())
      return failure(error_, "", "write an expression of numbers, $parameters, operators, functions");
    return result;
  }
  bool logical() const { return logical_; }

 private:
  double disjunction() {
    double value = conjunction();
    while (take_word("or")) {
      const double right = conjunction();
      value = truth(value != 0.0 || right != 0.0);
    }
    return value;
  }
  double conjunction() {
    double value = sum();
    while (take_word("and")) {
      const double right = sum();
      value = truth(value != 0.0 && right != 0.0);
    }
    return value;
  }
  double sum() {
    double value = product();
    while (true) {
      if (take('+'))
        value += product();
      else if (take('-'))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = factor();
    while (true) {
      if (take('*'))
        value *= factor();
      else if (take('/'))
        value /= factor();
      else if (take('%'))
        value = std::fmod(value, factor());
      else
        return value;
    }
  }
  double factor() {
    if (++depth_ > deepest_nesting) return fail("it is nested too deeply");
    const double value = signed_primary();
    --depth_;
    return value;
  }
  double signed_primary() {
    if (take('-')) return -factor();
    if (take('+')) return factor();
    if (take_word("not")) return truth(factor() == 0.0);
    return primary();
  }
  double primary() {
    skip_space();
    if (!error_.empty()) return 0.0;
    if (text_.empty()) return fail("a value is missing at the end");
    if (take('(')) {
      const double value = disjunction();
      if (!take(')')) return fail("a ) is missing");
      return value;
    }
    if (text_.front() == '$') {
      text_.remove_prefix(1);
      return parameter(name());
    }
    if (starts_name(text_.front())) return named(name());
    return number();
  }
  double number() {
    double value = 0.0;
    const auto [end, status] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (status != std::errc{}) return fail(fmt::format("\"{}\" is not a value", text_.substr(0, 20)));
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  double parameter(std::string_view name) {
    const auto found = parameters_.find(name);
    if (found == parameters_.end()) return fail(fmt::format("no parameter is named \"{}\"", name));
    if (found->second == "true") return truth(true);
    if (found->second == "false") return truth(false);
    const auto value = parse_number(found->second);
    if (!value) return fail(fmt::format("parameter {} is no number but \"{}\"", name, found->second));
    return *value;
  }
  double named(std::string_view name) {
    if (name == "true" || name == "false") return truth(name == "true");
    if (name == "pi") return std::numbers::pi;
    for (const Function& function : functions) {
      if (function.name != name) continue;
      if (!take('(')) return fail(fmt::format("{} needs its arguments in brackets", name));
      const double first = disjunction();
      double second = 0.0;
      if (function.arguments == 2) {
        if (!take(',')) return fail(fmt::format("{} takes two arguments", name));
        second = disjunction();
      }
      if (!take(')')) return fail("a ) is missing");
      return function.call(first, second);
    }
    return fail(fmt::format("\"{}\" is no function of OpenSCENARIO", name));
  }
  std::string_view name() {
    std::size_t length = 0;
    while (length < text_.size() && goes_on_name(text_[length])) ++length;
    const std::string_view result = text_.substr(0, length);
    text_.remove_prefix(length);
    return result;
  }
  double truth(bool value) {
    logical_ = true;
    return value ? 1.0 : 0.0;
  }
  void skip_space() {
    while (!text_.empty() && std::isspace(static_cast<unsigned char>(text_.front()))) text_.remove_prefix(1);
  }
  bool take(char c) {
    skip_space();
    if (!error_.empty() || text_.empty() || text_.front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  bool take_word(std::string_view word) {
    skip_space();
    if (!error_.empty() || text_.substr(0, word.size()) != word) return false;
    if (text_.size() > word.size() && goes_on_name(text_[word.size()])) return false;
    text_.remove_prefix(word.size());
    return true;
  }
  double fail(std::string what) {
    if (error_.empty()) error_ = std::move(what);
    return 0.0;
  }

  std::string_view text_;
  const Parameters& parameters_;
  std::string error_;
  int depth_ = 0;
  bool logical_ = false;
};

}  // namespace

Expected<std::string> substitute(std::string_view text, const Parameters& parameters) {
  text = trimmed(text);
  if (text.empty() || text.front() != '$') return std::string(text);
  if (text.size() > 2 && text[1] == '{' && text.back() == '}') {
    Expression expression(text.substr(2, text.size() - 3), parameters);
    const auto value = expression.value();
    if (!value) return tl::unexpected(value.error());
    if (expression.logical()) return std::string(*value != 0.0 ? "true" : "false");
    return fmt::format("{}", *value);
  }
  const auto found = parameters.find(text.substr(1));
  if (found == parameters.end()) {
    return failure(fmt::format("no parameter is named \"{}\"", text.substr(1, 60)), "",
                   "declare it in <ParameterDeclarations>");
  }
  return found->second;
}

Expected<double> parse_number(std::string_view text) {
  text = trimmed(text);
  const std::string_view shown = text.substr(0, 60);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() || !(std::abs(value) <= 1e12)) {
    return failure(fmt::format("\"{}\" is not a number within ±1e12", shown), "", "write a finite number");
  }
  return value;
}

}  // namespace septet::scenario
