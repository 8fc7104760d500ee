#include "sim-client/soundtrack/cut_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "sim-client/soundtrack/session_track.hpp"
#include "sim-client/soundtrack/wav_file.hpp"

namespace septet::sound {
namespace {

constexpr std::size_t channels = 2;
constexpr double unheard_s = 0.25, fade_samples = 0.003 * audio::sample_rate_hz;

using Frame = std::array<float, channels>;

/// Reads blocks at a speed of its own, with linear interpolation between samples.
class Tape {
 public:
  /// `at_s`: time of the first output frame; `count`: number of output frames.
  Tape(double at_s, double speed, std::uint64_t count) : at_s_(at_s), speed_(speed), count_(count) {}

  bool is_full() const { return made_ >= count_; }
  std::uint64_t made() const { return made_; }

  /// Appends this block's share.
  void take(std::span<const float> samples, double tick_s, std::vector<float>& out) {
    if (!start_s_) start_s_ = tick_s;
    for (std::size_t i = 0; i + channels <= samples.size() && !is_full(); i += channels, ++read_) {
      const Frame now{samples[i], samples[i + 1]};
      // Interpolation between the frame before and this one.
      for (; !is_full(); ++made_) {
        const double wanted = (at_s_ - *start_s_) * audio::sample_rate_hz + static_cast<double>(made_) * speed_;
        const double share = wanted - (static_cast<double>(read_) - 1.0);
        if (share > 1.0) break;
        put(now, static_cast<float>(std::clamp(share, 0.0, 1.0)), out);
      }
      before_ = now;
    }
  }
  /// Fills with silence if the session has ended before the film's last frame.
  void fill(std::vector<float>& out) {
    for (; !is_full(); ++made_) out.insert(out.end(), channels, 0.0f);
  }

 private:
  void put(const Frame& now, float share, std::vector<float>& out) const {
    const double edge =
        std::min({1.0, static_cast<double>(made_) / fade_samples, static_cast<double>(count_ - made_) / fade_samples});
    for (std::size_t c = 0; c < channels; ++c)
      out.push_back(static_cast<float>(edge) * (before_[c] + (now[c] - before_[c]) * share));
  }

  double at_s_, speed_;
  std::uint64_t count_, made_ = 0, read_ = 0;
  std::optional<double> start_s_;
  Frame before_{};
};

}  // namespace

Expected<bool> write_cut_track(const logging::SessionReader& session, const std::vector<Cut>& cuts,
                               double frames_per_second, const std::filesystem::path& file,
                               const std::function<bool()>& go_on) {
  const auto sound = sound_of(session);
  if (!sound) return tl::unexpected(sound.error());
  const auto whole = session.shown_span_s();
  if (!whole) return tl::unexpected(whole.error());
  std::uint64_t all_frames = 0;
  for (const Cut& cut : cuts) all_frames += cut.frames;
  const double seconds = static_cast<double>(all_frames) / frames_per_second;
  if (seconds * audio::sample_rate_hz > static_cast<double>(most_frames(channels)))
    return failure("a film that long has no sound", file.string(), "add --no-sound, or make it in parts");
  auto wav = WavFile::create(file, channels);
  if (!wav) return tl::unexpected(wav.error());
  std::vector<float> out;
  std::uint64_t frames = 0, samples = 0;
  for (const Cut& cut : cuts) {
    // Counted from the film's beginning, so that it does not drift.
    frames += cut.frames;
    const auto until = static_cast<std::uint64_t>(
        std::llround(static_cast<double>(frames) / frames_per_second * audio::sample_rate_hz));
    Tape tape(cut.from_s, cut.speed, until - std::exchange(samples, until));
    const double last_s = cut.from_s + static_cast<double>(cut.frames) / frames_per_second * cut.speed + 0.05;
    const TrackOptions options{.from_s = std::max(whole->first, cut.from_s - unheard_s),
                               .to_s = std::min(last_s, whole->second)};
    bool stopped = false;
    if (options.from_s < options.to_s) {
      const auto made =
          render_track(session, *sound, options, [&](std::span<const float> block, double tick_s) -> Expected<bool> {
            out.clear();
            tape.take(block, tick_s, out);
            if (auto written = wav->write(out); !written) return tl::unexpected(written.error());
            stopped = !go_on();
            return !stopped && !tape.is_full();
          });
      if (!made) return tl::unexpected(made.error());
    }
    if (stopped) return false;
    out.clear();
    tape.fill(out);
    if (auto written = wav->write(out); !written) return tl::unexpected(written.error());
  }
  if (auto finished = wav->finish(); !finished) return tl::unexpected(finished.error());
  return true;
}

}  // namespace septet::sound
