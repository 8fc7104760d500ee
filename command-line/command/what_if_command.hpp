#pragma once
/// `septet what-if SESSION --change INPUT:CHANGE`: a driven session again with a change of the driver's inputs, once as
/// a session of its own, or in many variants as a table and a plot (docs/what-if.md).

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-server/drive/what_if/variant.hpp"

namespace septet::server {

struct WhatIfCommandOptions {
  std::filesystem::path session;
  std::vector<std::string> changes;  ///< As parse_change takes them; none: the logged inputs are run again.
  std::size_t runs = 0;              ///< Of a car that goes by a table: this many, each within the table's ±.
  std::size_t sessions = 0;          ///< Of them, this many of the first as sessions, to be shown as ghosts.
  WhatIfOptions run;
  std::filesystem::path out;  ///< Empty: the folder what-if beside the session.
  unsigned jobs = 0;          ///< Variants at once; 0: this program's share of the processors.
};

/// The folder that the results go to.
std::filesystem::path what_if_folder(const WhatIfCommandOptions& options);

/// Says what each came to, and writes what-if.csv, beside it what-if.sqlite of one variant or what-if.svg of a range.
/// With `runs` the variants are those of the table, and the first `sessions` of them lie beside it: run-1.sqlite, ….
/// Where mpirun has started this program, all of its programs share the variants; the first one writes.
Expected<int> run_what_if(const WhatIfCommandOptions& options, std::ostream& out);

}  // namespace septet::server
