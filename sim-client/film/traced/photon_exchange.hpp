#pragma once
/// Photons of a frame in buckets, shot by all workers of that frame and gathered by each: the third kind of bucket of
/// Johansson et al., "Distributed Ray Tracing in an Open Source Environment".
///
/// A worker that has begun a frame asks the master for photons to shoot. It sends the result back and asks again; the
/// master forwards each bucket to the other workers of the frame. When no bucket is left, missing ones are dealt again:
/// the wait for a slow worker is at most the time to shoot its buckets, and a lost worker costs no more. A frame traced
/// by one worker alone is not shared: photons on the wire are 48 bytes each, often dearer than shooting them.
///
/// Photons are a function of the frame and their number (engine/raytrace/photons.hpp), so the result is the same to the
/// bit whichever worker shoots them, and however often.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/raytrace/ray_tracer.hpp"

namespace septet::film {

/// Request of a worker.
struct PhotonQuestion {
  std::uint64_t frame = 0;
  std::uint32_t buckets = 0;  ///< Number of the frame's buckets.
  std::uint32_t threads = 1;
  bool fresh = true;  ///< First request for this frame: all present buckets are to be sent.
};
Bytes question_message(const PhotonQuestion& question);
std::optional<PhotonQuestion> read_photon_question(ByteReader& reader);

/// Buckets first, first + 1, … below end, to be shot.
struct PhotonRun {
  std::uint64_t frame = 0;
  std::uint32_t first = 0, end = 0;
  bool alone = false;  ///< True if no other worker wants them.
};
Bytes shoot_message(const PhotonRun& run);
std::optional<PhotonRun> read_photon_run(ByteReader& reader);

/// One bucket's photons.
Bytes photons_message(std::uint64_t frame, std::uint32_t bucket, std::span<const raytrace::Photon> photons);

/// Master's part of the exchange. One thread.
class PhotonExchange {
 public:
  struct Post {
    int to = 0;
    Bytes bytes;
  };
  /// Handles a request for photons. `shared`: other workers trace this frame, too.
  std::vector<Post> ask(int worker, const PhotonQuestion& question, bool shared);
  /// Takes photons that a worker has shot (the rest of its message).
  std::vector<Post> take(int worker, ByteReader& reader);
  /// Called when the frame is whole.
  void forget(std::uint64_t frame) { frames_.erase(frame); }
  std::size_t frames() const { return frames_.size(); }
  /// Buckets received, of all frames.
  std::uint64_t gathered() const { return gathered_; }

 private:
  struct Frame {
    std::vector<Bytes> messages;          ///< Indexed by bucket, as received; empty: not there.
    std::vector<std::uint32_t> dealings;  ///< Number of times that each was dealt.
    std::set<int> wanted_by;
  };
  std::map<std::uint64_t, Frame> frames_;
  std::uint64_t gathered_ = 0;
};

/// Worker's part: the photons of the frame that it prepares. One thread, beside those that shoot.
class PhotonGathering {
 public:
  /// Begins gathering. The tracer has begun this frame and outlives this.
  PhotonGathering(raytrace::RayTracer& tracer, std::uint64_t frame, std::uint32_t threads);

  std::uint64_t frame() const { return frame_; }
  void told(const PhotonRun& run);
  /// Takes photons shot by others (the rest of a message).
  void came(ByteReader& reader);
  /// Request to send to the master now, before the next call of `shoot`.
  std::optional<Bytes> question();
  /// Shoots as many of the assigned buckets at once as there are threads. Returns messages for the master.
  std::vector<Bytes> shoot();
  bool has_work() const { return !runs_.empty() && missing_ > 0; }
  /// True once all are there and the tracer has them.
  bool is_whole();

 private:
  raytrace::RayTracer& tracer_;
  std::uint64_t frame_;
  std::uint32_t threads_;
  std::vector<raytrace::PhotonBucket> buckets_;
  std::vector<std::optional<std::vector<raytrace::Photon>>> photons_;
  std::size_t missing_;
  /// Run being shot, and the next: it is requested before the first is done, so that no thread waits for the reply.
  std::deque<PhotonRun> runs_;
  bool is_first_ = true, waits_for_answer_ = false, is_alone_ = false;
};

}  // namespace septet::film
