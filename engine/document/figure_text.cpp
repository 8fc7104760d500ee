#include "engine/document/figure_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace septet::document {

std::string figures_json(Json about, std::span<const Figure> figures) {
  Json list = Json::array();
  for (const Figure& figure : figures)
    list.push_back({{"name", figure.name}, {"value", number(figure.value)}, {"unit", figure.unit}});
  about["figures"] = std::move(list);
  return text_of(about);
}

std::vector<std::string> figure_notes(std::span<const Figure> figures) {
  std::vector<std::string> notes;
  for (const Figure& figure : figures)
    notes.push_back(fmt::format("{}: {:.4g} {}", figure.name, figure.value, figure.unit));
  return notes;
}

}  // namespace septet::document
