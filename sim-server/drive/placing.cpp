#include "sim-server/drive/placing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/core/printable.hpp"
#include "engine/document/table_line.hpp"
#include "engine/document/text_file.hpp"
#include "engine/editor/edit_verbs.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/ground_beside.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/scene/edit_file.hpp"
#include "sim-server/drive/operated.hpp"
#include "sim-server/drive/stock_things.hpp"

namespace septet::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_own_models = 200;

tl::unexpected<Error> no_scene() {
  return failure("this drive has no scene that could be changed", "the operator's page",
                 "leave --samples-only away, or drive with screens");
}

/// Where the height stands in a verb's line; 0: nowhere.
struct Verb {
  std::string_view word;
  std::size_t height_at = 0;
};
constexpr std::array<Verb, 7> verbs{
    {{"like", 5}, {"import", 5}, {"move", 4}, {"hide"}, {"show"}, {"solid"}, {"remove"}}};

/// The word `ground` behind x and y becomes the height there.
void put_ground(std::vector<scene::TextWord>& words, std::size_t at, const simulation::Model& model) {
  if (at == 0 || words.size() <= at || words[at].text != "ground") return;
  const auto x_m = document::number_in<double>(words[at - 2].text),
             y_m = document::number_in<double>(words[at - 1].text);
  if (x_m && y_m && std::isfinite(*x_m) && std::isfinite(*y_m))
    words[at].text = fmt::format("{:.3f}", ground_m(model, {*x_m, *y_m}));
}

bool is_file_name(const std::string& name) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !name.empty() && name.size() <= 60 && name.find_first_not_of(letters) == std::string::npos;
}

}  // namespace

double ground_m(const simulation::Model& model, const Vec2& place_m) {
  const auto surface = road::surface_at(model.roads, place_m);
  const bool is_beside = !surface || surface->outside_m > roadside::paved_edge_m;
  if (is_beside && model.obstacles)
    return roadside::ground_beside(model.roads, model.obstacles->terrain(), place_m,
                                   surface ? &surface->position : nullptr)
        .height_m;
  if (!surface) return 0.0;
  return model.raised ? model.raised->ground_at(place_m, surface->height_m) : surface->height_m;
}

std::map<std::string, fs::path> models_in(const std::vector<fs::path>& folders) {
  std::map<std::string, fs::path> models;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (entry->path().extension() == ".glb" && printable_characters(name) && models.size() < most_own_models)
        models.emplace(name, entry->path());
    }
  }
  return models;
}

Placing::Placing(WorldGate& gate, const simulation::Model& model, const std::vector<fs::path>& folders, fs::path out)
    : gate_(gate), model_(model), models_(models_in(folders)), out_(std::move(out)) {
  if (gate.generated()) things_.emplace(*gate.generated(), gate.scene());
  // A drive that begins again may have the page's things already.
  const auto& nodes = gate.scene().nodes();
  if (!nodes.empty() && nodes.rbegin()->first >= page_ids) next_ = nodes.rbegin()->first + 1;
}

page::PlacingFacts Placing::facts() const {
  page::PlacingFacts facts{.has_scene = things_.has_value()};
  if (!things_) return facts;
  facts.stock = stock_things(*gate_.generated());
  facts.own_models.reserve(models_.size());
  for (const auto& [name, file] : models_) facts.own_models.push_back(name);
  return facts;
}

Expected<editor::EditedLine> Placing::edit_of(std::string_view line, editor::EditNames& names) const {
  auto words = scene::words_of(line);
  if (!words) return tl::unexpected(words.error());
  const auto verb = words->empty() ? verbs.end() : std::ranges::find(verbs, words->front().text, &Verb::word);
  if (verb == verbs.end())
    return failure("the map knows no such line", printable(line, 80),
                   "write like, import, move, hide, show, solid or remove");
  put_ground(*words, verb->height_at, model_);
  if (verb->word == "import" && words->size() > 2) {
    const auto file = models_.find((*words)[2].text);
    if (file == models_.end())
      return failure("no file of this name lies in the drive's folders", printable((*words)[2].text, 80),
                     "put it beside the scenario, or into the working folder, and start the drive again");
    (*words)[2].text = file->second.string();
  }
  return editor::edit_of(*words, gate_.scene(), names);
}

Expected<void> Placing::take(std::string_view lines, Tick from) {
  if (!things_) return no_scene();
  editor::EditNames names{page_ids, next_};
  std::vector<scene::Command> batch;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    auto edit = edit_of(lines.substr(0, end), names);
    if (!edit) return tl::unexpected(edit.error());
    batch.insert(batch.end(), std::make_move_iterator(edit->commands.begin()),
                 std::make_move_iterator(edit->commands.end()));
    lines.remove_prefix(end == std::string_view::npos ? lines.size() : end + 1);
  }
  Editor page = the_page();
  page.own_ids = page_ids;
  if (const auto refused = gate_.make(page, std::move(batch), from)) {
    const replication::Failure& failed = refused->failures.front();
    return failure(failed.why, failed.node, "change another thing, or otherwise");
  }
  next_ = names.next;
  return {};
}

Expected<fs::path> Placing::save(const std::string& name) const {
  if (!things_) return no_scene();
  if (!is_file_name(name))
    return failure("this is no name of a file", printable(name, 80), "take letters, digits, hyphens and underscores");
  fs::path file = out_ / (name + ".edits");
  if (auto written = document::write_text_file(file, scene::edits_between(*gate_.generated(), gate_.scene())); !written)
    return tl::unexpected(written.error());
  return file;
}

std::vector<page::PlacedThing> Placing::near(const Vec2& place_m, double within_m) {
  if (!things_ || !std::isfinite(place_m.x + place_m.y + within_m)) return {};
  return things_->near(place_m, std::min(within_m, 200.0));
}

std::shared_ptr<const page::PlacedView> Placing::view() { return things_ ? things_->view() : nullptr; }

}  // namespace septet::server
