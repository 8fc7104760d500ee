#include "engine/raytrace/bucket_schedule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

constexpr std::uint32_t side_tiles = 57;  ///< 900 pixels in tiles of 16.

/// Cost of a tile, 1 to 20: a patch in the picture's middle is expensive, as glass before a simple room.
double cost_of(std::uint32_t tile) {
  const double x = (tile % side_tiles) / double(side_tiles) - 0.55, y = (tile / side_tiles) / double(side_tiles) - 0.6;
  return 1.0 + 19.0 * std::exp(-12.0 * (x * x + y * y));
}

struct Simulated {
  double speed = 1.0;  ///< Cost a second.
  double dies_s = std::numeric_limits<double>::infinity();
  double joins_s = 0.0;
};

struct Ended {
  double efficiency = 0.0;  ///< Ideal time over the time that it took.
  std::uint64_t twice = 0, splits = 0;
  std::size_t missing = 0;
};

/// Workers of one thread that trace until all tiles are there. Deaths are not reported to the master.
Ended simulate(std::size_t frames, const std::vector<Simulated>& workers, Dealing dealing, double ready_s = 0.0,
               bool tells_cost = true) {
  BucketSchedule schedule(frames, side_tiles * side_tiles, {.dealing = dealing});
  struct State {
    TileRun run{};
    std::uint32_t next = 0;
    double done_s = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> frame{};
    std::optional<std::size_t> number{};
  };
  std::vector<State> states(workers.size());
  std::vector<std::size_t> of_number;
  double now_s = 0.0;
  std::size_t came = 0;
  double all = 0.0;
  for (std::uint32_t tile = 0; tile < side_tiles * side_tiles; ++tile) all += cost_of(tile);
  all *= static_cast<double>(frames);
  double speed = 0.0;
  for (const Simulated& worker : workers) speed += worker.speed;
  const auto goes_on = [&](std::size_t n) {
    State& s = states[n];
    s.done_s = std::numeric_limits<double>::infinity();
    if (s.next >= s.run.end) return;
    s.done_s = now_s + cost_of(s.next) / workers[n].speed;
    if (s.frame != s.run.frame) s.done_s += ready_s;
    s.frame = s.run.frame;
    if (s.done_s > workers[n].dies_s) s.done_s = std::numeric_limits<double>::infinity();
  };
  while (!schedule.has_all()) {
    for (std::size_t n = 0; n < workers.size(); ++n) {
      if (!states[n].number && now_s >= workers[n].joins_s) {
        states[n].number = schedule.add_worker(1);
        if (ready_s > 0.0) {  // Preparation before anything is dealt, as the film's workers do.
          states[n].frame = schedule.likely_first_frame(*states[n].number);
          if (states[n].frame) schedule.was_ready_after(*states[n].number, *states[n].frame, ready_s);
        }
        of_number.push_back(n);
      }
      if (!states[n].number || !schedule.is_free(*states[n].number)) continue;
      const auto deal = schedule.deal(*states[n].number, now_s);
      if (!deal) continue;
      if (deal->shortened) {
        State& other = states[of_number[deal->shortened->worker]];
        if (other.run.frame == deal->shortened->run.frame)
          other.run.end = std::min(other.run.end, deal->shortened->run.end);
      }
      // Tiles in its hands that another worker has delivered are abandoned.
      states[n].run = deal->run, states[n].next = deal->run.first;
      if (now_s < workers[n].dies_s) goes_on(n);
    }
    const auto next = std::min_element(states.begin(), states.end(),
                                       [](const State& a, const State& b) { return a.done_s < b.done_s; });
    // Idle workers ask at intervals.
    const double asks_s = 0.02 * all / speed / static_cast<double>(frames);
    if (next->done_s > now_s + asks_s) {
      now_s += asks_s;
      if (now_s > 50.0 * all / speed) return {};  // Hang.
      continue;
    }
    now_s = next->done_s;
    const auto n = static_cast<std::size_t>(next - states.begin());
    const std::uint32_t tile = next->next++;
    const double cpu_s = tells_cost ? cost_of(tile) / workers[n].speed : 0.0;
    if (schedule.finish(*next->number, next->run.frame, tile, now_s, cpu_s)) ++came;
    goes_on(n);
  }
  return {all / speed / now_s, schedule.traced_twice(), schedule.splits(), frames * side_tiles * side_tiles - came};
}

std::vector<Simulated> mixed(std::size_t count) {
  std::vector<Simulated> workers(count);
  for (std::size_t n = 0; n < count; ++n)
    workers[n].speed = 10.0 * (1.0 + 8.0 * static_cast<double>(n * 7 % count) / static_cast<double>(count - 1));
  return workers;
}

}  // namespace

TEST_CASE(
    "workers of speeds from 1 to 9 are used to 90 percent of what they can for one picture and to 95 for a film") {
  const Ended picture = simulate(1, mixed(15), Dealing::split);
  MESSAGE("one picture: ", picture.efficiency, ", splits ", picture.splits, ", tiles traced twice ", picture.twice);
  CHECK(picture.missing == 0);
  CHECK(picture.efficiency >= 0.90);
  CHECK(picture.twice < 60);
  const Ended film = simulate(40, mixed(15), Dealing::split);
  MESSAGE("a film of 40 frames: ", film.efficiency, ", splits ", film.splits, ", tiles traced twice ", film.twice);
  CHECK(film.efficiency >= 0.95);
  const Ended paper = simulate(1, mixed(15), Dealing::equal), round = simulate(1, mixed(15), Dealing::round_robin);
  MESSAGE("81 equal buckets: ", paper.efficiency, ", round robin ", round.efficiency);
  CHECK(paper.missing == 0);
  CHECK(round.missing == 0);
  CHECK(paper.efficiency < 0.7);
  CHECK(round.efficiency < paper.efficiency + 0.05);
}

TEST_CASE("equal workers are used to 97 percent") {
  CHECK(simulate(1, std::vector<Simulated>(8, {10.0}), Dealing::split).efficiency >= 0.97);
}

TEST_CASE("workers that take long to make ready for a frame are used as well for a film") {
  // Preparation of a fiftieth of a frame's time for an average worker.
  const Ended film = simulate(40, mixed(15), Dealing::split, 4.0);
  MESSAGE("efficiency ", film.efficiency);
  CHECK(film.efficiency >= 0.9);
}

TEST_CASE(
    "thirty frames are dealt to 95 percent where all together trace one in four times what each takes to make ready") {
  double work = 0.0, speed = 0.0;
  for (std::uint32_t tile = 0; tile < side_tiles * side_tiles; ++tile) work += cost_of(tile);
  for (const Simulated& worker : mixed(15)) speed += worker.speed;
  for (const double times : {4.0, 8.0}) {
    const Ended film = simulate(30, mixed(15), Dealing::split, work / speed / times);
    MESSAGE("a frame in ", times, " times the time to make ready: ", film.efficiency);
    CHECK(film.efficiency >= 0.95);
    // One picture is prepared before the first deal.
    CHECK(simulate(1, mixed(15), Dealing::split, work / speed / times).efficiency >= 0.95);
  }
}

TEST_CASE("a worker that joins makes ready for the frame that it will be dealt") {
  BucketSchedule schedule(5, 10);
  schedule.skip_frame(0);
  schedule.skip_frame(2);
  for (const std::size_t frame : {1u, 3u, 4u, 1u}) {
    const std::size_t worker = schedule.add_worker(1);
    CHECK(schedule.likely_first_frame(worker) == frame);
  }
  for (const std::size_t frame : {1u, 3u, 4u}) schedule.skip_frame(frame);
  CHECK_FALSE(schedule.likely_first_frame(0).has_value());
}

TEST_CASE("a worker is dealt the frame that it has made ready, in whatever order workers ask") {
  BucketSchedule schedule(4, 10);
  for (int n = 0; n < 3; ++n) schedule.add_worker(1);
  for (const std::size_t worker : {0u, 1u, 2u})
    schedule.was_ready_after(worker, *schedule.likely_first_frame(worker), 1.0);
  for (const std::size_t worker : {2u, 0u, 1u}) CHECK(schedule.deal(worker, 0.0)->run.frame == worker);
}

TEST_CASE("a tile is taken to cost what it has cost in the frames before, on machines of any speed") {
  TileCosts costs(4);
  CHECK(costs[2] == 1.0);
  // Two machines, one three times as fast, that have each traced two whole frames of tiles that cost 1, 2, 4 and 5.
  TileCosts::Machine slow, fast;
  for (int frame = 0; frame < 12; ++frame)
    for (std::uint32_t tile = 0; tile < 4; ++tile) {
      const double cost = std::array{1.0, 2.0, 4.0, 5.0}[tile];
      costs.learn(tile, frame % 2 ? cost : 3.0 * cost, frame % 2 ? fast : slow);
    }
  for (std::uint32_t tile = 0; tile < 4; ++tile)
    CHECK(costs[tile] == relative(std::array{1.0, 2.0, 4.0, 5.0}[tile] / 3.0, 0.15));
  const double before = costs[1];
  for (const double nonsense : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    costs.learn(1, nonsense, slow);
  CHECK(costs[1] == before);
}

TEST_CASE(
    "where costs are foretold by the frame before, films are dealt as well as where they are found out by splitting") {
  for (const std::size_t frames : {4u, 8u, 16u, 20u}) {
    const Ended known = simulate(frames, mixed(15), Dealing::split, 4.0),
                unknown = simulate(frames, mixed(15), Dealing::split, 4.0, false);
    MESSAGE(frames, " frames: ", known.efficiency, " with costs, ", unknown.efficiency, " without; splits ",
            known.splits, ", ", unknown.splits, "; twice ", known.twice, ", ", unknown.twice);
    CHECK(known.efficiency >= unknown.efficiency - 0.01);
  }
}

TEST_CASE("what a worker had begun that dies unnoticed is traced by others") {
  for (const double dies_s : {0.0, 3.0, 17.0, 40.0}) {
    CAPTURE(dies_s);
    std::vector<Simulated> workers(3, {100.0});
    workers[1].dies_s = dies_s;
    const Ended ended = simulate(2, workers, Dealing::split);
    CHECK(ended.efficiency > 0.4);
    CHECK(ended.missing == 0);
    // All workers but one.
    workers[2].dies_s = dies_s;
    const Ended last = simulate(2, workers, Dealing::split);
    CAPTURE(last.twice);
    CHECK(last.efficiency > 0.15);
  }
}

TEST_CASE("a worker may join late") {
  std::vector<Simulated> workers(2, {100.0});
  workers[1].joins_s = 100.0;
  const double alone = simulate(1, {{100.0}}, Dealing::split).efficiency;
  CHECK(alone > 0.999);
  CHECK(simulate(1, workers, Dealing::split).efficiency > 0.55);
}

TEST_CASE("what is there already is not dealt") {
  BucketSchedule schedule(3, 10);
  schedule.skip_frame(0);
  for (const std::uint32_t tile : {0u, 1u, 5u}) schedule.skip_tile(1, tile);
  const std::size_t worker = schedule.add_worker(2);
  std::vector<int> count(30);
  while (!schedule.has_all()) {
    const auto deal = schedule.deal(worker, 0.0);
    REQUIRE(deal.has_value());
    for (std::uint32_t tile = deal->run.first; tile < deal->run.end; ++tile) {
      ++count[10 * deal->run.frame + tile];
      CHECK(schedule.finish(worker, deal->run.frame, tile, 1.0));
      CHECK_FALSE(schedule.finish(worker, deal->run.frame, tile, 1.0));
    }
  }
  CHECK(count ==
        std::vector<int>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  CHECK_FALSE(schedule.deal(worker, 2.0).has_value());
}

TEST_CASE("what a worker holds that is known to be gone is dealt anew") {
  for (const Dealing dealing : {Dealing::split, Dealing::equal, Dealing::round_robin}) {
    BucketSchedule schedule(1, 100, {.dealing = dealing, .equal_buckets = 7});
    const std::size_t a = schedule.add_worker(1), b = schedule.add_worker(1);
    const auto lost = schedule.deal(a, 0.0);
    REQUIRE(lost.has_value());
    CHECK(schedule.finish(a, 0, lost->run.first, 1.0));
    schedule.remove_worker(a);
    std::vector<int> count(100);
    while (!schedule.has_all()) {
      const auto deal = schedule.deal(b, 1.0);
      REQUIRE(deal.has_value());
      for (std::uint32_t tile = deal->run.first; tile < deal->run.end; ++tile) {
        ++count[tile];
        schedule.finish(b, 0, tile, 1.0);
      }
    }
    CHECK(count[lost->run.first] == 0);
    CHECK(std::count(count.begin(), count.end(), 1) == 99);
  }
}

}  // namespace septet::raytrace
