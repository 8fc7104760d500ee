#pragma once
/// The binary chunk of a file that is written, and what the file says of it: buffer views and accessors (glTF 2.0,
/// 3.6).

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/bytes.hpp"
#include "engine/gltf/container.hpp"

namespace septet::gltf {

/// The file has y up, z forward and x left (3.4).
inline glm::vec3 file_axes(const glm::vec3& v) { return {v.y, v.z, v.x}; }
inline Json json_list(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// Chunks and views begin at multiples of four bytes.
constexpr std::size_t whole_words(std::size_t size) { return (size + 3) / 4 * 4; }

class WrittenBuffer {
 public:
  /// Numbers of the format (3.6.2.2, 3.6.1.2 and 5.18.2).
  static constexpr int unsigned_bytes = 5121, unsigned_ints = 5125, floats = 5126;
  static constexpr int no_target = 0, vertex_data = 34962, index_data = 34963;

  template <class Value>
  std::size_t view(const std::vector<Value>& values, int target) {
    return view(std::as_bytes(std::span(values)), target);
  }
  std::size_t view(std::span<const std::byte> values, int target) {
    bytes_.resize(whole_words(bytes_.size()));
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size()}};
    if (target != no_target) view["target"] = target;
    ByteWriter(bytes_).put_bytes(values);
    views_.push_back(std::move(view));
    return views_.size() - 1;
  }
  std::size_t accessor(std::size_t view, int numbers, std::size_t count, const char* type, std::size_t offset = 0) {
    accessors_.push_back({{"bufferView", view}, {"componentType", numbers}, {"count", count}, {"type", type}});
    if (offset > 0) accessors_.back()["byteOffset"] = offset;
    return accessors_.size() - 1;
  }
  Json& last_accessor() { return accessors_.back(); }

  /// The bytes; `file` gets what it says of them.
  Bytes finish(Json& file) {
    bytes_.resize(whole_words(bytes_.size()));
    file["buffers"] = {{{"byteLength", bytes_.size()}}};
    file["bufferViews"] = std::move(views_);
    file["accessors"] = std::move(accessors_);
    return std::move(bytes_);
  }

 private:
  Bytes bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

}  // namespace septet::gltf
