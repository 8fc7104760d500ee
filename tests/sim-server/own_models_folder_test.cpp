#include "sim-server/drive/own_models_folder.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::server {
namespace {

/// One triangle of 1 m, as a whole file.
constexpr const char* triangle =
    R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
    R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

}  // namespace

TEST_CASE("a folder of own models is read by name, and a size that is not the vehicle's is told") {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  write(folder / "saloon.gltf", triangle);
  write(folder / "oak.GLTF", triangle);
  write(folder / "notes.txt", "not a model");
  const auto read = read_own_models(folder);
  REQUIRE(read.has_value());
  CHECK(read->models.size() == 2);
  CHECK(read->models.contains("oak"));
  REQUIRE(read->messages.size() == 1);
  CHECK(read->messages[0].find("saloon.gltf: it is 0.00 m long, 1.00 m wide and 1.00 m high") != std::string::npos);
}

TEST_CASE("a model that nothing is called by, that is damaged, or that is there twice is told with its file") {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  CHECK(read_own_models(folder / "none").error().where == "--models");
  write(folder / "salon.glb", triangle);
  const auto unknown = read_own_models(folder);
  REQUIRE_FALSE(unknown.has_value());
  CHECK(unknown.error().what == "nothing is called \"salon\"");
  CHECK(unknown.error().remedy.find("saloon") != std::string::npos);
  std::filesystem::rename(folder / "salon.glb", folder / "saloon.glb");
  write(folder / "saloon.gltf", triangle);
  CHECK(read_own_models(folder).error().what == "saloon is replaced by two files");
  write(folder / "saloon.glb", std::string(triangle).substr(0, 200));
  CHECK(read_own_models(folder).error().where.find("saloon.glb") != std::string::npos);
  std::filesystem::remove(folder / "saloon.glb");
  std::filesystem::remove(folder / "saloon.gltf");
  std::filesystem::create_directory(folder / "birch.glb");
  CHECK_FALSE(read_own_models(folder).has_value());
}

}  // namespace septet::server
