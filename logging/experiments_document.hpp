#pragma once
/// The document that lists the keys of experiments and questionnaires: a message about an unknown key names it.

namespace septet::logging {

inline constexpr const char* experiments_document = "docs/experiments.md";

}  // namespace septet::logging
