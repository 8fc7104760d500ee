#pragma once
/// A vehicle without what was torn off it: its own meshes cut along seams and lamps (mount_region.hpp), with a dark
/// recess behind, at every level of detail, from outside and from within; and what was cut out, as one panel.

#include <memory>
#include <optional>
#include <vector>

#include "engine/instant/frame_input.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "sim-client/frame/sheet.hpp"

namespace septet::frame {

/// True for parts of sheet metal: wheels, limbs and carried things keep their shape.
bool is_sheet_metal(scene::PartRole role);

/// Meshes of the parts of `prototype` that lost something, in its order, null for others; without triangles for a lamp that is gone.
instant::ReshapedParts without_torn(const scene::ResolvedScene& scene, const scene::Prototype& prototype,
                                    const VehicleModel& model, debris::Mounts torn);

/// What a mount's part looks like: the vehicle's own skin there with a back of its own, and what it carries. Empty
/// where the scene does not have the vehicle (yet), or the vehicle no such seams.
Sheet panel_of(const scene::ResolvedScene& scene, const VehicleModel& model, debris::Mount mount);

}  // namespace septet::frame
