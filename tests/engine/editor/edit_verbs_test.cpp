#include "engine/editor/edit_verbs.hpp"

#include <fnmatch.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/core/random.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/edit_file.hpp"
#include "engine/scene/inverse.hpp"
#include "engine/scene/solid_box.hpp"
#include "engine/world/solid.hpp"

namespace septet::editor {
namespace {

constexpr scene::NodeId own_ids = 1000;

/// One editor's lines, each done to the scene at once.
struct EditedWorld {
  scene::Store store;
  EditNames names{own_ids, own_ids};
  Snapshot now{};

  Expected<EditedLine> take(std::string_view line) {
    auto edit = edit_of(scene::words_of(line).value(), store, names);
    if (!edit) return edit;
    for (const scene::Command& command : edit->commands) REQUIRE(store.apply(command).has_value());
    return edit;
  }
  std::vector<std::string> find(std::string_view what) const {
    const auto found = found_nodes(scene::words_of(fmt::format("find {}", what)).value(), store, now);
    REQUIRE(found.has_value());
    std::vector<std::string> called;
    called.reserve(found->size());
    for (const scene::NodeId id : *found) called.push_back(store.find(id)->name);
    std::ranges::sort(called);
    return called;
  }
};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a pattern finds the names that a shell's pattern fits, whole, and no others") {
  EditedWorld editor;
  scene::SceneBuilder build(editor.store);
  Names all{"a", "b"};
  all.reserve(30);
  for (std::size_t i = 0; all[i].size() < 4; ++i)
    for (const char* letter : {"a", "b"}) all.push_back(all[i] + letter);
  for (const std::string& name : all) build.add_object(name, {});
  std::ranges::sort(all);
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    std::string pattern(1 + random.below(6), '*');
    for (char& letter : pattern) letter = "ab*?"[random.below(4)];
    CAPTURE(pattern);
    Names fit;
    std::ranges::copy_if(all, std::back_inserter(fit),
                         [&](const std::string& name) { return fnmatch(pattern.c_str(), name.c_str(), 0) == 0; });
    CHECK(editor.find(pattern) == fit);
  }
}

TEST_CASE("what lies within so many metres of a place is found, whatever its height") {
  EditedWorld editor;
  for (const char* line : {"create at 3 4 100", "create beyond 3.1 4 0", "create away -40 0 0"})
    REQUIRE(editor.take(line).has_value());
  CHECK(editor.find("near 0 0 5") == Names{"at"});
  CHECK(editor.find("* near 0 0 6") == Names{"at", "beyond"});
  CHECK(editor.find("b* near 0 0 6") == Names{"beyond"});
}

TEST_CASE("what goes or was pushed is found where it is at the tick, and no more where it was placed") {
  EditedWorld world;
  REQUIRE(world.take("create box 10 0 1"));
  REQUIRE(world.take("create ball 0 0 0"));
  const scene::NodeId ball = world.names.fresh.find("ball")->second;
  REQUIRE(world.store.apply(scene::MotionSet{ball, {.legs = {{.velocity_mps = {10.0, 0.0, 0.0}}}}}));
  world.now.simulated_time_s = 2.0;
  CHECK(world.find("* near 20 0 0.1") == Names{"ball"});
  CHECK(world.find("ball near 0 0 0.1").empty());

  const scene::NodeId box = world.names.fresh.find("box")->second;
  REQUIRE(world.take("solid box 20"));
  REQUIRE(world.store.apply(scene::TagSet{box, 0xFF00, 2, {"participant", first_solid_participant}}));
  REQUIRE(world.store.apply(scene::TagSet{box, 0xFF00, 3, {"foot_m", Vec3(0.0, 0.0, -1.0)}}));
  CHECK(world.find("* near 10 0 0.1") == Names{"box"});
  Participant pushed;
  pushed.id = first_solid_participant;
  pushed.world_from_vehicle.position_m = {30.0, 5.0, 0.0};
  pushed.lamps.set(Lamp::brake, true);
  world.now.participants = {pushed};
  CHECK(world.find("* near 30 5 0.1") == Names{"box"});
  CHECK(world.find("* near 10 0 0.1").empty());
}

TEST_CASE("a colour has parts from 0 to 1, and a picture that is not there is to be looked for") {
  EditedWorld world;
  REQUIRE(world.take("board b 1 1"));
  CHECK(world.take("color b 1 0 0.5"));
  for (const char* line : {"color b 2 0 0", "color b 0 0 -0.1", "color b 1 1", "repaint 1 0 0 1.5"}) {
    const auto refused = world.take(line);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what.find("from 0 to 1") != std::string::npos);
  }
  CHECK(world.take("repaint 1 0 0 1"));
  CHECK(world.take("picture b /nowhere/none.png").error().remedy == "check that the file exists and can be read");
}

TEST_CASE("a board is from a millimetre to a kilometre wide and high, and stands where it is said or at the origin") {
  for (const char* size : {"0.001 1000", "1000 0.001", "2 1", "2 1 3 4 5", "2 1 3 4 5 90"}) {
    CAPTURE(size);
    EditedWorld editor;
    CHECK(editor.take(fmt::format("board sign {}", size)).has_value());
  }
  for (const char* size : {"0.0009 1", "1 0.0009", "1000.1 1", "1 1000.1", "-1 1", "1 -1", "nan 1", "1 wide", "1",
                           "2 1 3", "2 1 3 4", "2 1 3 4 up", "0 1 3 4 5", "2 1 3 4 5 90 6"}) {
    CAPTURE(size);
    EditedWorld editor;
    CHECK_FALSE(editor.take(fmt::format("board sign {}", size)).has_value());
    CHECK(editor.store.nodes().empty());
  }
}

TEST_CASE("a participant is hidden by its number, and shown again at the same root") {
  EditedWorld editor;
  REQUIRE(editor.take("hide 7").has_value());
  const scene::Node* root = editor.store.find(scene::NodeType::object, "model/participant/7");
  REQUIRE(root);
  CHECK(std::get<scene::ObjectData>(root->data).hidden);
  REQUIRE(editor.take("show 7").has_value());
  CHECK_FALSE(std::get<scene::ObjectData>(root->data).hidden);
  CHECK(editor.store.nodes().size() == 1);
  CHECK_FALSE(editor.take("hide nobody").has_value());
}

TEST_CASE("what is made under a name again takes the place of what had it, with all its parts") {
  EditedWorld editor;
  REQUIRE(editor.take("board sign 2 1").has_value());
  const std::size_t parts = editor.store.nodes().size();
  REQUIRE(parts > 1);
  REQUIRE(editor.take("board sign 3 1 5 0 0").has_value());
  CHECK(editor.store.nodes().size() == parts);
  REQUIRE(editor.take("text sign HELLO").has_value());
  REQUIRE(editor.take("create sign").has_value());
  CHECK(editor.store.nodes().size() == 1);  // The picture of the text has gone as well.
  REQUIRE(editor.take("remove sign").has_value());
  CHECK(editor.store.nodes().empty());
}

TEST_CASE("a hundred texts on a sign leave as many nodes as one, in batches of their own and in one batch") {
  EditedWorld editor;
  REQUIRE(editor.take("board sign 2 1").has_value());
  REQUIRE(editor.take("text sign 0").has_value());
  const std::size_t nodes = editor.store.nodes().size();
  const auto save_bytes = [&] { return scene::edits_between(scene::Store{}, editor.store).size(); };
  const std::size_t bytes = save_bytes();
  for (int i = 1; i <= 100; ++i) REQUIRE(editor.take(fmt::format("text sign {}", i % 10)).has_value());
  CHECK(editor.store.nodes().size() == nodes);
  CHECK(save_bytes() < bytes + bytes / 10);
  // A batch's lines are read before the scene has any of it.
  EditedWorld at_once;
  std::vector<scene::Command> batch;
  for (int i = 0; i <= 100; ++i) {
    const std::string line = i == 0 ? "board sign 2 1" : fmt::format("text sign {}", i);
    const auto edit = edit_of(scene::words_of(line).value(), at_once.store, at_once.names);
    REQUIRE(edit.has_value());
    batch.insert(batch.end(), edit->commands.begin(), edit->commands.end());
  }
  for (const scene::Command& command : batch) REQUIRE(at_once.store.apply(command).has_value());
  CHECK(at_once.store.nodes().size() == nodes);
}

TEST_CASE("a new look leaves what another thing wears, and takes a colour's place as a picture's") {
  EditedWorld editor;
  for (const char* line : {"board a 2 1", "text a one"}) REQUIRE(editor.take(line).has_value());
  const std::size_t one_sign = editor.store.nodes().size();
  const auto material_of = [&](std::string_view name) {
    const auto& links = std::get<scene::ObjectData>(editor.store.find(scene::NodeType::object, name)->data).links;
    const auto worn = std::ranges::find_if(links, [](const auto& link) { return link.second.label == "material"; });
    return worn->second.target;
  };
  REQUIRE(editor.take("like b a").has_value());
  const scene::NodeId shared = material_of("b");
  REQUIRE(editor.take("text a two").has_value());
  CHECK(material_of("b") == shared);
  CHECK(editor.store.find(shared) != nullptr);
  CHECK(editor.store.nodes().size() == one_sign + 3);  // The object b, and a's own material and picture.
  REQUIRE(editor.take("text b three").has_value());
  CHECK(editor.store.find(shared) == nullptr);
  CHECK(editor.store.nodes().size() == one_sign + 3);
  for (const char* line : {"color a 1 0 0", "color a 0 1 0", "color b 1 0 0"}) REQUIRE(editor.take(line).has_value());
  CHECK(editor.store.nodes().size() == one_sign + 1);  // Two objects, a shape, two materials.
  REQUIRE(editor.take("text a four").has_value());
  CHECK(editor.store.nodes().size() == one_sign + 2);
}

TEST_CASE("undoing a text brings the one before back, and the next text takes its place") {
  EditedWorld editor;
  for (const char* line : {"board a 2 1", "text a one"}) REQUIRE(editor.take(line).has_value());
  const scene::Store before = editor.store;
  const auto edit = edit_of(scene::words_of("text a two").value(), editor.store, editor.names);
  REQUIRE(edit.has_value());
  const auto inverse = scene::apply_whole(editor.store, edit->commands);
  REQUIRE(inverse.has_value());
  CHECK_FALSE(scene::same_content(editor.store, before));
  scene::undo(editor.store, *inverse);
  CHECK(scene::same_content(editor.store, before));
  editor.names.paints.worn.clear();  // As an editor does whose mirror is whole.
  REQUIRE(editor.take("text a three").has_value());
  CHECK(editor.store.nodes().size() == before.nodes().size());
}

TEST_CASE("an editor that has gone through its ids begins anew behind things that are there still") {
  EditedWorld editor;
  REQUIRE(editor.take("board sign 2 1").has_value());
  editor.names.next = own_ids + replication::ids_per_session - 2049;
  for (int i = 0; i < 3; ++i) REQUIRE(editor.take(fmt::format("text sign {}", i)).has_value());
  REQUIRE(editor.take("create post").has_value());
  CHECK(editor.store.find(scene::NodeType::object, "sign") != nullptr);
  CHECK(editor.store.find(scene::NodeType::object, "post")->id < own_ids + 100);
}

TEST_CASE(
    "a thing like another one shares its shape, children and looks, at a place of its own, and neither name nor "
    "solidity") {
  EditedWorld editor;
  scene::SceneBuilder build(editor.store);
  const scene::NodeId shape = build.add_mesh("oak", {}),
                      near = build.add_object("tree/1/2", {.geometry = shape, .visible_to_m = 80.0f});
  build.apply(scene::TransformSet{near, {{1.0, 2.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, glm::vec3(1.5f)}});
  const scene::NodeId far = build.add_object("tree far", {.geometry = shape});
  build.add_child(near, far);
  REQUIRE(editor.take("solid tree/1/2").has_value());
  const std::size_t nodes = editor.store.nodes().size();
  REQUIRE(editor.take("like my/oak tree/1/2 10 20 3 90").has_value());
  CHECK(editor.store.nodes().size() == nodes + 1);
  const scene::Node* made = editor.store.find(scene::NodeType::object, "my/oak");
  REQUIRE(made);
  const auto& object = std::get<scene::ObjectData>(made->data);
  CHECK(object.links == std::get<scene::ObjectData>(editor.store.find(near)->data).links);
  CHECK(object.transform.position_m == Vec3(10.0, 20.0, 3.0));
  CHECK(object.transform.scale == glm::vec3(1.5f));
  CHECK((object.transform.rotation * Vec3(1.0, 0.0, 0.0)).y == doctest::Approx(1.0));
  CHECK_FALSE(scene::is_tagged_solid(*made));
  CHECK(made->tag_groups.size() == 1);  // How far it is seen.
  // It is removed alone.
  REQUIRE(editor.take("remove my/oak").has_value());
  CHECK(editor.store.nodes().size() == nodes);
  for (const char* line : {"like x", "like x nobody 1 2 3", "like x tree/1/2 1 2", "like x geometry:oak 1 2 3"})
    CHECK_FALSE_MESSAGE(editor.take(line).has_value(), line);
}

TEST_CASE("a lifetime ends what a line before it in its batch makes, as it ends what is there, with all parts") {
  const auto lifetime = [](const EditedWorld& editor, std::string_view line) {
    return lifetime_of(scene::words_of(line).value(), editor.store, editor.names);
  };
  EditedWorld there, coming;
  REQUIRE(there.take("board sign 2 1").has_value());
  const auto made = edit_of(scene::words_of("board sign 2 1").value(), coming.store, coming.names);
  REQUIRE(made.has_value());
  const auto of_there = lifetime(there, "lifetime sign 2.5"), of_coming = lifetime(coming, "lifetime sign 2.5");
  REQUIRE(of_there.has_value());
  REQUIRE(of_coming.has_value());
  CHECK(of_there->seconds == 2.5);
  CHECK(of_there->node == of_coming->node);
  const auto removal = removal_of(of_there->node, there.store, own_ids, {});
  CHECK(removal == removal_of(of_coming->node, coming.store, own_ids, made->commands));
  for (const scene::Command& command : removal) REQUIRE(there.store.apply(command).has_value());
  CHECK(there.store.nodes().empty());
  for (const char* line : {"lifetime sign 0", "lifetime sign -1", "lifetime sign nan", "lifetime sign 1e7",
                           "lifetime sign", "lifetime", "lifetime sign 1 2", "lifetime nobody 1", "lifetime #7 1"}) {
    CAPTURE(line);
    CHECK_FALSE(lifetime(coming, line).has_value());
  }
}

TEST_CASE("a thing is tagged solid and no more, in the group that it has for it") {
  EditedWorld editor;
  REQUIRE(editor.take("create wall 1 2 3").has_value());
  const scene::NodeId wall = editor.names.fresh.at("wall");
  for (const bool solid : {true, false, true}) {
    REQUIRE(editor.take(solid ? "solid wall" : "solid wall off").has_value());
    CHECK(scene::is_tagged_solid(*editor.store.find(wall)) == solid);
    CHECK(editor.store.find(wall)->tag_groups.size() == 1);
  }
  CHECK(editor.find("tag body.solid") == Names{"wall"});
  const auto mass_kg = [&] { return scene::find_tag(*editor.store.find(wall), "body", "mass_kg"); };
  for (const double kg : {12.5, 0.4}) {
    REQUIRE(editor.take(fmt::format("solid wall {}", kg)).has_value());
    REQUIRE(mass_kg());
    CHECK(std::get<double>(*mass_kg()) == kg);
    CHECK(scene::is_tagged_solid(*editor.store.find(wall)));
  }
  REQUIRE(editor.take("solid wall").has_value());
  CHECK_FALSE(mass_kg());
  CHECK(editor.store.find(wall)->tag_groups.size() == 1);
  for (const char* line :
       {"solid", "solid nobody", "solid wall on", "solid wall off off", "solid wall 1 2", "solid wall nan"})
    CHECK_FALSE(editor.take(line).has_value());
}

TEST_CASE("a thing that hangs on another one takes no link from it, is removed with it, and never hangs on itself") {
  EditedWorld editor;
  for (const char* line : {"create cup", "board tray 2 1"}) REQUIRE(editor.take(line).has_value());
  const auto links = [&] {
    return std::get<scene::ObjectData>(editor.store.find(editor.names.fresh.at("tray"))->data).links;
  };
  const auto own = links();
  REQUIRE(own.contains(0));
  REQUIRE(editor.take("hang cup tray").has_value());
  const auto all = links();
  CHECK(all.size() == own.size() + 1);
  for (const auto& [id, link] : own) CHECK(all.at(id) == link);
  CHECK(all.rbegin()->second == scene::Link{"child", own_ids, 0});
  for (const char* line : {"hang cup cup", "hang cup nobody", "hang cup", "hang nobody tray"})
    CHECK_FALSE(editor.take(line).has_value());
  REQUIRE(editor.take("remove tray").has_value());
  CHECK(editor.store.nodes().empty());
}

TEST_CASE("what is moved keeps its heading unless another is given, and its scale always") {
  EditedWorld editor;
  for (const char* line : {"create cone 1 2 3 90", "transform-set cone 1 2 3 0 0 0 1 2 2 2", "move cone 4 5 6"})
    REQUIRE(editor.take(line).has_value());
  const auto place = [&] { return std::get<scene::ObjectData>(editor.store.find(own_ids)->data).transform; };
  CHECK(place().position_m == Vec3(4, 5, 6));
  CHECK(place().rotation == Quat(0, 0, 0, 1));
  REQUIRE(editor.take("move cone 4 5 6 0").has_value());
  CHECK(place().rotation == Quat(1, 0, 0, 0));
  CHECK(place().scale == glm::vec3(2));
}

TEST_CASE("a place ends the motion, set by another's line or by one that the scene does not have yet") {
  EditedWorld world;
  REQUIRE(world.take("create ball 1 2 3"));
  const scene::NodeId ball = world.names.fresh.find("ball")->second;
  REQUIRE(world.store.apply(scene::MotionSet{ball, {.legs = {{.velocity_mps = {1.0, 0.0, 0.0}}}}}));
  // Another editor's names, the same scene.
  EditNames others{2000, 2000};
  const auto moved = edit_of(scene::words_of("move ball 4 5 6 1 0 0 0 2 2 2").value(), world.store, others).value();
  REQUIRE(moved.commands.size() == 2);
  CHECK(std::get<scene::TransformSet>(moved.commands[0]).transform.scale == glm::vec3(2.0F));
  CHECK(std::get<scene::MotionSet>(moved.commands[1]).motion.legs.empty());

  REQUIRE(world.take("move ball 1 2 3"));
  CHECK(world.take("move ball 1 2 4")->commands.size() == 1);
  const auto line = [&](std::string_view text) {
    return edit_of(scene::words_of(text).value(), world.store, world.names).value().commands.size();
  };
  CHECK(line("go ball 1 0 0") == 1);
  CHECK(line("move ball 1 0 0 1 0 0 0 1 1 1") == 2);
  CHECK(line("move ball 2 0 0 1 0 0 0 1 1 1") == 1);
}

TEST_CASE("an imported model's properties are tags of its object, by which it is found") {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("{}-deer.gltf", getpid());
  std::ofstream(file)
      << R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"extras":{"mass_kg":60,"kind":"deer","list":[1]}}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
         R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAQAAAAAAAAAAAAAAAAAAAAAAAAIBA"}]})";
  EditedWorld editor;
  const auto made = editor.take(fmt::format("import deer \"{}\" 1 2 3", file.string()));
  std::filesystem::remove(file);
  REQUIRE(made.has_value());
  REQUIRE(made->messages.size() == 2);
  CHECK(
      made->messages[0] ==
      "1 triangles; 4.00 m long (glTF's z, forward), 4.00 m wide (x, left), 0.00 m high (y, up), from 0.00 m above its "
      "origin on");
  CHECK(editor.find("tag extras.mass_kg") == Names{"deer"});
  // No look is made that no part wears.
  std::size_t looks = 0;
  for (const auto& [id, node] : editor.store.nodes()) looks += node.type() == scene::NodeType::material;
  CHECK(looks == 1);
  // A key with prefixes of names may import it.
  for (const auto& [id, node] : editor.store.nodes())
    if (id >= own_ids && !node.name.empty()) CHECK(node.name.starts_with("deer"));
  const scene::Node& deer = *editor.store.find(own_ids);
  REQUIRE(scene::find_tag(deer, "extras", "kind") != nullptr);
  CHECK(*scene::find_tag(deer, "extras", "kind") == scene::TagValue(std::string("deer")));
  CHECK(*scene::find_tag(deer, "extras", "mass_kg") == scene::TagValue(60.0));
  CHECK(scene::find_tag(deer, "extras", "list") == nullptr);
}

}  // namespace septet::editor
