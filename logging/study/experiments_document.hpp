#pragma once
/// Document that lists the keys of experiments and questionnaires; named in messages about unknown keys.

namespace septet::logging {

inline constexpr const char* experiments_document = "docs/experiments.md";

}  // namespace septet::logging
