#pragma once
/// Ascending participants in the data of a keyframe: each as a varint of the gap from the one before, the first from 0.

#include <cstdint>

#include "engine/core/bytes.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

class AscendingIdWriter {
 public:
  void put(ParticipantId id, ByteWriter& out) {
    out.put_varint(id - before_);
    before_ = id;
  }

 private:
  ParticipantId before_ = 0;
};

class AscendingIdReader {
 public:
  /// Fails the reader where the number does not ascend, or is none of 32 bits.
  ParticipantId get(ByteReader& in) {
    const std::uint64_t gap = in.get_varint();
    if ((gap == 0 && !is_first_) || gap > 0xffffffffu || (id_ += gap) > 0xffffffffu) in.fail();
    is_first_ = false;
    return static_cast<ParticipantId>(id_);
  }

 private:
  std::uint64_t id_ = 0;
  bool is_first_ = true;
};

}  // namespace septet
