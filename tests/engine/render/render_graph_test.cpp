#include "engine/render/graph/render_graph.hpp"

#include <string>

#include <doctest/doctest.h>

namespace septet::render {
namespace {

using enum Access;

struct Built {
  RenderGraph graph;
  std::string ran;
  void add(const std::string& name, PassUses uses) {
    graph.add_pass(name, std::move(uses), [this, name] { ran += name + " "; });
  }
};

}  // namespace

TEST_CASE("a read after a write gets one barrier between the two accesses") {
  Built built;
  const ResourceId shadow = built.graph.add_resource("shadow"), picture = built.graph.add_resource("picture");
  built.add("shadows", {{}, {{shadow, depth_attachment}}});
  built.add("view", {{{shadow, sampled}}, {{picture, color_attachment}}});
  built.graph.keep(picture, transfer_source);
  const Schedule schedule = built.graph.compile();
  REQUIRE(schedule.steps.size() == 2);
  CHECK(schedule.steps[0].barriers == std::vector<Barrier>{{shadow, none, depth_attachment, true}});
  CHECK(schedule.steps[1].barriers ==
        std::vector<Barrier>{{shadow, depth_attachment, sampled, false}, {picture, none, color_attachment, true}});
  CHECK(schedule.last_barriers == std::vector<Barrier>{{picture, color_attachment, transfer_source, false}});
}

TEST_CASE("two reads of one kind need no barrier between them") {
  Built built;
  const ResourceId table = built.graph.add_resource("table", sampled), a = built.graph.add_resource("a"),
                   b = built.graph.add_resource("b");
  built.add("first", {{{table, sampled}}, {{a, color_attachment}}});
  built.add("second", {{{table, sampled}, {a, sampled}}, {{b, color_attachment}}});
  built.graph.keep(b, present);
  for (const Schedule::Step& step : built.graph.compile().steps)
    for (const Barrier& barrier : step.barriers) CHECK(barrier.resource != table);
}

TEST_CASE("a write after a read waits for it and drops the old contents") {
  Built built;
  const ResourceId table = built.graph.add_resource("table", sampled), picture = built.graph.add_resource("picture");
  built.add("renew", {{}, {{table, transfer_destination}}});
  built.add("view", {{{table, sampled}}, {{picture, color_attachment}}});
  built.graph.keep(picture, transfer_source);
  const Schedule schedule = built.graph.compile();
  CHECK(schedule.steps[0].barriers == std::vector<Barrier>{{table, sampled, transfer_destination, true}});
  CHECK(schedule.steps[1].barriers.front() == Barrier{table, transfer_destination, sampled, false});
}

TEST_CASE("a pass that draws over a picture keeps what is there and waits for it") {
  Built built;
  const ResourceId picture = built.graph.add_resource("picture");
  built.add("view", {{}, {{picture, color_attachment}}});
  built.add("text", {{{picture, color_attachment}}, {{picture, color_attachment}}});
  built.graph.keep(picture, transfer_source);
  const Schedule schedule = built.graph.compile();
  REQUIRE(schedule.steps.size() == 2);
  CHECK(schedule.steps[1].barriers == std::vector<Barrier>{{picture, color_attachment, color_attachment, false}});
}

TEST_CASE("a pass whose result nobody needs does not run") {
  Built built;
  const ResourceId picture = built.graph.add_resource("picture"), unused = built.graph.add_resource("unused"),
                   source = built.graph.add_resource("source");
  built.add("source", {{}, {{source, color_attachment}}});
  built.add("unused", {{{source, sampled}}, {{unused, color_attachment}}});
  built.add("overwritten", {{}, {{picture, color_attachment}}});
  built.add("view", {{}, {{picture, color_attachment}}});
  built.graph.keep(picture, transfer_source);
  built.graph.execute([](std::span<const Barrier>) {});
  CHECK(built.ran == "view ");
}

TEST_CASE("what the next frame finds is how this one left it") {
  Built built;
  const ResourceId picture = built.graph.add_resource("picture"), table = built.graph.add_resource("table", sampled),
                   untouched = built.graph.add_resource("untouched", transfer_source);
  built.add("view", {{{table, sampled}}, {{picture, color_attachment}}});
  built.graph.keep(picture, transfer_source);
  const std::vector<Access> left = built.graph.left(built.graph.compile());
  CHECK(left[picture] == transfer_source);
  CHECK(left[table] == sampled);
  CHECK(left[untouched] == transfer_source);
}

}  // namespace septet::render
