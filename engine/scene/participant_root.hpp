#pragma once
/// Roots of single participants (CONVENTIONS.md): what hangs on them, their paint, and the name by which editors mean
/// them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/scene/store.hpp"

namespace septet::scene {

/// Name of the prototype of a participant's number: `participant/NUMBER`. The root's is this behind prototype_prefix.
std::string participant_prototype(std::uint32_t number);
/// The number in such a name; empty: it is another prototype's.
std::optional<std::uint32_t> number_of_participant(std::string_view prototype);

/// Group and tag of a root by which its participant is named.
inline constexpr std::string_view participant_tag_group = "participant", participant_name_tag = "name";

/// Those that have a name, with their numbers.
std::vector<std::pair<std::string, std::uint32_t>> participant_names(const Store& store);

}  // namespace septet::scene
