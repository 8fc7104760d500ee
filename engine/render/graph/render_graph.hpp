#pragma once
/// Frame graph: a list of passes with the resources that each reads and writes, from which the barriers between them
/// follow.
///
/// A pass is added with its uses of named resources and a function that records it. `compile` drops passes whose
/// results are not used and finds, for each kept pass, the barriers before it; `execute` runs both in order. The graph
/// knows no Vulkan type, so that its decisions are tested without a device.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace septet::render {

/// Kind of access to a resource; it decides the pipeline stage, the memory access and the image layout.
enum class Access : std::uint8_t {
  none,  ///< Not used yet: its contents are undefined.
  color_attachment,
  depth_attachment,
  sampled,
  transfer_source,
  transfer_destination,
  present,
};

constexpr bool writes(Access access) {
  return access == Access::color_attachment || access == Access::depth_attachment ||
         access == Access::transfer_destination;
}

using ResourceId = std::uint32_t;

struct ResourceUse {
  ResourceId resource = 0;
  Access access = Access::none;
};

/// Uses of one pass. A pass that draws over existing contents names the resource under both reads and writes, with the
/// same access.
struct PassUses {
  std::vector<ResourceUse> reads, writes;
};

/// Ordering between two accesses of a resource: work that accessed it as `before` ends, and its writes are visible,
/// ahead of work that accesses it as `after`. `discard`: the old contents are not needed.
struct Barrier {
  ResourceId resource = 0;
  Access before = Access::none, after = Access::none;
  bool discard = false;
  bool operator==(const Barrier&) const = default;
};

/// Result of `compile`: kept passes in order, each with the barriers before it, then the barriers at the end.
struct Schedule {
  struct Step {
    std::uint32_t pass = 0;
    std::vector<Barrier> barriers;
  };
  std::vector<Step> steps;
  std::vector<Barrier> last_barriers;
};

class RenderGraph {
 public:
  /// Adds a resource. `held`: its last access before this frame.
  ResourceId add_resource(std::string name, Access held = Access::none);
  void add_pass(std::string name, PassUses uses, std::function<void()> record);
  /// Marks a result of the frame: keeps the passes that make this resource, and leaves it ready for `access`.
  void keep(ResourceId resource, Access access);

  /// Returns the schedule. Checks that each resource that a pass reads was written before.
  Schedule compile() const;
  /// Records barriers and passes in order.
  void execute(const std::function<void(std::span<const Barrier>)>& record_barriers) const;
  /// Last access of each resource after the schedule has run.
  std::vector<Access> left(const Schedule& schedule) const;

 private:
  struct Resource {
    std::string name;
    Access held;
    Access kept = Access::none;
  };
  struct Pass {
    std::string name;
    PassUses uses;
    std::function<void()> record;
  };
  std::vector<bool> needed_passes() const;

  std::vector<Resource> resources_;
  std::vector<Pass> passes_;
};

}  // namespace septet::render
