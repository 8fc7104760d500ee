#include "engine/render/graph/render_graph.hpp"

#include <algorithm>

#include "engine/core/check.hpp"

namespace septet::render {
namespace {

bool names(const std::vector<ResourceUse>& uses, ResourceId resource) {
  return std::any_of(uses.begin(), uses.end(), [&](const ResourceUse& use) { return use.resource == resource; });
}

}  // namespace

ResourceId RenderGraph::add_resource(std::string name, Access held) {
  resources_.push_back({std::move(name), held});
  return static_cast<ResourceId>(resources_.size() - 1);
}

void RenderGraph::add_pass(std::string name, PassUses uses, std::function<void()> record) {
  for (const ResourceUse& use : uses.writes)
    SEPTET_CHECK(writes(use.access), "pass {} writes {} with an access that reads", name,
                 resources_[use.resource].name);
  passes_.push_back({std::move(name), std::move(uses), std::move(record)});
}

void RenderGraph::keep(ResourceId resource, Access access) { resources_[resource].kept = access; }

std::vector<bool> RenderGraph::needed_passes() const {
  std::vector<bool> wanted(resources_.size()), needed(passes_.size());
  for (std::size_t i = 0; i < resources_.size(); ++i) wanted[i] = resources_[i].kept != Access::none;
  // Backwards: a pass is needed if it writes a resource that a later needed pass reads.
  for (std::size_t i = passes_.size(); i-- > 0;) {
    const PassUses& uses = passes_[i].uses;
    needed[i] = std::any_of(uses.writes.begin(), uses.writes.end(),
                            [&](const ResourceUse& use) { return wanted[use.resource]; });
    if (!needed[i]) continue;
    for (const ResourceUse& use : uses.writes) wanted[use.resource] = false;
    for (const ResourceUse& use : uses.reads) wanted[use.resource] = true;
  }
  return needed;
}

Schedule RenderGraph::compile() const {
  const std::vector<bool> needed = needed_passes();
  Schedule schedule;
  std::vector<Access> state;
  std::vector<bool> defined;
  for (const Resource& resource : resources_) {
    state.push_back(resource.held);
    defined.push_back(resource.held != Access::none);
  }
  const auto change = [&](std::vector<Barrier>& barriers, ResourceId resource, Access after, bool discard) {
    const Access before = state[resource];
    state[resource] = after;
    if (before == after && !writes(before)) return;  // Reads of one kind need no order.
    barriers.push_back({resource, before, after, discard});
  };
  for (std::uint32_t i = 0; i < passes_.size(); ++i) {
    if (!needed[i]) continue;
    const Pass& pass = passes_[i];
    Schedule::Step step{i, {}};
    for (const ResourceUse& use : pass.uses.reads) {
      SEPTET_CHECK(defined[use.resource], "pass {} reads {}, which nothing has written", pass.name,
                   resources_[use.resource].name);
      change(step.barriers, use.resource, use.access, false);
    }
    for (const ResourceUse& use : pass.uses.writes) {
      if (!names(pass.uses.reads, use.resource)) change(step.barriers, use.resource, use.access, true);
      defined[use.resource] = true;
    }
    schedule.steps.push_back(std::move(step));
  }
  for (ResourceId i = 0; i < resources_.size(); ++i)
    if (resources_[i].kept != Access::none && state[i] != resources_[i].kept)
      change(schedule.last_barriers, i, resources_[i].kept, false);
  return schedule;
}

std::vector<Access> RenderGraph::left(const Schedule& schedule) const {
  std::vector<Access> state;
  for (const Resource& resource : resources_) state.push_back(resource.held);
  for (const Schedule::Step& step : schedule.steps)
    for (const Barrier& barrier : step.barriers) state[barrier.resource] = barrier.after;
  for (const Barrier& barrier : schedule.last_barriers) state[barrier.resource] = barrier.after;
  return state;
}

void RenderGraph::execute(const std::function<void(std::span<const Barrier>)>& record_barriers) const {
  const Schedule schedule = compile();
  for (const Schedule::Step& step : schedule.steps) {
    if (!step.barriers.empty()) record_barriers(step.barriers);
    passes_[step.pass].record();
  }
  if (!schedule.last_barriers.empty()) record_barriers(schedule.last_barriers);
}

}  // namespace septet::render
