#pragma once
/// What master and workers of a film say to each other: one byte for the kind, then what belongs to it. Both are of one build, which
/// the first message makes sure of; bytes from another program are checked all the same.
///
/// A worker says hello and is told the film; it asks for the session's file, part by part; once it has all that it needs it gets
/// runs of tiles, and each tile goes back as soon as it is traced; before that, photons go around (photon_exchange.hpp). Every second each says that it is still there.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/raytrace/bucket_schedule.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "program/process_mark.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

/// Master and workers say every second that they are there; whoever is silent for a minute is given up.
inline constexpr double still_there_every_s = 1.0, longest_silence_s = 60.0;

enum class Word : std::uint8_t {
  hello,           ///< Worker: which Septet it is; threads; its process.
  film,            ///< Master: what is filmed, how long the session's file is, its process.
  part_wanted,     ///< Worker: from which byte of that file on.
  part,            ///< Master: from which byte on, and bytes.
  prepared,        ///< Worker: it can trace.
  soon,            ///< Master: a frame of which it is likely to get tiles first, to be made ready meanwhile.
  run,             ///< Master: frame, first tile, end; in the stead of the run before.
  shorter_run,     ///< Master: frame, end. Of the run that it has.
  photons_wanted,  ///< Worker: a frame that it makes ready (PhotonQuestion).
  shoot,           ///< Master: which buckets of photons (PhotonRun).
  photons,         ///< Worker, and master on to others: frame, bucket, photons.
  ready,           ///< Worker: a frame, and how many seconds it took to begin it.
  tile,            ///< Worker: frame, tile, seconds of a processor that it took, and the tile (encode_tile).
  failed,          ///< Worker: why it gives up.
  still_there,     ///< Both: nothing new.
  end,             ///< Master: no more is to be done; 1 where some are lost.
};

/// The tiles of a film's frames: squares of this many pixels, rows from the top.
inline constexpr std::uint32_t tile_side_px = 16;
/// Where they lie; with sets of samples all of the first set, then all of the second, and so on.
std::vector<instant::PixelRectangle> tiles_of(const FilmOptions& options);

/// What is known of a whole frame, beside its pixels.
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

/// With a hash, so that a half-written one is known. Tiles of equally many pixels are equally many bytes.
Bytes encode_tile(const FrameFacts& facts, std::span<const raytrace::TracedPixel> pixels);
std::size_t encoded_tile_size(std::size_t pixels);
/// Nothing where the bytes are not such a tile of this many pixels, whole.
std::optional<TracedTile> decode_tile(std::span<const std::byte> bytes, std::size_t pixels);

Bytes message(Word word);
Bytes hello_message(unsigned threads);
struct Hello {
  unsigned threads = 1;
  program::ProcessMark process;
};
/// Nothing where it is another Septet.
std::optional<Hello> read_hello(ByteReader& reader);

/// What all that a worker has to know is, but for the session's bytes.
struct FilmTold {
  FilmOptions options;  ///< Without files.
  std::optional<std::string> script;
  std::uint64_t session_bytes = 0;
  program::ProcessMark master;
};
Bytes film_message(const FilmTold& told);
std::optional<FilmTold> read_film(ByteReader& reader);

/// soon, run or shorter_run.
Bytes run_message(Word word, const raytrace::TileRun& run);
std::optional<raytrace::TileRun> read_run(ByteReader& reader);

Bytes error_message(const Error& error);
Error read_error(ByteReader& reader);

}  // namespace septet::film
