#pragma once
/// Texts of small glTF files for tests.

#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sodium.h>

#include "engine/core/expected.hpp"

namespace septet::gltf {

inline std::string base64(std::string_view bytes) {
  std::string code(sodium_base64_encoded_len(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(code.data(), code.size(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                    sodium_base64_VARIANT_ORIGINAL);
  code.pop_back();
  return code;
}

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

/// Why own.glb was refused; empty: it was read.
template <class T>
std::string why_refused(const Expected<T>& model) {
  if (model) return "";
  CHECK(model.error().where.starts_with("own.glb"));
  CHECK_FALSE(model.error().remedy.empty());
  return model.error().what;
}

/// Text of a file; each part is JSON, and defaults are those of one triangle.
struct File {
  std::string positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  std::string nodes = R"([{"mesh":0}])";
  std::string scene_nodes = "[0]";
  std::string primitives = R"([{"attributes":{"POSITION":0}}])";
  std::string accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}])";
  std::string more;
  std::string views;

  std::string text() const {
    const std::string view_list =
        views.empty() ? fmt::format(R"([{{"buffer":0,"byteLength":{}}}])", positions.size()) : views;
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":{}}}],"nodes":{},"meshes":[{{"primitives":{}}}],)"
        R"("accessors":{},"bufferViews":{},{}"buffers":[{{"byteLength":{},"uri":"data:;base64,{}"}}]}})",
        scene_nodes, nodes, primitives, accessors, view_list, more, positions.size(), base64(positions));
  }
};

}  // namespace septet::gltf
