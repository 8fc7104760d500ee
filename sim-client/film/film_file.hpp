#pragma once
/// A film as one file, made of its pictures by ffmpeg: a program of its own, which Septet does without until it is asked for.

#include <filesystem>
#include <functional>
#include <span>

#include "engine/core/expected.hpp"

namespace septet::film {

/// Whether a name asks for one: .mp4 (H.264, small) or .mkv (FFV1, without loss). Error: that of a video which is neither.
Expected<bool> is_film_file(const std::filesystem::path& name);

/// Where the pictures of the film of this name lie: there, or of one file beside it. Error: as is_film_file.
Expected<std::filesystem::path> pictures_folder(const std::filesystem::path& name);

/// ffmpeg as PATH has it. Error: it is not installed.
Expected<std::filesystem::path> find_ffmpeg();

/// Whole or not at all: it is written beside its place and renamed. False where `go_on`, which is asked ten times a second, has said no. A
/// picture of odd size is widened by one pixel, for H.264 halves colour.
Expected<bool> encode_film(const std::filesystem::path& ffmpeg, std::span<const std::filesystem::path> pictures,
                           double frames_per_second, const std::filesystem::path& film,
                           const std::function<bool()>& go_on);

}  // namespace septet::film
