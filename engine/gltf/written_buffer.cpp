#include "engine/gltf/written_buffer.hpp"

#include <utility>

#include <nlohmann/json.hpp>

namespace septet::gltf {

Json json_list(const glm::vec3& v) { return {v.x, v.y, v.z}; }

std::size_t WrittenBuffer::view(std::span<const std::byte> values, int target) {
  bytes_.resize(whole_words(bytes_.size()));
  views_.push_back({bytes_.size(), values.size(), target});
  ByteWriter(bytes_).put_bytes(values);
  return views_.size() - 1;
}

std::size_t WrittenBuffer::accessor(const WrittenAccessor& accessor) {
  accessors_.push_back(accessor);
  return accessors_.size() - 1;
}

Bytes WrittenBuffer::finish(Json& file) {
  bytes_.resize(whole_words(bytes_.size()));
  file["buffers"] = {{{"byteLength", bytes_.size()}}};
  file["bufferViews"] = file["accessors"] = Json::array();
  for (const View& view : views_) {
    Json json = {{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.size}};
    if (view.target != no_target) json["target"] = view.target;
    file["bufferViews"].push_back(std::move(json));
  }
  for (const WrittenAccessor& of : accessors_) {
    Json json = {{"bufferView", of.view}, {"componentType", of.numbers}, {"count", of.count}, {"type", of.type}};
    if (of.offset > 0) json["byteOffset"] = of.offset;
    if (of.is_normalized) json["normalized"] = true;
    if (!of.least.empty()) json["min"] = of.least;
    if (!of.most.empty()) json["max"] = of.most;
    file["accessors"].push_back(std::move(json));
  }
  return std::move(bytes_);
}

}  // namespace septet::gltf
