#pragma once
/// SUMO as a child process: its network made by `netconvert`, then `sumo` itself, waiting for a client.

#include <memory>
#include <optional>

#include "engine/core/expected.hpp"
#include "program/child_process.hpp"
#include "program/temporary_folder.hpp"
#include "sim-server/sumo/sumo_client.hpp"
#include "sim-server/sumo/sumo_network.hpp"

namespace septet::server {

struct SumoOptions {
  double step_s = 0.05;
  std::uint64_t seed = 1;
};

/// A running SUMO and the client that talks to it; both end with this, and so does the folder with SUMO's files.
class SumoProcess {
 public:
  /// Error: SUMO is not installed, does not accept the network, or does not reply.
  static Expected<std::unique_ptr<SumoProcess>> start(const SumoNetwork& network, const SumoOptions& options);

  SumoClient& client() { return *client_; }

 private:
  explicit SumoProcess(program::TemporaryFolder folder) : folder_(std::move(folder)) {}
  Expected<void> write_files(const SumoNetwork& network);
  Expected<void> convert_network();
  Expected<void> run(const SumoOptions& options);

  // Destroyed in the opposite order: the client, SUMO, the files that it reads.
  program::TemporaryFolder folder_;
  std::optional<program::ChildProcess> process_;
  std::unique_ptr<SumoClient> client_;
};

}  // namespace septet::server
