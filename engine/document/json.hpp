#pragma once
/// JSON as Septet writes it: members in the order in which they were added, no number that JSON has not.

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace septet::document {

using Json = nlohmann::ordered_json;

/// Numbers that are not finite become null.
Json number(double value);

/// The text of a value, and a line's end. Bytes that are no UTF-8 are replaced.
std::string text_of(const Json& json);

}  // namespace septet::document
