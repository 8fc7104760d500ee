#include "engine/net/rights.hpp"

#include <algorithm>
#include <array>

namespace septet::net {
namespace {

constexpr std::array<std::string_view, 5> kind_names{"hide", "move", "paint", "create", "solid"};
constexpr std::string_view operate = "operate";

}  // namespace

std::string_view name_of(EditKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

bool EditRights::names(std::string_view name) const {
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) { return name.starts_with(prefix); });
}

RightsWords read_rights(std::span<const std::string> words) {
  RightsWords read;
  if (words.empty()) return read;
  read.rights.may_look = true;
  read.rights.may_operate = std::ranges::find(words, operate) != words.end();
  if (words[0] == "look" || words[0] == operate) {
    const auto bad = std::ranges::find_if(words.subspan(1), [](const std::string& word) { return word != operate; });
    if (bad != words.subspan(1).end()) read.bad = *bad;
    return read;
  }
  if (words[0] != "edit") {
    read.bad = words[0];
    return read;
  }
  EditRights edit{{}, 0};
  for (const std::string& word : words.subspan(1)) {
    const auto kind = std::ranges::find(kind_names, word);
    if (kind != kind_names.end())
      edit.kinds = static_cast<std::uint8_t>(edit.kinds | 1u << (kind - kind_names.begin()));
    else if (word.find('/') != std::string::npos)
      edit.prefixes.push_back(word);
    else if (!read.bad && word != operate)
      read.bad = word;
  }
  if (edit.kinds == 0) edit.kinds = all_edit_kinds;
  read.rights.edit = std::move(edit);
  return read;
}

std::string describe(const Rights& rights) {
  if (!rights.edit)
    return rights.may_operate ? "looks and operates" : rights.may_look ? "looks" : "is a screen or the car";
  std::string text = "may";
  for (std::size_t k = 0; k < kind_names.size(); ++k)
    if (rights.edit->includes(static_cast<EditKind>(k))) {
      text += text == "may" ? " " : ", ";
      text += kind_names[k];
    }
  for (const std::string& prefix : rights.edit->prefixes) {
    text += &prefix == rights.edit->prefixes.data() ? " below " : ", ";
    text += prefix;
  }
  if (rights.may_operate) text += ", and operates";
  return text;
}

}  // namespace septet::net
