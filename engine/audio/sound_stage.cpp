#include "engine/audio/sound_stage.hpp"

#define AL_ALEXT_PROTOTYPES  // Debian's library exports what these declare.
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <AL/efx-presets.h>
#include <AL/efx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace septet::audio {
namespace {

// Three wait, one is filled: a hundred and twentieth of a second each.
constexpr std::size_t buffers_each = 6;

struct Source {
  ALuint name = 0;
  std::array<ALuint, buffers_each> buffers{};
  std::vector<ALuint> free;
  bool is_wanted = false, is_ending = false;
  double echo = 0.0;  ///< Share of it that the tunnel gets.
};

/// OpenAL's axes: x to the right, y up, z backwards.
std::array<float, 3> to_al(const Vec3& ear_frame) {
  return {static_cast<float>(-ear_frame.y), static_cast<float>(ear_frame.z), static_cast<float>(-ear_frame.x)};
}

}  // namespace

struct SoundStage::State {
  StageOptions options;
  ALCdevice* device = nullptr;
  ALCcontext* context = nullptr;
  bool is_loopback = false;
  LPALCRENDERSAMPLESSOFT render_samples = nullptr;
  std::map<std::uint64_t, Source> sources;
  ALuint tunnel_slot = 0, tunnel_effect = 0, low_slot = 0, low_effect = 0, muted = 0;
  double tunnel = 0.0;
  std::uint64_t starved = 0;
  std::string name;

  ~State() {
    if (context) {
      for (auto& [key, source] : sources) end(source);
      alcMakeContextCurrent(nullptr);
      alcDestroyContext(context);
    }
    if (device) alcCloseDevice(device);
  }

  Expected<void> make_context(const std::vector<ALCint>& attributes) {
    context = alcCreateContext(device, attributes.data());
    if (!context || !alcMakeContextCurrent(context))
      return failure("OpenAL makes no context on it", "sound device",
                     "look at its settings (alsoft.conf), or drive without sound");
    if (!alIsExtensionPresent("AL_EXT_float32") || !alcIsExtensionPresent(device, "ALC_EXT_EFX"))
      return failure("this OpenAL lacks floating samples or effects", "libopenal1",
                     "install OpenAL Soft 1.19 or newer");
    alDopplerFactor(0.0f);
    alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
    alListenerf(AL_GAIN, static_cast<float>(std::pow(10.0, options.volume_db / 20.0)));
    make_tunnel();
    make_low();
    return {};
  }

  void make_tunnel() {
    alGenAuxiliaryEffectSlots(1, &tunnel_slot);
    alGenEffects(1, &tunnel_effect);
    const EFXEAXREVERBPROPERTIES tube = EFX_REVERB_PRESET_DRIVING_TUNNEL;
    alEffecti(tunnel_effect, AL_EFFECT_TYPE, AL_EFFECT_EAXREVERB);
    alEffectf(tunnel_effect, AL_EAXREVERB_DENSITY, tube.flDensity);
    alEffectf(tunnel_effect, AL_EAXREVERB_DIFFUSION, tube.flDiffusion);
    alEffectf(tunnel_effect, AL_EAXREVERB_GAIN, tube.flGain);
    alEffectf(tunnel_effect, AL_EAXREVERB_GAINHF, tube.flGainHF);
    alEffectf(tunnel_effect, AL_EAXREVERB_DECAY_TIME, tube.flDecayTime);
    alEffectf(tunnel_effect, AL_EAXREVERB_DECAY_HFRATIO, tube.flDecayHFRatio);
    alEffectf(tunnel_effect, AL_EAXREVERB_DECAY_LFRATIO, tube.flDecayLFRatio);
    alEffectf(tunnel_effect, AL_EAXREVERB_REFLECTIONS_GAIN, tube.flReflectionsGain);
    alEffectf(tunnel_effect, AL_EAXREVERB_REFLECTIONS_DELAY, tube.flReflectionsDelay);
    alEffectf(tunnel_effect, AL_EAXREVERB_LATE_REVERB_GAIN, tube.flLateReverbGain);
    alEffectf(tunnel_effect, AL_EAXREVERB_LATE_REVERB_DELAY, tube.flLateReverbDelay);
    alAuxiliaryEffectSloti(tunnel_slot, AL_EFFECTSLOT_EFFECT, static_cast<ALint>(tunnel_effect));
    alAuxiliaryEffectSlotf(tunnel_slot, AL_EFFECTSLOT_GAIN, 0.0f);
  }

  /// OpenAL gives placed sources no share in the channel of low frequencies; the dedicated effect does, and the
  /// source's direct path is closed.
  void make_low() {
    alGenFilters(1, &muted);
    alFilteri(muted, AL_FILTER_TYPE, AL_FILTER_LOWPASS);
    alFilterf(muted, AL_LOWPASS_GAIN, 0.0f);
    if (options.speakers != Speakers::surround_51 || !alcIsExtensionPresent(device, "ALC_EXT_DEDICATED")) return;
    alGenAuxiliaryEffectSlots(1, &low_slot);
    alGenEffects(1, &low_effect);
    alEffecti(low_effect, AL_EFFECT_TYPE, AL_EFFECT_DEDICATED_LOW_FREQUENCY_EFFECT);
    alEffectf(low_effect, AL_DEDICATED_GAIN, 1.0f);
    alAuxiliaryEffectSloti(low_slot, AL_EFFECTSLOT_EFFECT, static_cast<ALint>(low_effect));
  }

  bool begin(Source& source, const Voice& voice) {
    alGetError();
    alGenSources(1, &source.name);
    if (alGetError() != AL_NO_ERROR) return false;
    alGenBuffers(static_cast<ALsizei>(buffers_each), source.buffers.data());
    source.free.assign(source.buffers.begin(), source.buffers.end());
    alSourcei(source.name, AL_SOURCE_RELATIVE, AL_TRUE);
    alSourcef(source.name, AL_REFERENCE_DISTANCE, 1.0f);
    alSourcef(source.name, AL_ROLLOFF_FACTOR, voice.is_near ? 0.0f : 1.0f);
    if (voice.is_low) {
      alSourcei(source.name, AL_DIRECT_FILTER, static_cast<ALint>(muted));
      if (low_slot != 0)
        alSource3i(source.name, AL_AUXILIARY_SEND_FILTER, static_cast<ALint>(low_slot), 0, AL_FILTER_NULL);
    } else {
      // OpenAL would attenuate the highs with the distance, too, by a filter for each source that costs more than all
      // the rest of it.
      alSourcei(source.name, AL_AUXILIARY_SEND_FILTER_GAIN_AUTO, AL_FALSE);
      set_echo(source, voice);
    }
    static const Block silence{};
    queue(source, silence);
    return true;
  }

  /// Reverb of a distant source is attenuated by its decay over the travel time; updated in steps of 1 dB.
  void set_echo(Source& source, const Voice& voice) {
    constexpr double way_of_60_db_m = 3.42 * 343.3;  // The preset's decay time.
    const double way_m = voice.is_near ? 0.0 : std::max(0.0, glm::length(voice.position_m) - 1.0);
    const double wanted = double(voice.echo) * std::pow(10.0, -3.0 * way_m / way_of_60_db_m);
    constexpr double a_decibel = 1.122;
    if (!(wanted > 0.0) || (wanted < source.echo * a_decibel && wanted * a_decibel > source.echo)) return;
    source.echo = wanted;
    ALuint share = 0;
    alGenFilters(1, &share);
    alFilteri(share, AL_FILTER_TYPE, AL_FILTER_LOWPASS);
    alFilterf(share, AL_LOWPASS_GAIN, static_cast<float>(wanted));
    alSource3i(source.name, AL_AUXILIARY_SEND_FILTER, static_cast<ALint>(tunnel_slot), 0, static_cast<ALint>(share));
    alDeleteFilters(1, &share);  // A source keeps the filter's setting.
  }

  void end(Source& source) {
    alSourceStop(source.name);
    alSourcei(source.name, AL_BUFFER, 0);
    alDeleteSources(1, &source.name);
    alDeleteBuffers(static_cast<ALsizei>(buffers_each), source.buffers.data());
  }

  void take_played(Source& source) {
    ALint played = 0;
    alGetSourcei(source.name, AL_BUFFERS_PROCESSED, &played);
    for (; played > 0; --played) {
      ALuint buffer = 0;
      alSourceUnqueueBuffers(source.name, 1, &buffer);
      source.free.push_back(buffer);
    }
  }

  void queue(Source& source, const Block& samples) {
    if (source.free.empty()) return;  // Too far ahead; the caller of put checks blocks_ahead.
    const ALuint buffer = source.free.back();
    source.free.pop_back();
    alBufferData(buffer, AL_FORMAT_MONO_FLOAT32, samples.data(), static_cast<ALsizei>(sizeof samples),
                 static_cast<ALsizei>(sample_rate_hz));
    alSourceQueueBuffers(source.name, 1, &buffer);
  }
};

SoundStage::SoundStage(std::unique_ptr<State> state) : state_(std::move(state)) {}
SoundStage::SoundStage(SoundStage&&) noexcept = default;
SoundStage& SoundStage::operator=(SoundStage&&) noexcept = default;
SoundStage::~SoundStage() = default;

namespace {

std::vector<ALCint> attributes_of(const StageOptions& options) {
  return {ALC_FREQUENCY,           static_cast<ALCint>(sample_rate_hz),
          ALC_HRTF_SOFT,           options.headphones ? ALC_TRUE : ALC_FALSE,
          ALC_MONO_SOURCES,        64,
          ALC_OUTPUT_LIMITER_SOFT, ALC_TRUE,
          ALC_MAX_AUXILIARY_SENDS, 1};
}

}  // namespace

Expected<SoundStage> SoundStage::open_loopback(const StageOptions& options) {
  const auto open =
      reinterpret_cast<LPALCLOOPBACKOPENDEVICESOFT>(alcGetProcAddress(nullptr, "alcLoopbackOpenDeviceSOFT"));
  auto state = std::make_unique<State>();
  state->options = options;
  state->is_loopback = true;
  state->render_samples = reinterpret_cast<LPALCRENDERSAMPLESSOFT>(alcGetProcAddress(nullptr, "alcRenderSamplesSOFT"));
  if (open && state->render_samples) state->device = open(nullptr);
  if (!state->device)
    return failure("this OpenAL does not render into memory (ALC_SOFT_loopback)", "libopenal1",
                   "install OpenAL Soft 1.19 or newer");
  std::vector<ALCint> attributes = attributes_of(options);
  attributes.insert(attributes.end(), {ALC_FORMAT_CHANNELS_SOFT,
                                       options.speakers == Speakers::stereo ? ALC_STEREO_SOFT : ALC_5POINT1_SOFT,
                                       ALC_FORMAT_TYPE_SOFT, ALC_FLOAT_SOFT, 0});
  if (auto made = state->make_context(attributes); !made) return tl::unexpected(made.error());
  state->name = "memory";
  return SoundStage(std::move(state));
}

Expected<SoundStage> SoundStage::open_device(const StageOptions& options, const std::string& device) {
  auto state = std::make_unique<State>();
  state->options = options;
  state->device = alcOpenDevice(device.empty() ? nullptr : device.c_str());
  if (!state->device)
    return failure(
        "there is no sound device that can be opened", device.empty() ? "the usual one" : device,
        "connect or switch on one, or name another in the rig's [sound]; septet sound makes a file without any");
  std::vector<ALCint> attributes = attributes_of(options);
  attributes.push_back(0);
  if (auto made = state->make_context(attributes); !made) return tl::unexpected(made.error());
  const ALCchar* specifier = alcGetString(state->device, ALC_ALL_DEVICES_SPECIFIER);
  ALCint hrtf = 0, refresh = 0;
  alcGetIntegerv(state->device, ALC_HRTF_SOFT, 1, &hrtf);
  alcGetIntegerv(state->device, ALC_REFRESH, 1, &refresh);
  state->name = std::string(specifier ? specifier : "sound device") + (hrtf ? ", for headphones" : "");
  return SoundStage(std::move(state));
}

void SoundStage::put(std::span<const Voice> voices, double tunnel) {
  State& state = *state_;
  for (auto& [key, source] : state.sources) source.is_wanted = false;
  if (tunnel != state.tunnel)
    alAuxiliaryEffectSlotf(state.tunnel_slot, AL_EFFECTSLOT_GAIN, static_cast<float>(state.tunnel = tunnel));
  alcSuspendContext(state.context);
  for (const Voice& voice : voices) {
    const auto [place, is_new] = state.sources.try_emplace(voice.key);
    Source& source = place->second;
    if (is_new && !state.begin(source, voice)) {
      state.sources.erase(place);
      continue;
    }
    source.is_wanted = true;
    if (!voice.is_near && !voice.is_low) state.set_echo(source, voice);
    const auto position = to_al(voice.position_m);
    alSourcefv(source.name, AL_POSITION, position.data());
    state.take_played(source);
    ALint playing = AL_PLAYING;
    if (!is_new) alGetSourcei(source.name, AL_SOURCE_STATE, &playing);
    if (playing == AL_STOPPED) {
      ++state.starved;
      static const Block silence{};
      state.queue(source, silence);
    }
    state.queue(source, voice.samples);
    if (is_new || playing == AL_STOPPED) alSourcePlay(source.name);
  }
  alcProcessContext(state.context);
  for (auto place = state.sources.begin(); place != state.sources.end();) {
    Source& source = place->second;
    ALint playing = AL_PLAYING;
    if (!source.is_wanted) alGetSourcei(source.name, AL_SOURCE_STATE, &playing);
    if (playing == AL_STOPPED) state.end(source);
    place = playing == AL_STOPPED ? state.sources.erase(place) : std::next(place);
  }
}

void SoundStage::render(std::vector<float>& samples) {
  samples.assign(block_samples * channels_of(state_->options.speakers), 0.0f);
  state_->render_samples(state_->device, samples.data(), static_cast<ALCsizei>(block_samples));
  for (float& sample : samples) sample = std::isfinite(sample) ? std::clamp(sample, -1.0f, 1.0f) : 0.0f;
}

std::size_t SoundStage::blocks_ahead() {
  std::size_t least = buffers_each;
  for (auto& [key, source] : state_->sources) {
    if (!source.is_wanted) continue;
    state_->take_played(source);
    least = std::min(least, buffers_each - source.free.size());
  }
  return state_->sources.empty() ? 0 : least;
}

bool SoundStage::is_connected() {
  if (state_->is_loopback || !alcIsExtensionPresent(state_->device, "ALC_EXT_disconnect")) return true;
  ALCint connected = 1;
  alcGetIntegerv(state_->device, ALC_CONNECTED, 1, &connected);
  return connected != 0;
}

std::uint64_t SoundStage::starved() const { return state_->starved; }
const std::string& SoundStage::name() const { return state_->name; }

}  // namespace septet::audio
