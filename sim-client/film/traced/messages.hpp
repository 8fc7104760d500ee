#pragma once
/// Messages between the master and the workers of a film: one byte for the kind, then the content. Both are of one
/// build, which the first message checks; bytes from another program are validated nevertheless.
///
/// A worker says hello and receives the film; it requests the session's file, part by part; then it gets runs of tiles,
/// and each tile goes back as soon as it is traced; before that, photons are exchanged (photon_exchange.hpp). Each
/// sends a sign of life every second.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/raytrace/bucket_schedule.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "program/process_mark.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

/// Master and workers send a sign of life every second; one that is silent for a minute is given up.
inline constexpr double still_there_every_s = 1.0, longest_silence_s = 60.0;

enum class Word : std::uint8_t {
  hello,           ///< Worker: its build of Septet; threads; its process.
  film,            ///< Master: the film, the length of the session's file, its process.
  part_wanted,     ///< Worker: first byte wanted of that file.
  part,            ///< Master: first byte, and bytes.
  prepared,        ///< Worker: it can trace.
  soon,            ///< Master: a frame whose tiles the worker is likely to get first, to be prepared meanwhile.
  run,             ///< Master: frame, first tile, end; replaces the run before.
  shorter_run,     ///< Master: frame, end. Shortens the present run.
  photons_wanted,  ///< Worker: a frame that it prepares (PhotonQuestion).
  shoot,           ///< Master: buckets of photons to shoot (PhotonRun).
  photons,         ///< Worker, and master on to others: frame, bucket, photons.
  ready,           ///< Worker: a frame, and the seconds that its preparation took.
  tile,            ///< Worker: frame, tile, seconds of processor time, and the tile (encode_tile).
  failed,          ///< Worker: reason for giving up.
  still_there,     ///< Both: nothing new.
  end,             ///< Master: no more work; 1 if some was lost.
};

/// Side of the tiles of a film's frames, pixels; tiles lie in rows from the top.
inline constexpr std::uint32_t tile_side_px = 16;
/// Rectangles of the tiles; with sets of samples all of the first set, then all of the second, and so on.
std::vector<instant::PixelRectangle> tiles_of(const FilmOptions& options);

/// Facts of a whole frame, beside its pixels.
struct FrameFacts {
  double simulated_time_s = 0.0;
  double ev100 = 0.0;
  instant::FrameView view;
};
FrameFacts facts_of(const instant::Instant& instant);

struct TracedTile {
  FrameFacts facts;
  std::vector<raytrace::TracedPixel> pixels;
};

/// Encodes a tile, with a hash by which a half-written one is detected. Tiles of equal pixel counts have equal sizes.
Bytes encode_tile(const FrameFacts& facts, std::span<const raytrace::TracedPixel> pixels);
std::size_t encoded_tile_size(std::size_t pixels);
/// Decodes a tile; empty unless the bytes are a whole tile of this many pixels.
std::optional<TracedTile> decode_tile(std::span<const std::byte> bytes, std::size_t pixels);

Bytes message(Word word);
Bytes hello_message(unsigned threads);
struct Hello {
  unsigned threads = 1;
  program::ProcessMark process;
};
/// Reads a hello; empty if it is of another Septet.
std::optional<Hello> read_hello(ByteReader& reader);

/// Everything that a worker needs except the session's bytes.
struct FilmTold {
  FilmOptions options;  ///< Without files.
  std::optional<std::string> script;
  std::uint64_t session_bytes = 0;
  program::ProcessMark master;
};
Bytes film_message(const FilmTold& told);
std::optional<FilmTold> read_film(ByteReader& reader);

/// Message of kind soon, run or shorter_run.
Bytes run_message(Word word, const raytrace::TileRun& run);
std::optional<raytrace::TileRun> read_run(ByteReader& reader);

Bytes error_message(const Error& error);
Error read_error(ByteReader& reader);

}  // namespace septet::film
