#pragma once
/// Figures as text, for every command that measures.

#include <span>
#include <string>
#include <vector>

#include "engine/core/figure.hpp"
#include "engine/document/json.hpp"

namespace septet::document {

/// The members of `about`, then the list `figures`.
std::string figures_json(Json about, std::span<const Figure> figures);
/// "name: value unit", for notes beside a plot.
std::vector<std::string> figure_notes(std::span<const Figure> figures);

}  // namespace septet::document
