#pragma once
/// XML elements for the scenario reader: attributes with parameters filled in, and a record of the parts that were
/// read.
///
/// Parts that the reader never read are not supported, and report_unread names them. Every returned value is usable:
/// after an error it is a harmless one, so that the reader continues and finds the rest. Used by the reader only.

#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/road/xml_findings.hpp"
#include "engine/scenario/model/expression.hpp"

namespace pugi {
struct xml_node_struct;
}

namespace septet::scenario {

/// One file: its text, its tree, its faults and the parts read.
struct XmlFile;

/// Parses; errors are in the file's findings.
std::shared_ptr<XmlFile> parse_xml(std::string_view text, std::string name);
road::XmlFindings& findings_of(XmlFile& file);

/// A number without bounds, for Element::number.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

class Element {
 public:
  Element() = default;
  Element(pugi::xml_node_struct* node, XmlFile& file, std::shared_ptr<const Parameters> parameters)
      : node_(node), file_(&file), parameters_(std::move(parameters)) {}

  explicit operator bool() const { return node_ != nullptr; }
  std::string name() const;
  const Parameters& parameters() const { return *parameters_; }
  /// This element with other parameters.
  Element with(std::shared_ptr<const Parameters> parameters) const;

  /// The first child of this name, marked as read; empty if there is none.
  Element child(const char* name) const;
  /// The first child of this name; an error if there is none.
  Element required(const char* name) const;
  std::vector<Element> children(const char* name) const;
  /// All child elements, not yet marked.
  std::vector<Element> all_children() const;
  /// Marks this element as read, or all of its content as needing no report.
  const Element& mark() const;
  void ignore() const;

  bool has(const char* attribute) const;
  std::string text(const char* attribute) const;  ///< An absent or empty attribute is an error.
  std::string text_or(const char* attribute, std::string fallback) const;
  /// A name: an expression outside the standard's syntax is taken as text.
  std::string label(const char* attribute) const;
  /// The name of a parameter, with or without its `$`; never replaced by a value. An absent one is an error.
  std::string parameter_name(const char* attribute) const;
  double number(const char* attribute, double low = -unbounded, double high = unbounded) const;
  double number_or(const char* attribute, double fallback, double low = -unbounded, double high = unbounded) const;
  std::optional<double> optional_number(const char* attribute, double low = -unbounded, double high = unbounded) const;
  int integer(const char* attribute, int low, int high) const;
  bool boolean_or(const char* attribute, bool fallback) const;
  /// For an attribute that the standard demands: without it, a warning names the fallback.
  bool required_boolean(const char* attribute, bool fallback) const;
  /// The value paired with the attribute's word; an unknown word is an error and the fallback.
  template <class Value>
  Value word(const char* attribute, std::initializer_list<std::pair<std::string_view, Value>> words,
             Value fallback) const {
    const std::string text_value = text_or(attribute, "");
    for (const auto& [word, value] : words) {
      if (word == text_value) return value;
    }
    if (!has(attribute)) return fallback;
    std::string known;
    for (const auto& [word, value] : words) known += (known.empty() ? "" : ", ") + std::string(word);
    unknown_word(attribute, text_value, known);
    return fallback;
  }
  /// For an attribute that the standard demands: without it, a warning names the fallback.
  template <class Value>
  Value required_word(const char* attribute, std::initializer_list<std::pair<std::string_view, Value>> words,
                      Value fallback) const {
    if (has(attribute) || node_ == nullptr) return word(attribute, words, fallback);
    for (const auto& [word, value] : words) {
      if (value != fallback) continue;
      missing_word(attribute, word);
      break;
    }
    return fallback;
  }
  /// The text between the tags.
  std::string content() const;
  /// The same, of words WORD=VALUE with a blank between two: a value that names a parameter ($name) is that parameter's.
  std::string content_with_parameters() const;

  /// Warns about every element and attribute in here that was never read; not about the content of unread elements.
  void report_unread() const;
  bool operator==(const Element& other) const { return node_ == other.node_; }

  /// "name:line, <element>", as in errors.
  std::string where() const;
  void error(std::string what, std::string remedy) const;
  void warning(std::string what, std::string remedy) const;

 private:
  void missing_word(const char* attribute, std::string_view taken) const;
  void unknown_word(const char* attribute, const std::string& value, const std::string& known) const;
  std::optional<std::string> value(const char* attribute) const;

  pugi::xml_node_struct* node_ = nullptr;
  XmlFile* file_ = nullptr;
  std::shared_ptr<const Parameters> parameters_;
};

/// The root element; empty if the text is not XML.
Element root_of(XmlFile& file, Parameters parameters = {});

}  // namespace septet::scenario
