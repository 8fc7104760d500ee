#include "engine/gltf/container.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <sodium.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/gltf.hpp"
#include "engine/gltf/passed_over.hpp"

namespace septet::gltf {
namespace {

constexpr std::size_t most_buffers = 16, most_json_values = 1'000'000;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

/// Upper bound of the values in a JSON text: the size of its tree is known before it is made.
std::size_t values_in(std::string_view json) {
  std::size_t values = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\')
      ++i;
    else if (c == '"')
      in_text = !in_text;
    else if (!in_text && (c == ',' || c == '[' || c == '{'))
      ++values;
  }
  return values;
}

struct Chunks {
  std::string_view json, binary;
};

/// Error: it is cut off, or not glTF.
Expected<Chunks> chunks_of(std::string_view bytes, const std::string& where) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && bytes[first] == '{') return Chunks{bytes, {}};
  if (!bytes.starts_with("glTF") || bytes.size() < 20)
    return failure("this is no glTF file", where, "give a .glb or .gltf of glTF 2.0");
  if (const std::uint32_t version = little_endian(bytes, 4); version != 2)
    return failure(fmt::format("its version is {}", version), where, export_anew);
  const std::uint64_t length = little_endian(bytes, 8);
  if (length > bytes.size())
    return failure(fmt::format("the file ends after {} of {} bytes", bytes.size(), length), where,
                   "copy it again, whole");
  Chunks chunks;
  for (std::uint64_t at = 12; at + 8 <= length;) {
    const std::uint64_t size = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    at += 8;
    if (size > length - at)
      return failure(fmt::format("a chunk of {} bytes begins {} bytes before the end", size, length - at), where,
                     export_anew);
    const std::string_view chunk = bytes.substr(at, size);
    if (type == 0x4E4F534Au && chunks.json.empty())  // "JSON"
      chunks.json = chunk;
    else if (type == 0x004E4942u && chunks.binary.empty())  // "BIN"
      chunks.binary = chunk;
    at += size;
  }
  return chunks;
}

Expected<std::string> buffer_bytes(const Json& buffer, std::size_t index, std::string_view binary,
                                   const std::string& file) {
  const std::string where = fmt::format("{}, buffer {}", file, index);
  const std::int64_t length = index_in(buffer, "byteLength");
  if (length < 0) return failure("it has no byteLength", where, export_anew);
  std::string bytes;
  if (buffer.contains("uri")) {
    auto decoded = bytes_of_uri(text_in(buffer, "uri"), where);
    if (!decoded) return decoded;
    bytes = std::move(*decoded);
  } else if (index == 0 && !binary.empty()) {
    bytes = binary;
  } else {
    return failure("its bytes are not in the file", where, export_anew);
  }
  if (bytes.size() < static_cast<std::uint64_t>(length))
    return failure(fmt::format("it has {} of {} bytes", bytes.size(), length), where, "copy it again, whole");
  bytes.resize(static_cast<std::size_t>(length));
  return bytes;
}

}  // namespace

const Json& list_of(const Json& json, const char* name) {
  static const Json none = Json::array();
  if (!json.is_object()) return none;
  const auto found = json.find(name);
  return found != json.end() && found->is_array() ? *found : none;
}

const Json& member_of(const Json& object, const char* name) {
  static const Json none = Json::object();
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found != object.end() && found->is_object() ? *found : none;
}

const Json& extension_in(const Json& object, const char* name) {
  return member_of(member_of(object, "extensions"), name);
}

std::int64_t index_in(const Json& object, const char* name, std::int64_t otherwise) {
  if (!object.is_object()) return otherwise;
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > 0xFFFFFFFFu) return -1;
  return found->get<std::int64_t>();
}

double number_in(const Json& object, const char* name, double otherwise) {
  if (!object.is_object()) return otherwise;
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number()) return otherwise;
  const auto value = found->get<double>();
  return std::isfinite(value) ? value : otherwise;
}

bool is_true_in(const Json& object, const char* name) {
  if (!object.is_object()) return false;
  const auto found = object.find(name);
  return found != object.end() && found->is_boolean() && found->get<bool>();
}

std::string text_in(const Json& object, const char* name) {
  if (!object.is_object()) return {};
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

Expected<std::string> bytes_of_uri(const std::string& uri, const std::string& where) {
  const std::size_t comma = uri.find(";base64,");
  if (!uri.starts_with("data:") || comma == std::string::npos)
    return failure(fmt::format("it lies in another file, \"{}\", which is never opened", printable(uri, 80)), where,
                   "export it as one file: glTF binary (.glb)");
  const std::string_view code = std::string_view(uri).substr(comma + 8);
  std::string bytes(code.size() / 4 * 3 + 3, '\0');
  std::size_t size = 0;
  if (sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), code.data(), code.size(), nullptr,
                        &size, nullptr, sodium_base64_VARIANT_ORIGINAL) != 0)
    return failure("its data: URI is no base64", where, export_anew);
  bytes.resize(size);
  return bytes;
}

Expected<std::string_view> view_bytes(const Container& container, std::int64_t view, const std::string& where) {
  const Json& views = list_of(*container.json, "bufferViews");
  if (view < 0 || static_cast<std::uint64_t>(view) >= views.size())
    return failure(fmt::format("it has no buffer view of the file's {}", views.size()), where, export_anew);
  const Json& json = views[static_cast<std::size_t>(view)];
  const std::int64_t buffer = index_in(json, "buffer"), offset = index_in(json, "byteOffset", 0),
                     length = index_in(json, "byteLength");
  if (buffer < 0 || static_cast<std::uint64_t>(buffer) >= container.buffers.size())
    return failure(fmt::format("its buffer view {} has no buffer of the file's {}", view, container.buffers.size()),
                   where, export_anew);
  const std::string& bytes = container.buffers[static_cast<std::size_t>(buffer)];
  if (offset < 0 || length < 0 || static_cast<std::uint64_t>(offset + length) > bytes.size())
    return failure(fmt::format("its buffer view {} reaches beyond buffer {} of {} bytes", view, buffer, bytes.size()),
                   where, export_anew);
  return std::string_view(bytes).substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

Expected<Container> open_container(std::string_view bytes, std::string_view where_text) {
  Container container;
  container.where = where_text;
  const std::string& where = container.where;
  if (bytes.size() > largest_file_bytes)
    return failure(fmt::format("it has {} bytes, more than {}", bytes.size(), largest_file_bytes), where,
                   "leave away what is not seen from a road, and make its textures smaller");
  const auto chunks = chunks_of(bytes, where);
  if (!chunks) return tl::unexpected(chunks.error());
  if (values_in(chunks->json) > most_json_values)
    return failure(fmt::format("its JSON holds more than {} values", most_json_values), where,
                   "join its meshes and nodes in a modelling program");
  container.json = std::make_shared<const Json>(Json::parse(chunks->json, nullptr, false));
  const Json& json = *container.json;
  if (!json.is_object()) return failure("its JSON cannot be read", where, export_anew);
  static const Json nothing = Json::object();
  const Json& asset = json.contains("asset") ? json["asset"] : nothing;
  const std::string version = text_in(asset, "version");
  if (!version.starts_with("2."))
    return failure(
        version.empty() ? "it names no version of glTF" : fmt::format("it is of glTF {}", printable(version, 20)),
        where, export_anew);
  if (const std::string least = text_in(asset, "minVersion");
      !least.empty() && least != "2.0")  // 3.2: it is not loaded.
    return failure(fmt::format("it requires glTF {}", printable(least, 20)), where, export_anew);
  // Before the buffers, which a compression leaves empty.
  if (auto known = check_required_extensions(container); !known) return tl::unexpected(known.error());
  const Json& buffers = list_of(json, "buffers");
  if (buffers.size() > most_buffers)
    return failure(fmt::format("it has {} buffers, more than {}", buffers.size(), most_buffers), where, export_anew);
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    auto read = buffer_bytes(buffers[i], i, chunks->binary, where);
    if (!read) return tl::unexpected(read.error());
    container.buffers.push_back(std::move(*read));
  }
  return container;
}

}  // namespace septet::gltf
