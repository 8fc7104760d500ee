#pragma once
/// `septet check FILE…`: all faults of roads, scenarios, catalogs, rigs, vehicles, film scripts, models and sessions,
/// one line each or as JSON (docs/check.md).

#include <iosfwd>
#include <string>
#include <vector>

namespace septet::server {

struct CheckOptions {
  std::vector<std::string> files;
  bool json = false;
  bool strict = false;  ///< Warnings count in the exit status.
};

/// Returns 1 if any file has an error, or with `strict` a warning, else 0.
int run_check(const CheckOptions& options, std::ostream& out);

}  // namespace septet::server
