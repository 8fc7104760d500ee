#pragma once
/// Figures as text: what every command that measures writes.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/figure.hpp"

namespace septet::server {

/// A JSON object with the members of `about` ("\"seed\": 1, …", without braces) and the list `figures`.
std::string figures_json(std::string_view about, std::span<const Figure> figures);
/// "name: value unit", for beside a plot.
std::vector<std::string> figure_notes(std::span<const Figure> figures);

}  // namespace septet::server
