#pragma once
/// JSON as Septet writes it: members in the order of addition, no number beyond JSON's.

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace septet::document {

using Json = nlohmann::ordered_json;

/// A number; non-finite ones become null.
Json number(double value);

/// Text of a value, with a newline at its end. Bytes that are not UTF-8 are replaced.
std::string text_of(const Json& json);
/// The same on one line, without a newline.
std::string line_of(const Json& json);

}  // namespace septet::document
