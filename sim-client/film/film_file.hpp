#pragma once
/// Film as one file, encoded from its pictures by ffmpeg: a separate program, needed only for this.

#include <filesystem>
#include <functional>
#include <span>

#include "engine/core/expected.hpp"

namespace septet::film {

/// True for the name of a film file: .mp4 (H.264, small) or .mkv (FFV1, lossless). Error: a video format that is
/// neither.
Expected<bool> is_film_file(const std::filesystem::path& name);

/// Folder of the pictures of the film of this name: the name itself, or for a film file a folder beside it. Error: as
/// is_film_file.
Expected<std::filesystem::path> pictures_folder(const std::filesystem::path& name);

/// ffmpeg found through PATH. Error: it is not installed.
Expected<std::filesystem::path> find_ffmpeg();

/// Atomic: written beside its place and renamed. Returns false if `go_on`, called ten times a second, returned false.
/// `sound`: a WAV file of the same length; empty: silent. A picture of odd size is widened by one pixel, since H.264
/// halves colour.
Expected<bool> encode_film(const std::filesystem::path& ffmpeg, std::span<const std::filesystem::path> pictures,
                           const std::filesystem::path& sound, double frames_per_second,
                           const std::filesystem::path& film, const std::function<bool()>& go_on);

}  // namespace septet::film
