#pragma once
/// The kind in a generated object's name.

#include <string_view>

namespace septet::scenery {

/// "tree" of "tree/412.5/-81.0" and of "tree/412.5/-81.0/2".
inline std::string_view kind_of(std::string_view name) {
  for (std::size_t slash; (slash = name.rfind('/')) != std::string_view::npos &&
                          name.find_first_not_of("-.0123456789", slash + 1) == std::string_view::npos;)
    name = name.substr(0, slash);
  return name;
}

}  // namespace septet::scenery
