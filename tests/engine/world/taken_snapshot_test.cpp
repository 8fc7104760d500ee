#include "engine/world/taken_snapshot.hpp"

#include <vector>

#include <doctest/doctest.h>

namespace septet {

TEST_CASE("memory of snapshots that are gone is used again, and of very many only some is kept") {
  SnapshotMemory memory;
  const auto kept_of = [&](int shared_at_once) {
    std::vector<std::shared_ptr<const TakenSnapshot>> held;
    for (int i = 0; i < shared_at_once; ++i) {
      Snapshot snapshot;
      snapshot.participants.resize(10);
      held.push_back(memory.share(std::move(snapshot)));
    }
    held.clear();
    int kept = 0;
    while (memory.spare().participants.capacity() > 0 && kept <= shared_at_once) ++kept;
    return kept;
  };
  CHECK(kept_of(5) == 5);
  const int most = kept_of(1000);
  CHECK(most > 5);
  CHECK(most <= 100);
}

}  // namespace septet
