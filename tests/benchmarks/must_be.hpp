#pragma once
// What a benchmark cannot go on without.

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "engine/core/expected.hpp"

namespace septet {

/// The value, or the end of the program with the reason.
template <class T>
T must_be(Expected<T> result) {
  if (!result) throw std::runtime_error(describe(result.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace septet
