#pragma once
/// A process as others may know it, who see at once that it is gone where they run on the same machine.

#include <cstdint>
#include <optional>
#include <string>

#include "engine/core/bytes.hpp"

namespace septet::program {

struct ProcessMark {
  std::string machine;  ///< Alike for processes that see each other's numbers.
  std::int32_t number = 0;
  bool operator==(const ProcessMark&) const = default;
};

ProcessMark own_process_mark();

void put_process(ByteWriter& writer, const ProcessMark& process);
ProcessMark get_process(ByteReader& reader);

/// Whether the process is there; nothing where it runs on another machine.
std::optional<bool> is_there(const ProcessMark& process);

}  // namespace septet::program
