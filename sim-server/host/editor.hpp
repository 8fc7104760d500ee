#pragma once
/// Who asks for a change of the scene.

#include <string>

#include "engine/net/rights.hpp"
#include "engine/scene/node.hpp"

namespace septet::server {

struct Editor {
  std::string name;  ///< Of its key.
  net::EditRights rights;
  scene::NodeId own_ids = 0;  ///< First of the ids_per_session ids that it may give to new nodes; 0: none.
};

}  // namespace septet::server
