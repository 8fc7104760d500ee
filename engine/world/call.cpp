#include "engine/world/call.hpp"

#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet {
namespace {

using Word = std::pair<std::string, std::string>;

/// In bytes, without its author.
constexpr std::size_t longest_text = 3600;

tl::unexpected<Error> no_call(std::string what) {
  return failure(std::move(what), "call",
                 "write name=NAME, perhaps node=NODE, and up to 16 words PARAMETER=VALUE or PARAMETER=\"SOME WORDS\"");
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_call_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_call_name &&
         std::ranges::all_of(name, [](char c) { return is_letter(c) || is_digit(c) || c == '-' || c == '_'; });
}

bool is_parameter_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_call_name &&
         std::ranges::all_of(name, [](char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '_'; });
}

bool is_value(std::string_view value) { return value.size() <= longest_call_value && printable_characters(value); }

/// Takes the rest of a value in quotes, and its second quote, from the text. Empty: there is no second one.
std::optional<std::string> take_quoted(std::string_view& text) {
  std::string value;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      text.remove_prefix(i + 1);
      return value;
    }
    if (text[i] == '\\' && ++i == text.size()) break;
    value += text[i];
  }
  return std::nullopt;
}

std::string in_quotes(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

/// Takes the next word, and the blank behind it, from the text. Empty: it is no word.
std::optional<Word> take_pair(std::string_view& text) {
  const auto equals = text.find('=');
  if (equals == text.npos) return std::nullopt;
  Word word(text.substr(0, equals), "");
  text.remove_prefix(equals + 1);
  if (text.starts_with('"')) {
    text.remove_prefix(1);
    auto value = take_quoted(text);
    if (!value) return std::nullopt;
    word.second = std::move(*value);
  } else {
    word.second = text.substr(0, text.find(' '));
    if (word.second.empty() || word.second.find('"') != word.second.npos) return std::nullopt;
    text.remove_prefix(word.second.size());
  }
  if (text.empty()) return word;
  if (!text.starts_with(' ') || text.size() == 1) return std::nullopt;
  text.remove_prefix(1);
  return word;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> words_of(const Call& call) {
  std::vector<Word> words{{"name", call.name}};
  if (!call.node.empty()) words.emplace_back("node", call.node);
  words.insert(words.end(), call.parameters.begin(), call.parameters.end());
  if (!call.by.empty()) words.emplace_back("by", call.by);
  return words;
}

std::string text_of(const Call& call) {
  std::string text;
  for (const auto& [name, value] : words_of(call)) {
    const bool is_plain = !value.empty() && value.find_first_of(" \"") == value.npos;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, is_plain ? value : in_quotes(value));
  }
  return text;
}

Expected<Call> read_call(std::string_view text) {
  Call call;
  while (!text.empty()) {
    auto word = take_pair(text);
    if (!word) return no_call("a word has no name, no value, or no second quote");
    auto& [name, value] = *word;
    if (!is_parameter_name(name)) return no_call(printable(name, 80) + " is no name of a parameter");
    if (!is_value(value))
      return no_call(fmt::format("the value of {} is longer than {} bytes, or has a sign that is not printed", name,
                                 longest_call_value));
    std::string* const own = name == "name"   ? &call.name
                             : name == "node" ? &call.node
                             : name == "by"   ? &call.by
                                              : nullptr;
    const bool is_twice = own ? !own->empty() : std::ranges::count(call.parameters, name, &Word::first) > 0;
    if (is_twice || (own && value.empty())) return no_call(name + (is_twice ? " is given twice" : " is empty"));
    if (own)
      *own = std::move(value);
    else
      call.parameters.push_back(std::move(*word));
    if (call.parameters.size() > most_call_parameters)
      return no_call(fmt::format("there are more than {} parameters", most_call_parameters));
  }
  if (!is_call_name(call.name))
    return no_call("the call has no name, or one that is not of letters, digits, hyphens and underscores");
  Call nobodys = call;
  nobodys.by.clear();
  if (text_of(nobodys).size() > longest_text)
    return no_call(fmt::format("the call is longer than {} bytes", longest_text));
  return call;
}

}  // namespace septet
