#include "engine/core/expected.hpp"

namespace septet {

std::string describe(const Error& error) {
  std::string text;
  if (!error.where.empty()) text += error.where + ": ";
  text += error.what;
  if (!error.remedy.empty()) text += "; " + error.remedy;
  return text;
}

}  // namespace septet
