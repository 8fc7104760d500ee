#include "command-line/command/session_participants.hpp"

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/document/json.hpp"
#include "engine/world/kind_name.hpp"
#include "engine/world/vehicle_model.hpp"
#include "logging/session/participants.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::server {
namespace {

std::string json_of(const std::vector<logging::Stay>& stays) {
  document::Json rows = document::Json::array();
  for (const logging::Stay& stay : stays) {
    const VehicleModel& model = vehicle_models()[stay.model];
    document::Json row;
    row["number"] = stay.number;
    row["name"] = stay.name;
    row["kind"] = name_of(model.kind);
    row["model"] = model.name;
    row["is_driver"] = stay.is_driver;
    row["from_s"] = document::number(stay.from_s);
    row["to_s"] = document::number(stay.to_s);
    rows.push_back(std::move(row));
  }
  return document::text_of(rows);
}

/// Lines of equally wide columns, the numbers to the right.
std::string lines_of(const std::vector<logging::Stay>& stays) {
  struct Row {
    std::string number, name, kind, model, from_s, to_s, note;
  };
  std::vector<Row> rows{{"number", "name", "kind", "model", "from s", "to s", ""}};
  for (const logging::Stay& stay : stays) {
    const VehicleModel& model = vehicle_models()[stay.model];
    rows.push_back({std::to_string(stay.number), stay.name.empty() ? "-" : printable(stay.name, 100),
                    std::string(name_of(model.kind)), std::string(model.name), fmt::format("{:.2f}", stay.from_s),
                    fmt::format("{:.2f}", stay.to_s), stay.is_driver ? "  the driver's car" : ""});
  }
  const auto width_of = [&](std::string Row::*cell) {
    std::size_t width = 0;
    for (const Row& row : rows) width = std::max(width, (row.*cell).size());
    return width;
  };
  const std::size_t number = width_of(&Row::number), name = width_of(&Row::name), kind = width_of(&Row::kind),
                    model = width_of(&Row::model), from = width_of(&Row::from_s), to = width_of(&Row::to_s);
  std::string text;
  for (const Row& row : rows)
    text += fmt::format("{:>{}}  {:<{}}  {:<{}}  {:<{}}  {:>{}}  {:>{}}{}\n", row.number, number, row.name, name,
                        row.kind, kind, row.model, model, row.from_s, from, row.to_s, to, row.note);
  return text;
}

}  // namespace

Expected<int> run_session_participants(const ParticipantsOptions& options, std::ostream& out) {
  const auto session = logging::SessionReader::open(options.session);
  if (!session) return tl::unexpected(session.error());
  const auto stays = logging::stays_of(*session);
  if (!stays) return tl::unexpected(stays.error());
  out << (options.json ? json_of(*stays) : lines_of(*stays));
  return 0;
}

}  // namespace septet::server
