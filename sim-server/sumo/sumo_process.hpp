#pragma once
/// SUMO as a child process: its network made by `netconvert`, then `sumo` itself, waiting for a client.

#include <filesystem>
#include <memory>

#include "engine/core/expected.hpp"
#include "sim-server/child_process.hpp"
#include "sim-server/sumo/sumo_client.hpp"
#include "sim-server/sumo/sumo_network.hpp"

namespace septet::server {

struct SumoOptions {
  double step_s = 0.05;
  std::uint64_t seed = 1;
};

/// A SUMO that runs and the client that talks to it; both end with this, and so does the folder with SUMO's files.
class SumoProcess {
 public:
  /// Error: SUMO is not installed, does not accept the network, or does not answer.
  static Expected<std::unique_ptr<SumoProcess>> start(const SumoNetwork& network, const SumoOptions& options);
  ~SumoProcess();

  SumoClient& client() { return *client_; }

 private:
  SumoProcess() = default;
  Expected<void> write_files(const SumoNetwork& network);
  Expected<void> convert_network();
  Expected<void> run(const SumoOptions& options);

  std::filesystem::path folder_;
  std::optional<ChildProcess> process_;
  std::unique_ptr<SumoClient> client_;
};

}  // namespace septet::server
