#include "engine/scenery/world/sign_catalogue.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string_view>

namespace septet::scenery {
namespace {

using Style = SignStyle;
using Symbol = SignSymbol;

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

struct Entry {
  std::string_view number;
  SignStyle style;
  Symbol symbol = Symbol::none;
  std::string_view text = {};
};

constexpr Entry german[]{
    {"101", Style::warning, Symbol::exclamation},
    {"102", Style::warning, Symbol::crossroads},
    {"103", Style::warning, Symbol::bend_left},
    {"105", Style::warning, Symbol::bend_left},
    {"120", Style::warning, Symbol::narrow},
    {"121", Style::warning, Symbol::narrow},
    {"123", Style::warning, Symbol::works},
    {"131", Style::warning, Symbol::lights},
    {"133", Style::warning, Symbol::walker},
    {"136", Style::warning, Symbol::walkers},
    {"138", Style::warning, Symbol::bicycle},
    {"201", Style::rail_cross},
    {"205", Style::yield},
    {"206", Style::stop},
    {"208", Style::prohibition, Symbol::arrow_up},
    {"209", Style::mandatory, Symbol::arrow_right},
    {"211", Style::mandatory, Symbol::arrow_right},
    {"214", Style::mandatory, Symbol::arrow_up},
    {"215", Style::mandatory, Symbol::roundabout},
    {"220", Style::information, Symbol::arrow_right},
    {"222", Style::mandatory, Symbol::arrow_right},
    {"224", Style::place, Symbol::text, "H"},
    {"237", Style::mandatory, Symbol::bicycle},
    {"239", Style::mandatory, Symbol::walker},
    {"240", Style::mandatory, Symbol::walkers},
    {"241", Style::mandatory, Symbol::walkers},
    {"242", Style::white_board, Symbol::walker},
    {"250", Style::prohibition},
    {"251", Style::prohibition, Symbol::two_cars},
    {"253", Style::prohibition, Symbol::lorry},
    {"254", Style::prohibition, Symbol::bicycle},
    {"259", Style::prohibition, Symbol::walker},
    {"260", Style::prohibition, Symbol::two_cars},
    {"267", Style::no_entry},
    {"274", Style::prohibition, Symbol::text},
    {"274.1", Style::white_board, Symbol::text},
    {"275", Style::mandatory, Symbol::text},
    {"276", Style::prohibition, Symbol::two_cars},
    {"277", Style::prohibition, Symbol::lorry},
    {"278", Style::prohibition_end, Symbol::text},
    {"280", Style::prohibition_end, Symbol::two_cars},
    {"282", Style::prohibition_end},
    {"283", Style::no_stopping, Symbol::crossroads},
    {"286", Style::no_stopping},
    {"301", Style::warning, Symbol::crossroads},
    {"306", Style::priority},
    {"307", Style::priority_end},
    {"308", Style::information, Symbol::arrow_up},
    {"310", Style::place, Symbol::text},
    {"311", Style::place, Symbol::text},
    {"314", Style::information, Symbol::text, "P"},
    {"325.1", Style::information, Symbol::walkers},
    {"330.1", Style::information, Symbol::two_cars},
    {"331.1", Style::information, Symbol::two_cars},
    {"350", Style::information, Symbol::walker_on_stripes},
    {"357", Style::information, Symbol::text, "T"},
    {"394", Style::white_board},
};

constexpr Entry swedish[]{
    {"a1", Style::warning, Symbol::bend_left},
    {"a5", Style::warning, Symbol::narrow},
    {"a13", Style::warning, Symbol::walker},
    {"a15", Style::warning, Symbol::walkers},
    {"a16", Style::warning, Symbol::bicycle},
    {"a20", Style::warning, Symbol::works},
    {"a22", Style::warning, Symbol::lights},
    {"a28", Style::warning, Symbol::crossroads},
    {"a30", Style::warning, Symbol::roundabout},
    {"a40", Style::warning, Symbol::exclamation},
    {"b1", Style::yield},
    {"b2", Style::stop},
    {"b3", Style::information, Symbol::walker_on_stripes},
    {"b4", Style::priority},
    {"b5", Style::priority_end},
    {"b6", Style::prohibition, Symbol::arrow_up},
    {"b7", Style::information, Symbol::arrow_up},
    {"c1", Style::no_entry},
    {"c2", Style::prohibition},
    {"c3", Style::prohibition, Symbol::two_cars},
    {"c7", Style::prohibition, Symbol::lorry},
    {"c10", Style::prohibition, Symbol::bicycle},
    {"c15", Style::prohibition, Symbol::walker},
    {"c27", Style::prohibition, Symbol::two_cars},
    {"c28", Style::prohibition_end, Symbol::two_cars},
    {"c31", Style::prohibition, Symbol::text},
    {"c32", Style::prohibition_end, Symbol::text},
    {"c35", Style::no_stopping},
    {"c39", Style::no_stopping, Symbol::crossroads},
    {"d1", Style::mandatory, Symbol::arrow_right},
    {"d2", Style::mandatory, Symbol::arrow_right},
    {"d3", Style::mandatory, Symbol::roundabout},
    {"d4", Style::mandatory, Symbol::bicycle},
    {"d5", Style::mandatory, Symbol::walker},
    {"e1", Style::information, Symbol::two_cars},
    {"e5", Style::information, Symbol::walkers},
    {"e7", Style::information, Symbol::walkers},
    {"e9", Style::information, Symbol::walkers},
    {"e16", Style::information, Symbol::arrow_up},
    {"e19", Style::information, Symbol::text, "P"},
};

constexpr Entry american[]{
    {"r1-1", Style::stop},
    {"r1-2", Style::yield},
    {"r2-1", Style::white_board, Symbol::text},
    {"r5-1", Style::no_entry},
    {"w1-1", Style::warning, Symbol::bend_left},
};

std::string number_text(double value) {
  if (!(value > 0.0) || value > 999.0) return {};
  return std::to_string(std::lround(value));
}

template <std::size_t Count>
const Entry* find(const Entry (&table)[Count], std::string_view number) {
  const auto found = std::ranges::find(table, number, &Entry::number);
  return found == std::end(table) ? nullptr : &*found;
}

SignFace face_of(const Entry& entry, const road::Signal& signal, double value) {
  SignFace face{entry.style, entry.symbol, std::string(entry.text)};
  if (face.symbol != Symbol::text || !face.text.empty()) return face;
  face.text = face.style == Style::place ? signal.text : number_text(value);
  if (face.text.empty()) face.symbol = Symbol::none;
  return face;
}

/// Category by the first letters of a number that no table has.
SignFace unknown(std::string_view country, std::string_view number) {
  if (number.empty()) return {};
  if (country == "de") {
    if (number.size() >= 3 && number[0] == '1') return {Style::warning, Symbol::exclamation, {}};
    return {};
  }
  if (country == "se" && number[0] == 'a') return {Style::warning, Symbol::exclamation, {}};
  return {};
}

}  // namespace

SignFace sign_face(const road::Signal& signal) {
  std::string country = lower(signal.country), type = lower(signal.type), subtype = lower(signal.subtype);
  const std::string name = lower(signal.name);
  double value = signal.value;
  // Names may hold the whole sign: "de_274-50".
  if ((type.empty() || type == "-1") && (name.starts_with("de_") || name.starts_with("se_"))) {
    country = name.substr(0, 2);
    const std::size_t dash = name.find('-', 3);
    type = name.substr(3, dash == std::string::npos ? std::string::npos : dash - 3);
    subtype.clear();
    if (dash != std::string::npos) value = std::strtod(name.c_str() + dash + 1, nullptr);
  }
  if (is_one_of(country, {"", "opendrive", "de", "deu", "ger", "germany", "276", "at", "aut"})) {
    const Entry* entry = find(german, type + "." + subtype);
    if (!entry) entry = find(german, type);
    if (!entry) return unknown("de", type);
    SignFace face = face_of(*entry, signal, value);
    // Subtypes of the arrows of 209 and 211: 10 to the left, 20 to the right, 30 straight on.
    if (face.symbol == Symbol::arrow_right && (subtype == "10" || subtype == "-10")) face.symbol = Symbol::arrow_left;
    if (face.symbol == Symbol::arrow_right && subtype == "30") face.symbol = Symbol::arrow_up;
    if (face.symbol == Symbol::bend_left && subtype == "20") face.symbol = Symbol::bend_right;
    // Subtypes of some files hold the limit: 274-55 is 50 km/h.
    if (type == "274" && face.text.empty() && subtype.size() == 2 && subtype[0] == '5')
      face = {Style::prohibition, Symbol::text, number_text(10.0 * (subtype[1] - '0'))};
    return face;
  }
  if (is_one_of(country, {"se", "swe", "sweden"})) {
    const std::string number = type.size() == 1 ? type + subtype : type;
    const Entry* entry = find(swedish, number.substr(0, number.find('-')));
    // Speeds may be given by the number of the variant: C31-5 is 50 km/h.
    if (entry && entry->number == "c31" && value > 0.0 && value < 15.0) value *= 10.0;
    SignFace face = entry ? face_of(*entry, signal, value) : unknown("se", number);
    face.yellow = true;
    return face;
  }
  if (is_one_of(country, {"us", "usa"})) {
    const Entry* entry = find(american, type);
    return entry ? face_of(*entry, signal, value) : SignFace{};
  }
  const bool is_speed = name.find("speed") != std::string::npos || signal.unit == "km/h" || signal.unit == "mph";
  if (is_speed && value > 0.0)
    return {name.find("lowest") != std::string::npos ? Style::mandatory : Style::prohibition, Symbol::text,
            number_text(value)};
  return {};
}

}  // namespace septet::scenery
