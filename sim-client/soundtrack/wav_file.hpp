#pragma once
/// Sound file: WAV, 16 bits, 48 kHz, two or six channels (front left and right, centre, low frequencies, back left and
/// right).
///
/// It is written beside its place as NAME.part and renamed when it is whole; an aborted write leaves no file. One
/// thread.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>

#include "engine/core/expected.hpp"

namespace septet::sound {

/// Most frames (one sample of each channel) in a WAV file, whose lengths have 32 bits.
std::uint64_t most_frames(std::size_t channels);

class WavFile {
 public:
  /// Creates the file. Error: it exists already, or its folder cannot be written.
  static Expected<WavFile> create(const std::filesystem::path& path, std::size_t channels);
  WavFile(WavFile&&) noexcept = default;
  WavFile& operator=(WavFile&&) = delete;
  ~WavFile();

  /// Writes interleaved samples; ±1 is full scale.
  Expected<void> write(std::span<const float> samples);
  Expected<void> finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  WavFile(std::filesystem::path path, std::filesystem::path part, std::FILE* file, std::size_t channels)
      : path_(std::move(path)), part_(std::move(part)), file_(file), channels_(channels) {}
  Expected<void> write_header();

  std::filesystem::path path_, part_;
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t channels_;
  std::uint64_t bytes_ = 0;
};

}  // namespace septet::sound
