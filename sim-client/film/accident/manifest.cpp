#include "sim-client/film/accident/manifest.hpp"

#include <array>
#include <chrono>
#include <fstream>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/hash.hpp"
#include "engine/core/version.hpp"
#include "program/child_process.hpp"
#include "program/last_line.hpp"
#include "program/temporary_folder.hpp"
#include "sim-client/film/film_file.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

using document::Json;

std::string hash_of_text(std::string_view text) {
  StateHash hash;
  hash.add_bytes(std::as_bytes(std::span(text)));
  return fmt::format("{:016x}", hash.value());
}

Json inputs_json(const logging::SessionInfo& info) {
  Json inputs = Json::array();
  for (const auto& file : info.files)
    inputs.push_back({{"role", file.role}, {"name", file.name}, {"hash", hash_of_text(file.content)}});
  return inputs;
}

}  // namespace

std::string hash_text(const image::Image& picture) {
  StateHash hash;
  hash.add(picture.width), hash.add(picture.height);
  hash.add_bytes(std::as_bytes(std::span(picture.rgba)));
  return fmt::format("{:016x}", hash.value());
}

Expected<std::string> hash_of_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return failure("it cannot be read", file.string(), "check that it is there and may be read");
  StateHash hash;
  std::vector<char> piece(std::size_t{1} << 20);
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())) || stream.gcount() > 0)
    hash.add_bytes(std::as_bytes(std::span(piece.data(), static_cast<std::size_t>(stream.gcount()))));
  return fmt::format("{:016x}", hash.value());
}

Expected<std::vector<std::string>> decoded_hashes(const fs::path& film) {
  const auto ffmpeg = find_ffmpeg();
  if (!ffmpeg) return tl::unexpected(ffmpeg.error());
  const auto folder = program::TemporaryFolder::make("septet-check");
  if (!folder) return tl::unexpected(folder.error());
  const fs::path list = folder->path() / "frames.txt", log = folder->path() / "ffmpeg.txt";
  auto child =
      program::ChildProcess::start({ffmpeg->string(),
                                    {"-nostdin", "-hide_banner", "-loglevel", "error", "-i", "file:" + film.string(),
                                     "-map", "0:v", "-f", "framemd5", "file:" + list.string()},
                                    {},
                                    log});
  if (!child) return tl::unexpected(child.error());
  std::optional<program::ChildExit> end;
  while (!(end = child->poll())) child->read_line(std::chrono::milliseconds(50));
  std::vector<std::string> hashes;
  std::ifstream lines(list);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#') && line.find(',') != std::string::npos)
      hashes.push_back(line.substr(line.find_last_of(" ,") + 1));
  if (end->code != 0 || hashes.empty())
    return failure("ffmpeg cannot read the film: " + program::last_line(log), film.string(), "use an unaltered copy");
  return hashes;
}

Json made_of_json(const logging::SessionInfo& session, const AccidentFacts& facts, const AccidentPlan& plan) {
  Json json;
  json["title"] = plan.title;
  json["session"] = {{"started", session.started_utc}, {"septet", session.septet_version}, {"driver", facts.driver}};
  if (!facts.table.empty()) json["session"]["table"] = facts.table;
  if (!facts.changes.empty()) json["session"]["changes"] = facts.changes;
  json["inputs"] = inputs_json(session);
  json["event"] = facts.chosen ? *facts.chosen + 1 : 0;
  json["contacts"] = facts.contacts.size();
  json["left_out"] = plan.left_out;
  return json;
}

Json figures_json(const AccidentPlan& plan) {
  Json figures = Json::array();
  for (const Figure& figure : plan.figures)
    figures.push_back({{"name", figure.name},
                       {"value", document::number(figure.value)},
                       {"unit", figure.unit},
                       {"origin", figure.origin}});
  return figures;
}

Expected<Json> manifest(const ManifestSources& sources) {
  const fs::path& session = sources.session.path();
  const auto session_hash = hash_of_file(session);
  if (!session_hash) return tl::unexpected(session_hash.error());
  std::error_code unknown;
  const fs::path nearby = fs::relative(session, sources.folder, unknown);
  Json json = made_of_json(sources.session.info(), sources.facts, sources.plan);
  json["septet"] = version_text();
  json["session"]["file"] = unknown || nearby.empty() ? session.string() : nearby.string();
  json["session"]["hash"] = *session_hash;
  json["options"] = {{"frames_per_second", sources.options.frames_per_second},
                     {"width", sources.options.width_px},
                     {"height", sources.options.height_px},
                     {"software", sources.options.software},
                     {"renderer", sources.options.renderer == FilmRenderer::traced ? "traced" : "raster"},
                     {"samples", sources.options.samples},
                     {"denoise", sources.options.denoise},
                     {"sound", sources.options.sound}};
  json["assumptions"] = sources.plan.script.overlay.notes;
  json["figures"] = figures_json(sources.plan);
  json["files"] = Json::array();
  for (const std::string& name : sources.files) {
    const auto hash = hash_of_file(sources.folder / name);
    if (!hash) return tl::unexpected(hash.error());
    json["files"].push_back({{"name", name}, {"hash", *hash}});
  }
  const auto decoded = decoded_hashes(sources.folder / film_name);
  if (!decoded) return tl::unexpected(decoded.error());
  if (decoded->size() != sources.pictures.size())
    return failure(fmt::format("the film holds {} pictures of {}", decoded->size(), sources.pictures.size()),
                   (sources.folder / film_name).string(), "make it again");
  json["frames"] = Json::array();
  for (std::size_t n = 0; n < decoded->size(); ++n)
    json["frames"].push_back({{"picture", sources.pictures[n]}, {"film", (*decoded)[n]}});
  return json;
}

}  // namespace septet::film
