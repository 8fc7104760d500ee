#include "sim-client/film/traced/photon_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "engine/core/parallel_for.hpp"
#include "sim-client/film/traced/messages.hpp"

namespace septet::film {
namespace {

using raytrace::Photon;
static_assert(std::is_trivially_copyable_v<Photon> && sizeof(Photon) == 12 * sizeof(float));

constexpr std::uint32_t most_buckets = 1 << 20;
constexpr std::size_t runs_at_once = 2;

/// Decodes photons; empty if the bytes are not photons.
std::optional<std::vector<Photon>> decode_photons(std::span<const std::byte> bytes) {
  if (bytes.size() % sizeof(Photon) != 0) return std::nullopt;
  std::vector<Photon> photons(bytes.size() / sizeof(Photon));
  if (!photons.empty()) std::memcpy(photons.data(), bytes.data(), bytes.size());
  for (const Photon& photon : photons) {
    const glm::vec3 all = photon.position_m + photon.power + photon.normal + photon.to_light;
    if (!std::isfinite(all.x + all.y + all.z)) return std::nullopt;
  }
  return photons;
}

}  // namespace

Bytes question_message(const PhotonQuestion& question) {
  Bytes bytes = message(Word::photons_wanted);
  ByteWriter writer(bytes);
  writer.put(question.frame), writer.put(question.buckets), writer.put(question.threads);
  writer.put(static_cast<std::uint8_t>(question.fresh));
  return bytes;
}

std::optional<PhotonQuestion> read_photon_question(ByteReader& reader) {
  PhotonQuestion question;
  question.frame = reader.get<std::uint64_t>();
  question.buckets = reader.get<std::uint32_t>();
  question.threads = std::max(1u, reader.get<std::uint32_t>());
  question.fresh = reader.get<std::uint8_t>() != 0;
  return reader.ok() && question.buckets <= most_buckets ? std::optional(question) : std::nullopt;
}

Bytes shoot_message(const PhotonRun& run) {
  Bytes bytes = message(Word::shoot);
  ByteWriter writer(bytes);
  writer.put(run.frame), writer.put(run.first), writer.put(run.end), writer.put(static_cast<std::uint8_t>(run.alone));
  return bytes;
}

std::optional<PhotonRun> read_photon_run(ByteReader& reader) {
  PhotonRun run;
  run.frame = reader.get<std::uint64_t>();
  run.first = reader.get<std::uint32_t>(), run.end = reader.get<std::uint32_t>();
  run.alone = reader.get<std::uint8_t>() != 0;
  return reader.ok() ? std::optional(run) : std::nullopt;
}

Bytes photons_message(std::uint64_t frame, std::uint32_t bucket, std::span<const Photon> photons) {
  Bytes bytes = message(Word::photons);
  ByteWriter writer(bytes);
  writer.put(frame), writer.put(bucket);
  writer.put_bytes(std::as_bytes(photons));
  return bytes;
}

std::vector<PhotonExchange::Post> PhotonExchange::ask(int worker, const PhotonQuestion& question, bool shared) {
  std::vector<Post> posts;
  const PhotonRun whole{question.frame, 0, question.buckets, true};
  if (!shared) return {{worker, shoot_message(whole)}};
  Frame& frame = frames_[question.frame];
  if (frame.messages.empty()) frame.messages.resize(question.buckets), frame.dealings.resize(question.buckets);
  // A worker with another count of buckets there uses its own photons.
  if (frame.messages.size() != question.buckets) return {{worker, shoot_message(whole)}};
  frame.wanted_by.insert(worker);
  if (question.fresh)
    for (const Bytes& bytes : frame.messages)
      if (!bytes.empty()) posts.push_back({worker, bytes});
  PhotonRun run{question.frame, question.buckets, question.buckets, false};
  for (std::uint32_t n = 0; n < question.buckets; ++n)
    if (frame.messages[n].empty() && (run.first == question.buckets || frame.dealings[n] < frame.dealings[run.first]))
      run.first = n;
  if (run.first == question.buckets) return posts;
  const std::uint32_t dealt = frame.dealings[run.first];
  for (run.end = run.first; run.end < question.buckets && run.end - run.first < question.threads &&
                            frame.messages[run.end].empty() && frame.dealings[run.end] == dealt;)
    ++frame.dealings[run.end++];
  posts.push_back({worker, shoot_message(run)});
  return posts;
}

std::vector<PhotonExchange::Post> PhotonExchange::take(int worker, ByteReader& reader) {
  const auto number = reader.get<std::uint64_t>();
  const auto bucket = reader.get<std::uint32_t>();
  const auto found = frames_.find(number);
  if (!reader.ok() || found == frames_.end()) return {};
  Frame& frame = found->second;
  if (bucket >= frame.messages.size() || !frame.messages[bucket].empty()) return {};
  const auto photons = decode_photons(reader.take(reader.remaining()));
  if (!photons) return {};
  frame.messages[bucket] = photons_message(number, bucket, *photons);
  ++gathered_;
  std::vector<Post> posts;
  for (const int other : frame.wanted_by)
    if (other != worker) posts.push_back({other, frame.messages[bucket]});
  return posts;
}

PhotonGathering::PhotonGathering(raytrace::RayTracer& tracer, std::uint64_t frame, std::uint32_t threads)
    : tracer_(tracer),
      frame_(frame),
      threads_(std::max(1u, threads)),
      buckets_(tracer.photon_buckets()),
      photons_(buckets_.size()),
      missing_(buckets_.size()) {}

void PhotonGathering::told(const PhotonRun& run) {
  if (run.frame != frame_) return;
  waits_for_answer_ = false;
  is_alone_ |= run.alone;
  runs_.push_back(run);
  runs_.back().end = static_cast<std::uint32_t>(std::min<std::size_t>(run.end, buckets_.size()));
}

void PhotonGathering::came(ByteReader& reader) {
  const auto frame = reader.get<std::uint64_t>();
  const auto bucket = reader.get<std::uint32_t>();
  if (!reader.ok() || frame != frame_ || bucket >= photons_.size() || photons_[bucket]) return;
  photons_[bucket] = decode_photons(reader.take(reader.remaining()));
  if (photons_[bucket]) --missing_;
}

std::optional<Bytes> PhotonGathering::question() {
  if (missing_ == 0 || is_alone_ || waits_for_answer_ || runs_.size() >= runs_at_once) return std::nullopt;
  waits_for_answer_ = true;
  return question_message(
      {frame_, static_cast<std::uint32_t>(buckets_.size()), threads_, std::exchange(is_first_, false)});
}

std::vector<Bytes> PhotonGathering::shoot() {
  std::vector<std::uint32_t> now;
  while (!runs_.empty() && now.size() < threads_) {
    PhotonRun& run = runs_.front();
    if (run.first < run.end) {
      const std::uint32_t bucket = run.first++;
      if (!photons_[bucket] && std::ranges::find(now, bucket) == now.end()) now.push_back(bucket);
    }
    if (run.first >= run.end) runs_.pop_front();
  }
  parallel_for(
      now.size(), [&](std::size_t n) { photons_[now[n]] = tracer_.trace_photons(buckets_[now[n]]); }, threads_);
  missing_ -= now.size();
  std::vector<Bytes> said;
  if (!is_alone_)
    for (const std::uint32_t bucket : now) said.push_back(photons_message(frame_, bucket, *photons_[bucket]));
  return said;
}

bool PhotonGathering::is_whole() {
  if (missing_ > 0) return false;
  std::vector<std::vector<Photon>> all;
  for (auto& photons : photons_) all.push_back(std::move(*photons));
  tracer_.set_photons(all);
  return true;
}

}  // namespace septet::film
