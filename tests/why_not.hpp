#pragma once
/// Message of an `Expected` that may have failed, for what a test says.

#include <string>

#include "engine/core/expected.hpp"

namespace septet {

/// Empty where it has not failed.
template <class T>
std::string why_not(const Expected<T>& result) {
  return result ? std::string() : describe(result.error());
}

}  // namespace septet
