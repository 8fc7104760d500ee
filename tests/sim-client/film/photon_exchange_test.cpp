#include "sim-client/film/traced/photon_exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "sim-client/film/traced/messages.hpp"
#include "tests/engine/raytrace/cornell_box.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"

namespace septet::film {
namespace {

using raytrace::RayTracer;
constexpr std::uint64_t frame = 3;

RayTracer begun_box() {
  static const scene::ResolvedScene scene = raytrace::cornell_box();
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  tracer->begin(raytrace::before_cornell_box(16), {.seed = 5, .photons = {.global = 50000}});
  return std::move(*tracer);
}

glm::vec3 light_of(const RayTracer& tracer) {
  glm::vec3 sum(0.0f);
  for (const raytrace::TracedPixel& pixel : tracer.trace({0, 0, 16, 16}).pixels) sum += pixel.radiance;
  return sum;
}

/// Workers of a frame and a master, whose messages come in the order in which they were sent.
struct Cluster {
  struct Worker {
    RayTracer tracer = begun_box();
    PhotonGathering photons{tracer, frame, 2};
    std::deque<Bytes> mail{};
    std::size_t shot = 0;  ///< Buckets, including those shot by others.
    bool is_whole = false;
  };
  PhotonExchange master{};
  std::deque<Worker> workers;  // They stay where they are.
  bool shared = true;

  explicit Cluster(std::size_t count) {
    for (std::size_t n = 0; n < count; ++n) workers.emplace_back();
  }
  void to_master(std::size_t from, const Bytes& bytes) {
    ByteReader reader(bytes);
    const auto word = static_cast<Word>(reader.get<std::uint8_t>());
    std::vector<PhotonExchange::Post> posts;
    if (word == Word::photons_wanted) {
      const auto question = read_photon_question(reader);
      REQUIRE(question.has_value());
      posts = master.ask(static_cast<int>(from), *question, shared);
    } else {
      REQUIRE(word == Word::photons);
      ++workers[from].shot;
      posts = master.take(static_cast<int>(from), reader);
    }
    for (auto& post : posts) workers[static_cast<std::size_t>(post.to)].mail.push_back(std::move(post.bytes));
  }
  void hear(std::size_t n) {
    Worker& worker = workers[n];
    for (; !worker.mail.empty(); worker.mail.pop_front()) {
      ByteReader reader(worker.mail.front());
      const auto word = static_cast<Word>(reader.get<std::uint8_t>());
      if (word == Word::photons) worker.photons.came(reader);
      if (word == Word::shoot) worker.photons.told(read_photon_run(reader).value());
    }
  }
  /// One turn of a worker.
  void step(std::size_t n) {
    Worker& worker = workers[n];
    if (worker.is_whole) return;
    hear(n);
    if (const auto question = worker.photons.question()) to_master(n, *question);
    for (const Bytes& bytes : worker.photons.shoot()) to_master(n, bytes);
    worker.is_whole = worker.photons.is_whole();
  }
};

}  // namespace

TEST_CASE("workers that share a frame have the photons of one that shoots them alone, and most are shot once") {
  RayTracer alone = begun_box();
  raytrace::send_photons(alone, 2);
  const glm::vec3 light = light_of(alone);
  REQUIRE(light.x > 0.0f);
  const std::size_t buckets = alone.photon_buckets().size();
  Cluster cluster(4);
  for (int turn = 0; turn < 100; ++turn)
    for (const std::size_t n : {2u, 0u, 3u, 1u, 2u}) cluster.step(n);
  std::size_t shot = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    REQUIRE(cluster.workers[n].is_whole);
    CHECK(light_of(cluster.workers[n].tracer) == light);
    CHECK(cluster.workers[n].shot < buckets);
    shot += cluster.workers[n].shot;
  }
  CHECK(buckets == 13);
  CHECK(shot >= buckets);
  CHECK(shot < 2 * buckets);
  cluster.master.forget(frame);
  CHECK(cluster.master.frames() == 0);
}

TEST_CASE(
    "a worker that is lost with photons in its hands keeps nobody from having them all, and one that comes late gets "
    "what there is") {
  Cluster cluster(3);
  // Two get work, and one of them is never heard again.
  for (const std::size_t n : {0u, 1u}) {
    cluster.to_master(n, *cluster.workers[n].photons.question());
    cluster.hear(n);
  }
  for (int turn = 0; turn < 100; ++turn) cluster.step(1);
  REQUIRE(cluster.workers[1].is_whole);
  for (int turn = 0; turn < 3; ++turn) cluster.step(2);
  REQUIRE(cluster.workers[2].is_whole);
  CHECK(cluster.workers[2].shot == 0);
  CHECK(light_of(cluster.workers[2].tracer) == light_of(cluster.workers[1].tracer));
}

TEST_CASE("who traces a frame alone sends its photons to nobody") {
  Cluster cluster(1);
  cluster.shared = false;
  for (int turn = 0; turn < 20; ++turn) cluster.step(0);
  CHECK(cluster.workers[0].is_whole);
  CHECK(cluster.workers[0].shot == 0);
  CHECK(cluster.master.frames() == 0);
}

TEST_CASE("photons that are none change nothing") {
  Cluster cluster(2);
  for (const std::size_t n : {0u, 1u}) cluster.to_master(n, *cluster.workers[n].photons.question());
  const auto taken = [&](const Bytes& bytes) {
    ByteReader reader(bytes);
    reader.get<std::uint8_t>();
    return !cluster.master.take(1, reader).empty();
  };
  raytrace::Photon photon;
  const std::vector<raytrace::Photon> good(2, photon);
  photon.power.y = std::numeric_limits<float>::quiet_NaN();
  const std::vector<raytrace::Photon> bad(1, photon);
  Bytes half = photons_message(frame, 0, good);
  half.pop_back();
  CHECK_FALSE(taken(half));
  CHECK_FALSE(taken(photons_message(frame, 0, bad)));
  CHECK_FALSE(taken(photons_message(frame, 13, good)));
  CHECK_FALSE(taken(photons_message(frame + 1, 0, good)));
  CHECK_FALSE(taken({std::byte{0}, std::byte{1}}));
  CHECK(taken(photons_message(frame, 12, {})));  // No photon has landed.
  CHECK_FALSE(taken(photons_message(frame, 12, good)));
  // A request from a worker with other content there.
  const auto answer = cluster.master.ask(1, {frame, 4, 1, true}, true);
  REQUIRE(answer.size() == 1);
  ByteReader reader(answer[0].bytes);
  CHECK(static_cast<Word>(reader.get<std::uint8_t>()) == Word::shoot);
  const auto run = read_photon_run(reader);
  REQUIRE(run.has_value());
  CHECK(run->alone);
  CHECK(run->end == 4);
}

}  // namespace septet::film
