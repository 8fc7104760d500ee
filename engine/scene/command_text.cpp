#include "engine/scene/command_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "engine/scene/command_fields.hpp"
#include "engine/scene/command_validation.hpp"

namespace septet::scene {
namespace {

constexpr std::array<std::string_view, node_type_count> type_words{"object", "geometry", "material", "bitmap"};
constexpr std::array<std::string_view, std::variant_size_v<TagValue>> value_words{"flag",   "count", "real", "text",
                                                                                  "vector", "node",  "bytes"};
constexpr std::array<std::string_view, std::variant_size_v<Fragment>> fragment_words{
    "color", "light",   "reflection", "transparency", "volume", "view",      "geometry",    "texture",
    "noise", "blender", "clamp",      "matrix",       "ramp",   "animation", "alternative", "output"};

std::vector<std::string> make_command_words() {
  std::vector<std::string> words;
  words.reserve(std::variant_size_v<Command>);
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (words.emplace_back(name_of(Command(std::in_place_index<i>))), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Command>>());
  for (std::string& word : words) std::ranges::replace(word, ' ', '-');
  return words;
}

template <class Variant>
const auto& words_for() {
  if constexpr (std::is_same_v<Variant, TagValue>)
    return value_words;
  else if constexpr (std::is_same_v<Variant, Fragment>)
    return fragment_words;
  else {
    static const std::vector<std::string> words = make_command_words();
    return words;
  }
}

struct TextWriter {
  static constexpr bool writes = true;
  const TextNames& names;
  std::string out{};

  void word(std::string_view text) {
    if (!out.empty()) out += ' ';
    out += text;
  }
  void node(NodeId id) { word(word_of(names, id)); }
  void part(PartId id) { word(std::to_string(id)); }
  void fragment(FragmentId id) { word(id == no_fragment ? "none" : std::to_string(id)); }
  void number(std::uint32_t value) { word(std::to_string(value)); }
  void flag(bool value) { word(value ? "1" : "0"); }
  template <class Real>
  void real(Real value) {
    word(fmt::format("{}", value));
  }
  void text(const std::string& text, std::size_t) { word(quoted_if_needed(text)); }
  template <class Enumeration>
  void kind(Enumeration value, Enumeration) {
    if constexpr (std::is_same_v<Enumeration, NodeType>)
      word(type_words[static_cast<std::size_t>(value)]);
    else
      word(std::to_string(static_cast<int>(value)));
  }
  template <class T>
  std::size_t count(const std::vector<T>& values, std::size_t) {
    word(std::to_string(values.size()));
    return values.size();
  }
  void bytes(const std::vector<std::uint8_t>& bytes, std::size_t) {
    std::string digits = "x";
    for (const std::uint8_t byte : bytes) fmt::format_to(std::back_inserter(digits), "{:02x}", byte);
    word(digits);
  }
  void reals(std::span<const float> values, std::size_t) {
    for (const float value : values) real(value);
  }
  void integers(std::span<const std::uint32_t> values) {
    for (const std::uint32_t value : values) number(value);
  }
  void corners(std::span<const PolygonCorners> polygons) {
    for (const PolygonCorners& corners : polygons)
      for (const std::uint32_t corner : corners) word(corner == geometry::no_vertex ? "none" : std::to_string(corner));
  }
  static void what_follows(bool, bool) {}
  template <class Variant>
  void alternative(std::size_t index) {
    word(words_for<Variant>()[index]);
  }
};

/// The first word that is wrong ends the reading: what follows reads as nothing.
struct TextReader {
  static constexpr bool writes = false;
  const TextNames& names;
  const std::vector<TextWord>& words;
  std::size_t at = 0;
  std::optional<std::string> wrong{};  ///< What is wrong.

  std::size_t left() const { return wrong ? 0 : words.size() - at; }
  void fail(std::string_view expected) {
    if (wrong) return;
    wrong = at < words.size() ? fmt::format("word {}, \"{:.80}\", is not {}", at + 1, words[at].text, expected)
                              : fmt::format("the line ends where {} is expected", expected);
  }
  /// The next word, if it is right.
  template <class Read>
  void next(std::string_view expected, Read read) {
    if (wrong) return;
    if (at == words.size() || !read(words[at])) return fail(expected);
    ++at;
  }
  template <class Number>
  void parse(Number& value, std::string_view expected) {
    next(expected, [&](const TextWord& word) {
      const char* end = word.text.data() + word.text.size();
      const auto [stop, error] = std::from_chars(word.text.data(), end, value);
      return error == std::errc() && stop == end && !word.text.empty();
    });
  }

  void node(NodeId& id) {
    next("a node that exists, #ID, +N or none", [&](const TextWord& word) {
      const auto found = node_of(names, word);
      if (found) id = *found;
      return found.has_value();
    });
  }
  void part(PartId& id) { parse(id, "the number of a part"); }
  void fragment(FragmentId& id) {
    if (at < words.size() && words[at].text == "none")
      id = no_fragment, ++at;
    else
      parse(id, "the number of a fragment, or none");
  }
  void number(std::uint32_t& value) { parse(value, "a whole number"); }
  void flag(bool& value) {
    next("0 or 1", [&](const TextWord& word) {
      value = word.text == "1";
      return value || word.text == "0";
    });
  }
  template <class Real>
  void real(Real& value) {
    parse(value, "a number");
  }
  void text(std::string& text, std::size_t) {
    next("a text", [&](const TextWord& word) {
      text = word.text;
      return true;
    });
  }
  template <class Enumeration>
  void kind(Enumeration& value, Enumeration last) {
    if constexpr (std::is_same_v<Enumeration, NodeType>) {
      next("object, geometry, material or bitmap", [&](const TextWord& word) {
        const auto found = std::ranges::find(type_words, word.text);
        if (found != type_words.end()) value = static_cast<NodeType>(found - type_words.begin());
        return found != type_words.end();
      });
    } else {
      std::uint8_t number = 0;
      parse(number, "the number of a kind");
      if (number > static_cast<std::uint8_t>(last)) return --at, fail("the number of a kind");
      value = static_cast<Enumeration>(number);
    }
  }
  /// A word each at least: no line makes it larger than itself.
  template <class T>
  std::size_t count(std::vector<T>& values, std::size_t limit) {
    std::size_t size = 0;
    parse(size, "a count");
    if (size > std::min(limit, left())) return --at, fail("the count of what follows"), 0;
    values.resize(size);
    return size;
  }
  void bytes(std::vector<std::uint8_t>& bytes, std::size_t limit) {
    next("x and an even number of hexadecimal digits", [&](const TextWord& word) {
      const std::string& digits = word.text;
      if (!digits.starts_with('x') || digits.size() % 2 == 0 || digits.size() / 2 > limit) return false;
      for (std::size_t i = 1; i < digits.size(); i += 2) {
        std::uint8_t byte = 0;
        if (std::from_chars(digits.data() + i, digits.data() + i + 2, byte, 16).ptr != digits.data() + i + 2)
          return false;
        bytes.push_back(byte);
      }
      return true;
    });
  }
  void reals(std::span<float> values, std::size_t) {
    for (float& value : values) real(value);
  }
  void integers(std::span<std::uint32_t> values) {
    for (std::uint32_t& value : values) number(value);
  }
  void corners(std::span<PolygonCorners> polygons) {
    for (PolygonCorners& corners : polygons)
      for (std::uint32_t& corner : corners) {
        if (at < words.size() && words[at].text == "none")
          corner = geometry::no_vertex, ++at;
        else
          number(corner);
      }
  }
  void what_follows(bool& turned, bool& scaled) const {
    turned = left() == 4 || left() == 7;
    scaled = left() == 3 || left() == 7;
  }
  template <class Variant>
  std::size_t alternative() {
    std::size_t index = std::variant_npos;
    next("one of the words of COMMANDS.md", [&](const TextWord& word) {
      const auto& known = words_for<Variant>();
      const auto found = std::ranges::find(known, word.text);
      if (found != known.end()) index = static_cast<std::size_t>(found - known.begin());
      return found != known.end();
    });
    return wrong ? std::variant_npos : index;
  }
};

std::optional<std::uint32_t> number_behind(std::string_view word, char sign) {
  std::uint32_t number = 0;
  if (word.size() < 2 || word[0] != sign) return std::nullopt;
  const auto [stop, error] = std::from_chars(word.data() + 1, word.data() + word.size(), number);
  if (error != std::errc() || stop != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace

Expected<std::vector<TextWord>> words_of(std::string_view line) {
  const auto wrong = [&](const char* what) {
    return failure(what, fmt::format("\"{:.80}\"", line), "write words with blanks as \"…\", with \\\" \\\\ \\n \\xNN");
  };
  std::vector<TextWord> words;
  std::size_t at = 0;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  for (;;) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (at == line.size()) return words;
    if (words.empty() && line[at] == '#') return words;
    TextWord word{{}, line[at] == '"'};
    bool inside = false;
    for (; at < line.size() && (inside || !is_blank(line[at])); ++at) {
      if (line[at] == '"') {
        inside = !inside;
      } else if (inside && line[at] == '\\') {
        if (++at == line.size()) return wrong("a text without its end");
        const char escape = line[at];
        if (escape == '"' || escape == '\\') {
          word.text += escape;
        } else if (escape == 'n') {
          word.text += '\n';
        } else if (std::uint8_t byte = 0;
                   escape == 'x' && at + 2 < line.size() &&
                   std::from_chars(line.data() + at + 1, line.data() + at + 3, byte, 16).ptr == line.data() + at + 3) {
          word.text += static_cast<char>(byte);
          at += 2;
        } else {
          return wrong("an unknown escape");
        }
      } else {
        word.text += line[at];
      }
    }
    if (inside) return wrong("a text without its end");
    words.push_back(std::move(word));
  }
}

std::string quoted_if_needed(std::string_view text) {
  const auto is_plain = [](char c) { return c > ' ' && c != '"' && c != '\\' && c != 0x7f; };
  const bool reads_otherwise =
      text.empty() || text[0] == '#' || text[0] == '+' || text == "none" || !std::ranges::all_of(text, is_plain);
  if (!reads_otherwise) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += '\\', quoted += c;
    else if (c == '\n')
      quoted += "\\n";
    else if (static_cast<unsigned char>(c) < ' ' || c == 0x7f)
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

std::optional<NodeId> node_of(const TextNames& names, const TextWord& word) {
  if (!word.quoted) {
    if (word.text == "none") return no_node;
    if (const auto id = number_behind(word.text, '#')) return *id;
    if (const auto own = number_behind(word.text, '+'))
      return names.own_ids == 0 || *own > no_node - names.own_ids ? std::nullopt : std::optional(names.own_ids + *own);
  }
  std::string_view name = word.text;
  auto type = NodeType::object;
  for (std::size_t i = 0; i < type_words.size(); ++i)
    if (!word.quoted && name.starts_with(type_words[i]) && name.substr(type_words[i].size()).starts_with(':')) {
      type = static_cast<NodeType>(i);
      name.remove_prefix(type_words[i].size() + 1);
      break;
    }
  if (names.fresh && type == NodeType::object)
    if (const auto found = names.fresh->find(name); found != names.fresh->end()) return found->second;
  const Node* node = names.store.find(type, name);
  return node ? std::optional(node->id) : std::nullopt;
}

std::string word_of(const TextNames& names, NodeId id) {
  if (id == no_node) return "none";
  if (names.numbers)
    if (const auto numbered = names.numbers->find(id); numbered != names.numbers->end())
      return fmt::format("+{}", numbered->second);
  if (names.own_ids != 0 && id >= names.own_ids && id - names.own_ids < 0x10000u)
    return fmt::format("+{}", id - names.own_ids);
  const Node* node = names.store.find(id);
  const Node* named = node && !node->name.empty() ? names.store.find(node->type(), node->name) : nullptr;
  if (named != node || !node) return fmt::format("#{}", id);
  const std::string name = quoted_if_needed(node->name);
  if (node->type() == NodeType::object && name.find(':') == std::string::npos) return name;
  return fmt::format("{}:{}", type_words[static_cast<std::size_t>(node->type())], name);
}

std::string to_text(const Command& command, const TextNames& names) {
  TextWriter writer{names};
  variant(writer, command);
  return std::move(writer.out);
}

bool is_command_word(std::string_view word) {
  const auto& known = words_for<Command>();
  return std::ranges::find(known, word) != known.end();
}

Expected<Command> command_from_words(const std::vector<TextWord>& words, const TextNames& names) {
  TextReader reader{names, words};
  Command command;
  variant(reader, command);
  if (!reader.wrong && reader.at < words.size()) reader.fail("expected: the command is complete before it");
  if (reader.wrong)
    return failure(*reader.wrong, words.empty() ? "a line without a command" : words[0].text,
                   "write its fields in the order of COMMANDS.md");
  if (auto valid = validate(command); !valid) return tl::unexpected(valid.error());
  return command;
}

}  // namespace septet::scene
