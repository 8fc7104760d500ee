#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/regular_file.hpp"
#include "engine/core/version.hpp"
#include "engine/document/json.hpp"
#include "engine/film_script/script_text.hpp"
#include "engine/image/png.hpp"
#include "program/stop_signal.hpp"
#include "program/temporary_folder.hpp"
#include "sim-client/film/accident/accident_film.hpp"
#include "sim-client/film/accident/manifest.hpp"
#include "sim-client/film/accident/read_plan.hpp"
#include "sim-client/film/drawn_frame.hpp"
#include "sim-client/film/film_arguments.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

using document::Json;

constexpr std::size_t longest_manifest_bytes = std::size_t{64} << 20, drawn_frames = 3;

/// What a manifest says; a member of another type than Septet writes makes it none.
struct Record {
  Json json;
  FilmOptions film;
  std::size_t event = 0;
};

Expected<Record> read_manifest(const fs::path& folder, const fs::path& session) {
  const fs::path file = folder / manifest_name;
  const auto text = read_regular_file(file, longest_manifest_bytes);
  if (!text) return tl::unexpected(text.error());
  Record record{Json::parse(*text, nullptr, false), {}, 0};
  try {
    const Json& options = record.json.at("options");
    const std::string kept_in = record.json.at("session").at("file").get<std::string>();
    record.film.session = session.empty() ? folder / kept_in : session;
    record.film.frames_per_second = options.at("frames_per_second").get<double>();
    record.film.width_px = options.at("width").get<std::uint32_t>();
    record.film.height_px = options.at("height").get<std::uint32_t>();
    record.film.software = options.at("software").get<bool>();
    const auto renderer = options.at("renderer").get<std::string>();
    if (renderer != "raster" && renderer != "traced") throw std::invalid_argument("renderer");
    record.film.renderer = renderer_named(renderer);
    record.film.samples = options.at("samples").get<std::uint32_t>();
    record.film.denoise = options.at("denoise").get<bool>();
    record.event = record.json.at("event").get<std::size_t>();
    for (const char* list : {"files", "frames", "figures", "assumptions", "inputs"})
      if (!record.json.at(list).is_array()) throw std::invalid_argument(list);
    for (const Json& one : record.json["files"])
      (void)one.at("name").get_ref<const std::string&>(), (void)one.at("hash").get_ref<const std::string&>();
    for (const Json& one : record.json["frames"])
      (void)one.at("picture").get_ref<const std::string&>(), (void)one.at("film").get_ref<const std::string&>();
  } catch (const std::exception&) {
    return failure("it is not what Septet writes", file.string(), "use an unaltered copy");
  }
  const auto usual = [](std::uint32_t pixels) { return pixels >= 16 && pixels <= 16384; };
  if (!usual(record.film.width_px) || !usual(record.film.height_px) || record.film.samples < 1 ||
      record.film.samples > 1u << 20 ||
      !(record.film.frames_per_second >= 1.0 && record.film.frames_per_second <= 1000.0))
    return failure("its film has no size, rate or samples that Septet makes", file.string(), "use an unaltered copy");
  return record;
}

/// Files whose content is another than recorded.
void compare_files(const Record& record, const fs::path& folder, std::vector<std::string>& differences) {
  for (const Json& one : record.json["files"]) {
    const auto name = one["name"].get<std::string>();
    const auto hash = fs::path(name).has_parent_path() ? tl::unexpected(Error{}) : hash_of_file(folder / name);
    if (!hash || *hash != one["hash"].get<std::string>())
      differences.push_back(fmt::format("{}: {}", name, hash ? "it was altered" : "it cannot be read"));
  }
}

/// Pictures of the film file that differ, by number.
void compare_film(const Record& record, const fs::path& folder, std::vector<std::string>& differences) {
  const auto decoded = decoded_hashes(folder / film_name);
  if (!decoded) {
    differences.push_back(describe(decoded.error()));
    return;
  }
  const Json& frames = record.json["frames"];
  if (decoded->size() != frames.size())
    differences.push_back(fmt::format("{}: it holds {} frames of {}", film_name, decoded->size(), frames.size()));
  for (std::size_t n = 0; n < std::min(decoded->size(), frames.size()); ++n)
    if ((*decoded)[n] != frames[n]["film"].get<std::string>()) {
      differences.push_back(fmt::format("{}: frame {} was altered", film_name, n + 1));
      return;
    }
}

/// What differs of a member that session and plan decide: each input by itself, else the whole.
void compare_member(const std::string& name, const Json& kept, const Json& found,
                    std::vector<std::string>& differences) {
  if (kept == found) return;
  if (name != "inputs" || kept.size() != found.size()) {
    differences.push_back(fmt::format("{}: \"{}\" is {}, the session gives {}", manifest_name, name,
                                      document::line_of(kept), document::line_of(found)));
    return;
  }
  for (std::size_t n = 0; n < found.size(); ++n)
    if (kept[n] != found[n])
      differences.push_back(fmt::format("{}: input {} is {}, the session gives {}", manifest_name, n + 1,
                                        document::line_of(kept[n]), document::line_of(found[n])));
}

/// Compares what the film was made of: the session's own words, its inputs, its contacts.
void compare_made_of(const Record& record, const logging::SessionReader& session, const PlannedAccident& planned,
                     std::vector<std::string>& differences) {
  const Json made_of = made_of_json(session.info(), planned.facts, planned.plan);
  for (const auto& [name, found] : made_of.items()) {
    Json kept = record.json.value(name, Json());
    // Of the session the file's place and hash are compared apart.
    if (name == "session") kept.erase("file"), kept.erase("hash");
    compare_member(name, kept, found, differences);
  }
}

/// Plans anew and compares what was planned.
void compare_plan(const Record& record, const fs::path& folder, const logging::SessionReader& session,
                  std::vector<std::string>& differences) {
  const auto planned = read_plan(session, record.event > 0 ? std::optional(record.event) : std::nullopt,
                                 static_cast<double>(record.film.width_px) / record.film.height_px);
  if (!planned) {
    differences.push_back(describe(planned.error()));
    return;
  }
  compare_made_of(record, session, *planned, differences);
  const Json found = figures_json(planned->plan), &kept = record.json["figures"];
  if (found.size() != kept.size())
    differences.push_back(
        fmt::format("{}: it has {} figures, the session gives {}", manifest_name, kept.size(), found.size()));
  for (std::size_t n = 0; n < std::min(found.size(), kept.size()); ++n)
    if (found[n] != kept[n])
      differences.push_back(fmt::format("{}: figure \"{}\" is {}, the session gives {}", manifest_name,
                                        found[n]["name"].get<std::string>(), kept[n].value("value", Json()).dump(),
                                        found[n]["value"].dump()));
  if (record.json["assumptions"] != Json(planned->plan.script.overlay.notes))
    differences.push_back(fmt::format("{}: the assumptions are others", manifest_name));
  const auto storyboard = read_regular_file(folder / script_name, longest_manifest_bytes);
  if (!storyboard || !storyboard->ends_with(text_of(planned->plan.script)))
    differences.push_back(fmt::format("{}: it is not what the session's plan gives", script_name));
}

/// The picture of one frame, traced from the session; its folder has nothing else.
Expected<image::Image> traced_again(FilmOptions options, const FilmFrame& frame) {
  const auto folder = program::TemporaryFolder::make("septet-check");
  if (!folder) return tl::unexpected(folder.error());
  options.out = folder->path() / "pictures";
  options.from_s = options.to_s = frame.instant_s;
  const auto made = make_film(options, [](const FilmMade&) { return !program::should_stop(); });
  if (!made) return tl::unexpected(made.error());
  return image::read_png(options.out / fmt::format("{:06}.png", frame.number));
}

/// Draws some frames from the session and compares them with the record.
Expected<void> draw_again(const Record& record, const fs::path& folder, AccidentCheck& check) {
  FilmOptions options = record.film;
  options.shots = folder / script_name;
  auto frames = FilmFrames::open(options);
  if (!frames) return tl::unexpected(frames.error());
  const std::vector<FilmFrame> planned = frames->plan().frames;
  if (planned.size() != record.json["frames"].size()) {
    check.differences.push_back(fmt::format("{}: it is of {} frames, the record of {}", script_name, planned.size(),
                                            record.json["frames"].size()));
    return {};
  }
  std::optional<render::Renderer> rasteriser;
  if (options.renderer == FilmRenderer::raster) {
    auto made = make_rasteriser(options, frames->scene());
    if (!made) return tl::unexpected(made.error());
    rasteriser.emplace(std::move(*made));
  }
  std::random_device dice;
  std::set<std::size_t> chosen;
  while (chosen.size() < std::min(drawn_frames, planned.size()))
    chosen.insert(std::uniform_int_distribution<std::size_t>(0, planned.size() - 1)(dice));
  for (const std::size_t n : chosen) {
    const auto picture = rasteriser ? draw_frame(*frames, planned[n], *rasteriser) : traced_again(options, planned[n]);
    if (!picture) return tl::unexpected(picture.error());
    check.drawn_again.push_back(n + 1);
    if (hash_text(*picture) != record.json["frames"][n]["picture"].get<std::string>())
      check.differences.push_back(fmt::format("frame {}: drawn again from the session it is another picture", n + 1));
  }
  return {};
}

}  // namespace

Expected<AccidentCheck> check_accident(const fs::path& film, const fs::path& session_file) {
  std::error_code ignored;
  if (!fs::exists(film, ignored))
    return failure("there is no such film", film.string(),
                   "give the folder that septet accident made, or the film in it");
  const fs::path folder = fs::is_directory(film, ignored) ? film
                          : film.has_parent_path()        ? film.parent_path()
                                                          : fs::path(".");
  if (!fs::exists(folder / manifest_name, ignored))
    return failure(fmt::format("there is no {} beside it, which says what a film was made of", manifest_name),
                   film.string(), "give the folder that septet accident made, or the film in it");
  const auto record = read_manifest(folder, session_file);
  if (!record) return tl::unexpected(record.error());
  AccidentCheck check;
  const auto note = [&](std::string difference) { check.differences.push_back(std::move(difference)); };
  if (record->json.value("septet", Json()) != Json(version_text()))
    note(fmt::format("{}: it was made by Septet {}, this is {}", manifest_name,
                     record->json.value("septet", Json()).dump(), version_text()));
  compare_files(*record, folder, check.differences);
  compare_film(*record, folder, check.differences);
  const auto hash = hash_of_file(record->film.session);
  if (!hash) return tl::unexpected(hash.error());
  if (Json(*hash) != record->json["session"].value("hash", Json()))
    note(fmt::format("{}: it is not the session that was filmed, or it was altered", record->film.session.string()));
  const auto session = logging::SessionReader::open(record->film.session);
  if (!session) return tl::unexpected(session.error());
  compare_plan(*record, folder, *session, check.differences);
  if (auto drawn = draw_again(*record, folder, check); !drawn) note(describe(drawn.error()));
  return check;
}

}  // namespace septet::film
