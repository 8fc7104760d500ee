#pragma once
/// The listener and the places of the voices: OpenAL Soft places them around the ear, on a real device or on one that
/// renders into memory.
///
/// The loopback device (ALC_SOFT_loopback) gives the same samples for the same voices, as fast as the processor can; a
/// real one plays. Both go through this one class. Voices are streamed, one queue of blocks each, with one block of
/// silence ahead, so that a queue runs dry only where blocks are late: OpenAL then stops that source for good, so it is
/// started again and counted. Speakers get no head-related filters (they would dull them): ALC_HRTF_SOFT is off unless
/// `headphones`. OpenAL's own Doppler effect is off (soundtrack.hpp gives the reason). One thread.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/audio/soundtrack.hpp"
#include "engine/core/expected.hpp"

namespace septet::audio {

/// Stereo: left, right. 5.1: front left, front right, centre, low frequencies, rear (or side) left and right, as in a
/// WAV file.
enum class Speakers : std::uint8_t { stereo, surround_51 };
inline std::size_t channels_of(Speakers speakers) { return speakers == Speakers::stereo ? 2 : 6; }

struct StageOptions {
  Speakers speakers = Speakers::stereo;
  bool headphones = false;
  double volume_db = 0.0;  ///< 0: a sample of ±1 is ±1 Pa.
};

class SoundStage {
 public:
  /// Renders into memory.
  static Expected<SoundStage> open_loopback(const StageOptions& options);
  /// Plays; `device` is OpenAL's name of it, or empty for the usual one. Error: there is no such device, or no sound
  /// server.
  static Expected<SoundStage> open_device(const StageOptions& options, const std::string& device);
  SoundStage(SoundStage&&) noexcept;
  SoundStage& operator=(SoundStage&&) noexcept;
  ~SoundStage();

  /// Queues the next block of every voice; a voice that is not among them any more ends after its queue. `tunnel`:
  /// strength of the echo, 0 to 1.
  void put(std::span<const Voice> voices, double tunnel);
  /// Loopback only: the next block as heard, interleaved, one block late. Within ±1; NaN becomes 0.
  void render(std::vector<float>& samples);

  /// A real device: blocks that are queued and not played yet, of the voice with the fewest.
  std::size_t blocks_ahead();
  /// True while the device is connected.
  bool is_connected();
  /// Number of times that a queue has run dry.
  std::uint64_t starved() const;
  const std::string& name() const;  ///< Name of the device, with its speakers.

 private:
  struct State;
  explicit SoundStage(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace septet::audio
