#include "sim-server/command/figure_text.hpp"

#include <fmt/format.h>

namespace septet::server {

std::string figures_json(std::string_view about, std::span<const Figure> figures) {
  std::string text = fmt::format("{{\n  {},\n  \"figures\": [", about);
  const char* separator = "\n";
  for (const Figure& figure : figures) {
    text += fmt::format("{}    {{\"name\": \"{}\", \"value\": {:.9g}, \"unit\": \"{}\"}}",
                        separator, figure.name, figure.value, figure.unit);
    separator = ",\n";
  }
  return text + "\n  ]\n}\n";
}

std::vector<std::string> figure_notes(std::span<const Figure> figures) {
  std::vector<std::string> notes;
  for (const Figure& figure : figures)
    notes.push_back(fmt::format("{}: {:.4g} {}", figure.name, figure.value, figure.unit));
  return notes;
}

}  // namespace septet::server
