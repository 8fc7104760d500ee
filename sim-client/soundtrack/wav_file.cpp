#include "sim-client/soundtrack/wav_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace septet::sound {
namespace fs = std::filesystem;
namespace {

constexpr std::uint32_t header_bytes = 68, sample_rate = 48000, bits = 16;

class Header {
 public:
  void word(const char* text) { bytes_.append(text, 4); }
  void number(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i)));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Header in WAVE_FORMAT_EXTENSIBLE, which assigns each channel to a loudspeaker.
std::string header(std::size_t channels, std::uint64_t data_bytes) {
  Header h;
  h.word("RIFF");
  h.number(data_bytes + header_bytes - 8, 4);
  h.word("WAVE");
  h.word("fmt ");
  h.number(40, 4);
  h.number(0xFFFE, 2);
  h.number(channels, 2);
  h.number(sample_rate, 4);
  h.number(sample_rate * channels * bits / 8, 4);
  h.number(channels * bits / 8, 2);
  h.number(bits, 2);
  h.number(22, 2);
  h.number(bits, 2);
  h.number(channels == 6 ? 0x3F : 0x3, 4);
  h.number(1, 4);  // PCM, as a GUID.
  h.number(0x00100000, 4);
  h.number(0xAA000080, 4);
  h.number(0x719B3800, 4);
  h.word("data");
  h.number(data_bytes, 4);
  return h.bytes();
}

}  // namespace

std::uint64_t most_frames(std::size_t channels) { return (0xFFFFFFFFull - header_bytes) / (channels * bits / 8); }

Expected<WavFile> WavFile::create(const fs::path& path, std::size_t channels) {
  std::error_code error;
  if (fs::exists(path, error)) return failure("it is there already", path.string(), "choose another name with --out");
  fs::path part = path;
  part += ".part";
  std::FILE* file = std::fopen(part.c_str(), "wb");
  if (!file) return failure(std::strerror(errno), part.string(), "choose a place that can be written with --out");
  WavFile wav(path, part, file, channels);
  if (auto written = wav.write_header(); !written) return tl::unexpected(written.error());
  return wav;
}

WavFile::~WavFile() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  fs::remove(part_, ignored);
}

Expected<void> WavFile::write_header() {
  const std::string text = header(channels_, bytes_);
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size()) return {};
  return failure(std::strerror(errno), part_.string(), "make room on the disk, or choose another place with --out");
}

Expected<void> WavFile::write(std::span<const float> samples) {
  std::vector<char> bytes;
  bytes.reserve(2 * samples.size());
  for (const float sample : samples) {
    const auto value = static_cast<std::int16_t>(std::lround(32767.0f * std::clamp(sample, -1.0f, 1.0f)));
    bytes.push_back(static_cast<char>(value));
    bytes.push_back(static_cast<char>(value >> 8));
  }
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    return failure(std::strerror(errno), part_.string(), "make room on the disk, or choose another place with --out");
  bytes_ += bytes.size();
  return {};
}

Expected<void> WavFile::finish() {
  if (std::fseek(file_.get(), 0, SEEK_SET) == 0)
    if (auto written = write_header(); !written) return written;
  if (std::FILE* file = file_.release(); std::fclose(file) != 0) {
    const std::string why = std::strerror(errno);
    std::error_code ignored;
    fs::remove(part_, ignored);
    return failure(why, part_.string(), "make room on the disk, or choose another place with --out");
  }
  std::error_code error;
  fs::rename(part_, path_, error);
  if (error) return failure(error.message(), path_.string(), "choose another place with --out");
  return {};
}

}  // namespace septet::sound
