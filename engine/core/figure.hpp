#pragma once
/// A measured number with its name and unit, as a report lists it.

#include <string>

namespace septet {

struct Figure {
  std::string name;
  double value = 0.0;
  std::string unit;
};

}  // namespace septet
