#include "sim-server/drive/name_in_log.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet::server {

std::string in_quotes_in_log(std::string_view name, std::size_t most_bytes) {
  std::string shown = printable(name, most_bytes);
  std::ranges::replace(shown, '"', '\'');
  return shown;
}

std::string name_in_log(const scene::Store& store, scene::NodeId id) {
  std::string name = in_quotes_in_log(store.find(id)->name);
  return name.empty() ? fmt::format("#{}", id) : name;
}

}  // namespace septet::server
