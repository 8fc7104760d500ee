#include "sim-server/page/placing_messages.hpp"

#include <cmath>
#include <string_view>

#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"

namespace septet::page {
namespace {

using document::Json;

/// In hundredths, which is what a map shows.
Json hundredths(double value) {
  return std::isfinite(value) && std::abs(value) < 1e9 ? Json(std::round(100.0 * value) / 100.0) : Json(nullptr);
}

Json list_of(const std::vector<PlacedThing>& things) {
  Json list = Json::array();
  for (const PlacedThing& thing : things)
    list.push_back({{"id", thing.id},
                    {"name", thing.name},
                    {"node", thing.node},
                    {"x_m", hundredths(thing.x_m)},
                    {"y_m", hundredths(thing.y_m)},
                    {"heading_deg", hundredths(thing.heading_deg)},
                    {"length_m", hundredths(thing.length_m)},
                    {"width_m", hundredths(thing.width_m)},
                    {"middle_x_m", hundredths(thing.middle_x_m)},
                    {"middle_y_m", hundredths(thing.middle_y_m)},
                    {"shown", thing.is_shown},
                    {"solid", thing.is_solid},
                    {"placed", thing.was_placed}});
  return list;
}

}  // namespace

std::string placing_facts_text(const PlacingFacts& facts) {
  Json stock = Json::array();
  for (const StockThing& thing : facts.stock)
    stock.push_back({{"kind", thing.kind},
                     {"name", thing.name},
                     {"node", thing.node},
                     {"length_m", hundredths(thing.length_m)},
                     {"width_m", hundredths(thing.width_m)}});
  return document::line_of({{"type", "stock"},
                            {"has_scene", facts.has_scene},
                            {"stock", std::move(stock)},
                            {"own_models", facts.own_models}});
}

std::string placed_text(const PlacedView& view) {
  return document::line_of({{"type", "placed"}, {"things", list_of(view.things)}, {"more", view.more}});
}

std::string found_text(std::uint64_t id, const std::vector<PlacedThing>& found) {
  return document::line_of({{"type", "answer"}, {"id", id}, {"ok", true}, {"found", list_of(found)}});
}

std::string saved_text(std::uint64_t id, const std::string& file) {
  return document::line_of({{"type", "answer"}, {"id", id}, {"ok", true}, {"file", file}});
}

}  // namespace septet::page
