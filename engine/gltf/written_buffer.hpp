#pragma once
/// The binary chunk of a file that is written, and what the file says of it: buffer views and accessors (glTF 2.0,
/// 3.6).

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/core/bytes.hpp"
#include "engine/gltf/container.hpp"

namespace septet::gltf {

/// The file has y up, z forward and x left (3.4).
inline glm::vec3 file_axes(const glm::vec3& v) { return {v.y, v.z, v.x}; }
Json json_list(const glm::vec3& v);

/// Chunks and views begin at multiples of four bytes.
constexpr std::size_t whole_words(std::size_t size) { return (size + 3) / 4 * 4; }

/// Rows of numbers in a view.
struct WrittenAccessor {
  std::size_t view = 0;
  int numbers = 0;  ///< WrittenBuffer::floats and the like.
  std::size_t count = 0;
  const char* type = "SCALAR";
  std::size_t offset = 0;
  bool is_normalized = false;
  std::vector<float> least{}, most{};  ///< Of each number of a row; empty: not told.
};

class WrittenBuffer {
 public:
  /// Numbers of the format (3.6.2.2, 3.6.1.2 and 5.18.2).
  static constexpr int unsigned_bytes = 5121, unsigned_ints = 5125, floats = 5126;
  static constexpr int no_target = 0, vertex_data = 34962, index_data = 34963;

  template <class Value>
  std::size_t view(const std::vector<Value>& values, int target) {
    return view(std::as_bytes(std::span(values)), target);
  }
  /// Both return the number by which the file knows it.
  std::size_t view(std::span<const std::byte> values, int target);
  std::size_t accessor(const WrittenAccessor& accessor);

  /// The bytes; `file` gets what it says of them.
  Bytes finish(Json& file);

 private:
  struct View {
    std::size_t offset, size;
    int target;
  };
  Bytes bytes_;
  std::vector<View> views_;
  std::vector<WrittenAccessor> accessors_;
};

}  // namespace septet::gltf
