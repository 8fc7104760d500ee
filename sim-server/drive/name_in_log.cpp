#include "sim-server/drive/name_in_log.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet::server {

std::string name_in_log(const scene::Store& store, scene::NodeId id) {
  constexpr std::size_t most_bytes = 400;
  std::string name = printable(store.find(id)->name, most_bytes);
  std::ranges::replace(name, '"', '\'');
  return name.empty() ? fmt::format("#{}", id) : name;
}

}  // namespace septet::server
