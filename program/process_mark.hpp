#pragma once
/// Identity of a process for others, which on the same machine notice its end at once.

#include <cstdint>
#include <optional>
#include <string>

#include "engine/core/bytes.hpp"

namespace septet::program {

struct ProcessMark {
  std::string machine;  ///< Equal for processes that see each other's numbers.
  std::int32_t number = 0;
  bool operator==(const ProcessMark&) const = default;
};

ProcessMark own_process_mark();

void put_process(ByteWriter& writer, const ProcessMark& process);
ProcessMark get_process(ByteReader& reader);

/// True while the process exists; empty if it runs on another machine.
std::optional<bool> is_there(const ProcessMark& process);

}  // namespace septet::program
