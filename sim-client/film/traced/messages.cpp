#include "sim-client/film/traced/messages.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "engine/core/hash.hpp"
#include "engine/core/printable.hpp"
#include "engine/core/version.hpp"

namespace septet::film {
namespace {

using raytrace::TracedPixel;
static_assert(std::is_trivially_copyable_v<TracedPixel> && sizeof(TracedPixel) % 4 == 0);

constexpr std::size_t hash_bytes = 8, longest_text = 1 << 22;

/// Numbers of a frame, in this order.
template <class Frame, class Number>
void visit(Frame& facts, const Number& number) {
  number(facts.simulated_time_s), number(facts.ev100);
  auto& view = facts.view;
  for (auto* axis : {&view.projection.eye_m, &view.projection.right, &view.projection.up, &view.projection.back,
                     &view.world_from_car.position_m})
    number(axis->x), number(axis->y), number(axis->z);
  auto& turn = view.world_from_car.orientation;
  number(turn.w), number(turn.x), number(turn.y), number(turn.z);
  auto& p = view.projection;
  number(p.left_slope), number(p.right_slope), number(p.bottom_slope), number(p.top_slope);
}
constexpr std::size_t facts_bytes = 8 * (2 + 15 + 4 + 4);

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  StateHash hash;
  hash.add_bytes(bytes);
  return hash.value();
}

void put_optional(ByteWriter& writer, const std::optional<double>& number) {
  writer.put(static_cast<std::uint8_t>(number.has_value()));
  writer.put(number.value_or(0.0));
}
std::optional<double> get_optional(ByteReader& reader) {
  const bool there = reader.get<std::uint8_t>() != 0;
  const double number = reader.get_double();
  return there ? std::optional(number) : std::nullopt;
}

}  // namespace

FrameFacts facts_of(const instant::Instant& instant) {
  return {instant.simulated_time_s, instant.exposure.ev100, instant.views.front()};
}

std::size_t encoded_tile_size(std::size_t pixels) { return hash_bytes + facts_bytes + pixels * sizeof(TracedPixel); }

Bytes encode_tile(const FrameFacts& facts, std::span<const TracedPixel> pixels) {
  Bytes bytes(hash_bytes);
  bytes.reserve(encoded_tile_size(pixels.size()));
  ByteWriter writer(bytes);
  visit(facts, [&](double number) { writer.put(number); });
  writer.put_bytes(std::as_bytes(pixels));
  Bytes hash;
  ByteWriter(hash).put(hash_of(std::span(bytes).subspan(hash_bytes)));
  std::copy(hash.begin(), hash.end(), bytes.begin());
  return bytes;
}

std::optional<TracedTile> decode_tile(std::span<const std::byte> bytes, std::size_t pixels) {
  ByteReader reader(bytes);
  const auto hash = reader.get<std::uint64_t>();
  if (bytes.size() != encoded_tile_size(pixels) || hash != hash_of(bytes.subspan(hash_bytes))) return std::nullopt;
  TracedTile tile;
  visit(tile.facts, [&](double& number) { number = reader.get_double(); });
  tile.pixels.resize(pixels);
  const auto rest = reader.take(pixels * sizeof(TracedPixel));
  std::memcpy(tile.pixels.data(), rest.data(), rest.size());
  return tile;
}

std::vector<instant::PixelRectangle> tiles_of(const FilmOptions& options) {
  const auto places = raytrace::buckets_of(options.width_px, options.height_px, tile_side_px);
  std::vector<instant::PixelRectangle> tiles;
  for (std::uint32_t set = 0; set < options.sample_sets; ++set) tiles.insert(tiles.end(), places.begin(), places.end());
  return tiles;
}

Bytes message(Word word) { return {static_cast<std::byte>(word)}; }

Bytes hello_message(unsigned threads) {
  Bytes bytes = message(Word::hello);
  ByteWriter writer(bytes);
  writer.put_string(version_text());
  writer.put(std::uint32_t{threads});
  program::put_process(writer, program::own_process_mark());
  return bytes;
}

std::optional<Hello> read_hello(ByteReader& reader) {
  const std::string version = reader.get_string(longest_text);
  Hello hello;
  hello.threads = reader.get<std::uint32_t>();
  hello.process = program::get_process(reader);
  return reader.ok() && version == version_text() ? std::optional(hello) : std::nullopt;
}

Bytes film_message(const FilmTold& told) {
  Bytes bytes = message(Word::film);
  ByteWriter writer(bytes);
  const FilmOptions& options = told.options;
  writer.put(options.frames_per_second);
  writer.put(options.width_px), writer.put(options.height_px), writer.put(options.samples);
  writer.put(options.error), writer.put(static_cast<std::uint8_t>(options.filter));
  writer.put(options.sample_sets);
  writer.put(options.caustic_photons), writer.put(options.gather_photons);
  writer.put(options.every);
  put_optional(writer, options.from_s), put_optional(writer, options.to_s);
  writer.put(static_cast<std::uint8_t>(options.layers.contains(Layer::motion)));
  writer.put(static_cast<std::uint8_t>(told.script.has_value()));
  writer.put_string(told.script.value_or(""));
  writer.put(told.session_bytes);
  program::put_process(writer, told.master);
  return bytes;
}

std::optional<FilmTold> read_film(ByteReader& reader) {
  FilmTold told;
  FilmOptions& options = told.options;
  options.renderer = FilmRenderer::traced;
  options.frames_per_second = reader.get_double();
  options.width_px = reader.get<std::uint32_t>(), options.height_px = reader.get<std::uint32_t>();
  options.samples = reader.get<std::uint32_t>();
  options.error = reader.get_double();
  options.filter = static_cast<raytrace::Filter>(reader.get<std::uint8_t>() & 3);
  options.sample_sets = std::clamp(reader.get<std::uint32_t>(), 1u, std::max(1u, options.samples));
  options.caustic_photons = reader.get<std::uint32_t>(), options.gather_photons = reader.get<std::uint32_t>();
  options.every = std::max(1u, reader.get<std::uint32_t>());
  options.from_s = get_optional(reader), options.to_s = get_optional(reader);
  // The other layers are made from any tile; for this one a worker looks a frame ahead.
  if (reader.get<std::uint8_t>() != 0) options.layers.insert(Layer::motion);
  const bool has_script = reader.get<std::uint8_t>() != 0;
  std::string script = reader.get_string(longest_text);
  if (has_script) told.script = std::move(script);
  told.session_bytes = reader.get<std::uint64_t>();
  told.master = program::get_process(reader);
  return reader.ok() ? std::optional(std::move(told)) : std::nullopt;
}

Bytes run_message(Word word, const raytrace::TileRun& run) {
  Bytes bytes = message(word);
  ByteWriter writer(bytes);
  writer.put(std::uint64_t{run.frame}), writer.put(run.first), writer.put(run.end);
  return bytes;
}

std::optional<raytrace::TileRun> read_run(ByteReader& reader) {
  raytrace::TileRun run;
  run.frame = reader.get<std::uint64_t>();
  run.first = reader.get<std::uint32_t>(), run.end = reader.get<std::uint32_t>();
  return reader.ok() ? std::optional(run) : std::nullopt;
}

Bytes error_message(const Error& error) {
  Bytes bytes = message(Word::failed);
  ByteWriter writer(bytes);
  for (const std::string* text : {&error.what, &error.where, &error.remedy}) writer.put_string(*text);
  return bytes;
}

Error read_error(ByteReader& reader) {
  Error error;
  for (std::string* text : {&error.what, &error.where, &error.remedy})
    *text = printable(reader.get_string(longest_text));
  return error;
}

}  // namespace septet::film
