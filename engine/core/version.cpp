#include "engine/core/version.hpp"

namespace septet {
namespace {

/// Found in a program's bytes by .ci/verdict, which leaves the commit out: a commit alone makes no other program.
[[gnu::used]] constexpr char marked_revision[64] = "revision of Septet: " SEPTET_REVISION;

/// Hides an address from the optimiser, which else writes short texts into the code.
const char* hidden(const char* text) {
  asm("" : "+r"(text));
  return text;
}

}  // namespace

const std::string_view version = SEPTET_VERSION;
const std::string_view revision = hidden(marked_revision) + std::string_view("revision of Septet: ").size();

std::string version_text() {
  return std::string(version) + (revision.empty() ? "" : " (" + std::string(revision) + ")");
}

}  // namespace septet
