#include "engine/scene/content_hash.hpp"

#include <doctest/doctest.h>

#include "engine/scene/builder.hpp"

namespace septet::scene {

TEST_CASE("stores of the same content hash alike however they came to it, and others do not") {
  Store straight, around;
  SceneBuilder build(straight), detour(around);
  const NodeId post = build.add_object("post", {});
  REQUIRE(detour.add_object("post", {}) == post);
  detour.apply(TransformSet{post, {{5.0, 0.0, 0.0}}});
  CHECK(content_hash(straight) != content_hash(around));
  detour.apply(TransformSet{post, {}});
  CHECK(straight.revision() != around.revision());
  CHECK(content_hash(straight) == content_hash(around));
  detour.apply(HideSet{post, true});
  CHECK(content_hash(straight) != content_hash(around));
}

}  // namespace septet::scene
