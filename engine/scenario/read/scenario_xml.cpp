#include "engine/scenario/read/scenario_xml.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include <pugixml.hpp>

namespace septet::scenario {

struct XmlFile {
  std::string name;
  pugi::xml_document document;
  road::XmlFindings findings;
  std::set<const void*> read;

  XmlFile(std::string_view text, std::string file_name) : name(std::move(file_name)), findings(text, name) {}
};

namespace {

/// A text from the file, made fit for a message.
std::string shown(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 60)) result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return text.size() > 60 ? result + "…" : result;
}

/// Place at which the text stops being UTF-8.
std::optional<std::size_t> find_broken_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto lead = static_cast<unsigned char>(text[at]);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : (lead & 0xF0) == 0xE0       ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || at + length > text.size()) return at;
    for (std::size_t i = 1; i < length; ++i) {
      if ((static_cast<unsigned char>(text[at + i]) & 0xC0) != 0x80) return at;
    }
    at += length;
  }
  return std::nullopt;
}

}  // namespace

std::shared_ptr<XmlFile> parse_xml(std::string_view text, std::string name) {
  auto file = std::make_shared<XmlFile>(text, std::move(name));
  // Parsed as a fragment, so that parts beside the root are seen.
  const auto result = file->document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_fragment);
  const pugi::xml_node root = file->document.document_element();
  if (!result) {
    file->findings.error_at(result.offset, fmt::format("this is not XML: {}", result.description()), "repair the file");
  } else if (!root) {
    file->findings.error_at(0, "this is not XML: there is no element", "repair the file");
  }
  for (const pugi::xml_node node : file->document.children()) {
    const bool beside = node.type() == pugi::node_element || node.type() == pugi::node_pcdata;
    if (!beside || node == root) continue;
    file->findings.error_at(node.offset_debug(), "this stands beside the root element",
                            "keep one root and nothing beside it");
    break;
  }
  if (const auto bad = find_broken_utf8(text); result.encoding == pugi::encoding_utf8 && bad) {
    file->findings.warning_at(static_cast<std::ptrdiff_t>(*bad), "these bytes are not UTF-8",
                              "save the file as UTF-8, or name its encoding in the first line");
  }
  return file;
}

road::XmlFindings& findings_of(XmlFile& file) { return file.findings; }

Element root_of(XmlFile& file, Parameters parameters) {
  const pugi::xml_node root = file.document.document_element();
  if (!root) return {};
  return Element(root.internal_object(), file, std::make_shared<const Parameters>(std::move(parameters))).mark();
}

void Element::report_unread() const {
  const pugi::xml_node root(node_);
  road::XmlFindings& findings = file_->findings;
  const auto was_read = [&](const void* part) { return file_->read.contains(part); };
  const char* remedy = "leave it out, or expect the scenario to run without it";
  pugi::xml_node node = root;
  while (node) {
    const bool element = node.type() == pugi::node_element;
    const bool read = was_read(node.internal_object());
    if (element && !read) {
      findings.warning(node, fmt::format("{} is not supported and has no effect", shown(node.name())), remedy);
    } else if (element) {
      for (const pugi::xml_attribute attribute : node.attributes()) {
        const std::string_view name = attribute.name();
        if (was_read(attribute.internal_object()) || name.find(':') != name.npos || name == "xmlns") continue;
        findings.warning(node, fmt::format("attribute {} has no effect here", shown(name)), remedy);
      }
    }
    if (read && node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != root && !node.next_sibling()) node = node.parent();
    node = node == root ? pugi::xml_node{} : node.next_sibling();
  }
}

std::string Element::name() const { return pugi::xml_node(node_).name(); }

Element Element::with(std::shared_ptr<const Parameters> parameters) const {
  Element other = *this;
  other.parameters_ = std::move(parameters);
  return other;
}

const Element& Element::mark() const {
  if (node_) file_->read.insert(node_);
  return *this;
}

void Element::ignore() const {
  mark();
  pugi::xml_node node(node_);
  for (const pugi::xml_attribute attribute : node.attributes()) file_->read.insert(attribute.internal_object());
  struct Marker : pugi::xml_tree_walker {
    XmlFile* file = nullptr;
    bool for_each(pugi::xml_node& node) override {
      file->read.insert(node.internal_object());
      for (const pugi::xml_attribute attribute : node.attributes()) file->read.insert(attribute.internal_object());
      return true;
    }
  } marker;
  marker.file = file_;
  node.traverse(marker);
}

Element Element::child(const char* name) const {
  if (!node_) return {};
  const pugi::xml_node found = pugi::xml_node(node_).child(name);
  if (!found) return {};
  const Element element(found.internal_object(), *file_, parameters_);
  element.mark();
  return element;
}

Element Element::required(const char* name) const {
  const Element found = child(name);
  if (!found && node_) error(fmt::format("<{}> is missing", name), fmt::format("add <{}> inside", name));
  return found;
}

std::vector<Element> Element::children(const char* name) const {
  std::vector<Element> found;
  if (!node_) return found;
  for (const pugi::xml_node node : pugi::xml_node(node_).children(name))
    found.push_back(Element(node.internal_object(), *file_, parameters_).mark());
  return found;
}

std::vector<Element> Element::all_children() const {
  std::vector<Element> found;
  if (!node_) return found;
  for (const pugi::xml_node node : pugi::xml_node(node_).children()) {
    if (node.type() == pugi::node_element) found.emplace_back(node.internal_object(), *file_, parameters_);
  }
  return found;
}

std::optional<std::string> Element::value(const char* attribute) const {
  const pugi::xml_attribute found = pugi::xml_node(node_).attribute(attribute);
  if (!found) return std::nullopt;
  file_->read.insert(found.internal_object());
  const auto text = substitute(found.value(), *parameters_);
  if (text) return *text;
  error(fmt::format("{}=\"{}\": {}", attribute, shown(found.value()), text.error().what), text.error().remedy);
  return std::nullopt;
}

bool Element::has(const char* attribute) const { return static_cast<bool>(pugi::xml_node(node_).attribute(attribute)); }

std::string Element::text(const char* attribute) const {
  const auto found = value(attribute);
  if (found && !found->empty()) return *found;
  if (node_ && (!has(attribute) || found)) {
    error(fmt::format("attribute {} is missing or empty", attribute), fmt::format("add {}=\"…\"", attribute));
  }
  return {};
}

std::string Element::text_or(const char* attribute, std::string fallback) const {
  return value(attribute).value_or(std::move(fallback));
}

std::string Element::label(const char* attribute) const {
  const pugi::xml_attribute found = pugi::xml_node(node_).attribute(attribute);
  if (!found) return {};
  file_->read.insert(found.internal_object());
  if (const auto text = substitute(found.value(), *parameters_)) return *text;
  return found.value();
}

std::string Element::parameter_name(const char* attribute) const {
  const pugi::xml_attribute found = pugi::xml_node(node_).attribute(attribute);
  if (found) file_->read.insert(found.internal_object());
  std::string name = found.value();
  if (name.starts_with('$')) name.erase(0, 1);
  if (name.empty()) {
    error(fmt::format("attribute {} is missing or empty", attribute), "write the name of a parameter");
  }
  return name;
}

double Element::number(const char* attribute, double low, double high) const {
  const std::string text_value = text(attribute);
  const double harmless = std::clamp(0.0, low, high);
  if (text_value.empty()) return harmless;
  const auto parsed = parse_number(text_value);
  if (!parsed) {
    error(fmt::format("{}: {}", attribute, parsed.error().what), parsed.error().remedy);
    return harmless;
  }
  if (*parsed >= low && *parsed <= high) return *parsed;
  error(fmt::format("{}=\"{}\" is out of its range", attribute, shown(text_value)),
        std::isfinite(high) ? fmt::format("give a value from {} to {}", low, high)
                            : fmt::format("give a value of at least {}", low));
  return harmless;
}

double Element::number_or(const char* attribute, double fallback, double low, double high) const {
  return value(attribute).value_or("").empty() ? fallback : number(attribute, low, high);
}

std::optional<double> Element::optional_number(const char* attribute, double low, double high) const {
  if (!has(attribute)) return std::nullopt;
  return number(attribute, low, high);
}

int Element::integer(const char* attribute, int low, int high) const {
  const double found = number(attribute, low, high);
  if (found == std::floor(found)) return static_cast<int>(found);
  error(fmt::format("{}=\"{}\" is not a whole number", attribute, found), "write it without a fraction");
  return low;
}

bool Element::boolean_or(const char* attribute, bool fallback) const {
  return word<bool>(attribute, {{"true", true}, {"false", false}, {"1", true}, {"0", false}}, fallback);
}

bool Element::required_boolean(const char* attribute, bool fallback) const {
  if (node_ != nullptr && !has(attribute)) missing_word(attribute, fallback ? "true" : "false");
  return boolean_or(attribute, fallback);
}

std::string Element::content() const {
  const std::string raw = pugi::xml_node(node_).text().as_string();
  std::string content;
  for (std::size_t at = 0; at < raw.size();) {
    // Blanks stay as they are: each is a word of its own.
    const std::size_t end = raw[at] == ' ' ? at + 1 : std::min(raw.find(' ', at), raw.size());
    const std::string word = raw.substr(at, end - at);
    at = end;
    const auto value = word.starts_with('$') ? substitute(word, *parameters_) : Expected<std::string>(word);
    if (!value) error(fmt::format("{}: {}", shown(word.c_str()), value.error().what), value.error().remedy);
    content += value.value_or(word);
  }
  return content;
}

std::string Element::content_with_parameters() const {
  std::string filled;
  std::istringstream words(content());
  for (std::string word; words >> word;) {
    const auto value = std::min(word.find('=') + 1, word.size());
    if (!filled.empty()) filled += ' ';
    filled += word.substr(0, value);
    const auto known = substitute(word.substr(value), *parameters_);
    if (!known) error(known.error().what, known.error().remedy);
    filled += known.value_or("");
  }
  return filled;
}

std::string Element::where() const {
  return file_ != nullptr ? file_->findings.where(pugi::xml_node(node_)) : std::string();
}

void Element::error(std::string what, std::string remedy) const {
  if (file_ != nullptr) file_->findings.error(pugi::xml_node(node_), std::move(what), std::move(remedy));
}

void Element::warning(std::string what, std::string remedy) const {
  if (file_ != nullptr) file_->findings.warning(pugi::xml_node(node_), std::move(what), std::move(remedy));
}

void Element::missing_word(const char* attribute, std::string_view taken) const {
  warning(fmt::format("attribute {} is missing; \"{}\" is taken", attribute, taken),
          fmt::format("add {}=\"{}\", or the word that is meant", attribute, taken));
}

void Element::unknown_word(const char* attribute, const std::string& value, const std::string& known) const {
  error(fmt::format("{}=\"{}\" is none of the words that are supported", attribute, shown(value)),
        "write one of: " + known);
}

}  // namespace septet::scenario
