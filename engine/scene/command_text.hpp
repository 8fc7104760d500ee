#pragma once
/// Commands as lines of text: the one form in which people, files of edits, scripts and tests write them.
///
///     node-create +0 object
///     node-name-set +0 stimuli/ball
///     transform-set +0 12.5 -3 0
///     hide-set tree/412.5/-81.0 1
///     tag-set material:"sign/stop" 0 1 roughness real 0.4
///
/// The command's name with hyphens, then its fields in the order of COMMANDS.md: numbers, 0 and 1 for flags, alternatives
/// and types of nodes by their words, bytes as hexadecimal digits, words with blanks or quotes in them as "…" with \" \\ \n
/// and \xNN. A transform ends after its position, or has its rotation w x y z, its scale, or both behind it.
///
/// A node is #ID, +N (id N of the editor's own), none, or a name: that of an object, or with its type before it
/// (geometry:NAME, material:NAME, bitmap:NAME). Names are looked up when a line is read.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// Words of a line, without their quotes; error: a quote without its end, an unknown escape. A line of nothing or one that
/// begins with # has none. A word that was quoted whole is never a #ID, +N or none.
struct TextWord {
  std::string text;
  bool quoted = false;
};
Expected<std::vector<TextWord>> words_of(std::string_view line);

/// The word as `words_of` reads it back.
std::string quoted_if_needed(std::string_view text);

/// What "+0" is, and whose names count.
struct TextNames {
  const Store& store;
  NodeId own_ids = 0;  ///< 0: there are no own ones.
  /// Numbers behind + that are written for some nodes; null: none.
  const std::map<NodeId, std::uint32_t>* numbers = nullptr;
  /// Objects known by a name before the store has it; null: none.
  const std::map<std::string, NodeId, std::less<>>* fresh = nullptr;
};

/// The node that a word means; empty: there is none of that name. A #ID need not exist.
std::optional<NodeId> node_of(const TextNames& names, const TextWord& word);
/// +N, a name that no other node of the type has before it, or #ID.
std::string word_of(const TextNames& names, NodeId node);

std::string to_text(const Command& command, const TextNames& names);
/// True if a line with this first word is a command.
bool is_command_word(std::string_view word);
/// Error: which word is wrong, and what is expected. A command read is valid (command_validation.hpp).
Expected<Command> command_from_words(const std::vector<TextWord>& words, const TextNames& names);

}  // namespace septet::scene
