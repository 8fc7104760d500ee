#pragma once
/// The container of a glTF file: its JSON, and the bytes of its buffers (glTF 2.0, chapters 4 and 3.6.1).

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/core/expected.hpp"

namespace septet::gltf {

using Json = nlohmann::json;  ///< Members sorted by name: a file may have any number.

/// The remedy for an exporter's mistake.
inline constexpr const char* export_anew = "export it anew as glTF 2.0 binary (.glb)";

struct Container {
  std::shared_ptr<const Json> json;  ///< An object.
  std::vector<std::string> buffers;  ///< In the file's order.
  std::string where;                 ///< The file's name, for errors.
};

Expected<Container> open_container(std::string_view bytes, std::string_view where);

/// The elements of a list of the file's root, or of `json`'s; empty where there is no such list.
const Json& list_of(const Json& json, const char* name);

/// An object that is an object's member, or one of its extensions; an empty one where there is none.
const Json& member_of(const Json& object, const char* name);
const Json& extension_in(const Json& object, const char* name);

/// A whole number ≥ 0 of an object; `otherwise` where it is absent. Any other value is −1, an index to nothing.
std::int64_t index_in(const Json& object, const char* name, std::int64_t otherwise = -1);

/// A finite number of an object, or `otherwise`.
double number_in(const Json& object, const char* name, double otherwise);

/// A text of an object; empty where there is none.
std::string text_in(const Json& object, const char* name);
/// False where there is no such member, or one of another kind.
bool is_true_in(const Json& object, const char* name);

/// The bytes of a data: URI. Error: another kind of URI, or invalid base64.
Expected<std::string> bytes_of_uri(const std::string& uri, const std::string& where);

/// The bytes of a buffer view. Error: there is no such view, or it reaches beyond its buffer.
Expected<std::string_view> view_bytes(const Container& container, std::int64_t view, const std::string& where);

}  // namespace septet::gltf
