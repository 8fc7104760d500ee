#pragma once
/// What the holder of a key may do, as words behind its name in the list of allowed clients:
///
///     KEY NAME                                            a screen of the rig, or its car
///     KEY NAME look                                       reads the scene and all ticks
///     KEY NAME operate                                    marks, pauses and commands the drive as its operator does
///     KEY NAME edit [PREFIX…] [hide] [move] [paint] [create] [solid]
///                                                         changes the scene as well
///
/// `operate` may also stand behind `look` and `edit`. Without a prefix an editor may change what the world was generated
/// with; with prefixes, the nodes whose names begin with one of them. `solid`: decides what of the scene can be hit.
/// Without any of the five words it may do all five. What it made is its own.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace septet::net {

enum class EditKind : std::uint8_t { hide, move, paint, create, solid };
inline constexpr std::uint8_t all_edit_kinds = 0b11111;

std::string_view name_of(EditKind kind);

struct EditRights {
  std::vector<std::string> prefixes{};
  std::uint8_t kinds = all_edit_kinds;  ///< Bit k is EditKind k.

  bool includes(EditKind kind) const { return kinds >> static_cast<int>(kind) & 1; }
  /// True if the name begins with one of the prefixes.
  bool names(std::string_view name) const;
};

/// Rights beyond those of a screen.
struct Rights {
  bool may_look = false;           ///< May read without being a screen of the rig; an editor may.
  std::optional<EditRights> edit;  ///< Empty: it changes nothing.
  bool may_operate = false;
};

/// Returns the first word that is no right in its place where there is one.
struct RightsWords {
  Rights rights;
  std::optional<std::string> bad;
};
RightsWords read_rights(std::span<const std::string> words);

/// For people: "looks", "may hide, move below tree/".
std::string describe(const Rights& rights);

}  // namespace septet::net
