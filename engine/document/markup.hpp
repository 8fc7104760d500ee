#pragma once
/// Text in HTML and SVG.

#include <string>
#include <string_view>

namespace septet::document {

/// Text as a browser shows it: & < > " escaped.
std::string escaped(std::string_view text);

}  // namespace septet::document
