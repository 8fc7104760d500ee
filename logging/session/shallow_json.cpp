#include "logging/session/shallow_json.hpp"

#include <nlohmann/json.hpp>

namespace septet::logging {

std::optional<document::Json> shallow_json(const std::string& text) {
  constexpr int deepest = 16;
  bool is_deep = false;
  document::Json json = document::Json::parse(
      text,
      [&](int depth, document::Json::parse_event_t, document::Json&) {
        is_deep |= depth > deepest;
        return depth <= deepest;
      },
      false);
  if (is_deep || json.is_discarded()) return std::nullopt;
  return json;
}

}  // namespace septet::logging
