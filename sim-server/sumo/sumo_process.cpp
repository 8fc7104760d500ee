#include "sim-server/sumo/sumo_process.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/document/text_file.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
namespace {

constexpr auto patience = 5min;

// The drivers are Septet's: car following by IDM with each one's own parameters, and without SUMO's own factor on the
// limit. Lateral movement is continuous, by SUMO's sublane model, and vehicles with a beacon have SUMO's own device for
// them.
constexpr const char* types_xml = R"(<additional>
<vType id="driver" carFollowModel="IDM" laneChangeModel="SL2015" vClass="passenger" latAlignment="center" lcSigma="0" speedFactor="1" speedDev="0"/>
<vType id="foreign" carFollowModel="IDM" laneChangeModel="SL2015" vClass="passenger" latAlignment="center"/>
<vType id="emergency" carFollowModel="IDM" laneChangeModel="SL2015" vClass="emergency" latAlignment="arbitrary">
<param key="has.bluelight.device" value="true"/><param key="device.bluelight.reactiondist" value="300"/></vType>
</additional>
)";

Expected<fs::path> find_program(const std::string& name) {
  std::stringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::path(folder.empty() ? "." : folder) / name; ::access(file.c_str(), X_OK) == 0)
      return file;
  return failure(fmt::format("SUMO is not installed: there is no program {}", name), "--traffic sumo",
                 "install the package sumo (apt install sumo), or drive with --traffic own");
}

/// A port of this machine that is free now.
Expected<int> free_port() {
  const int probe = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool found = probe >= 0 && ::bind(probe, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     ::getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  if (probe >= 0) ::close(probe);
  if (!found) return failure("no free port for SUMO", "127.0.0.1", "close programs that hold ports");
  return ntohs(address.sin_port);
}

/// The last error line of SUMO's own log; empty: none.
std::string error_in(const fs::path& log) {
  std::ifstream file(log);
  std::string error;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("Error")) error = line;
  return printable(error);
}

std::string error_or_end(const fs::path& log) {
  const std::string error = error_in(log);
  return error.empty() ? "it ended at once" : error;
}

/// Adds SUMO's own explanation to each of its client's errors.
class ExplainingClient final : public SumoClient {
 public:
  ExplainingClient(std::unique_ptr<SumoClient> client, fs::path log)
      : client_(std::move(client)), log_(std::move(log)) {}

  Expected<void> define_type(const SumoVehicleType& type) override { return explained(client_->define_type(type)); }
  Expected<void> add_vehicle(const SumoDeparture& departure) override {
    return explained(client_->add_vehicle(departure));
  }
  Expected<void> remove_vehicle(ParticipantId id) override { return explained(client_->remove_vehicle(id)); }
  Expected<void> place_vehicle(ParticipantId id, const Vec2& front_m, double heading_rad) override {
    return explained(client_->place_vehicle(id, front_m, heading_rad));
  }
  Expected<void> set_standstill_gap(ParticipantId id, double gap_m) override {
    return explained(client_->set_standstill_gap(id, gap_m));
  }
  Expected<void> hold_vehicle(ParticipantId id, bool held) override {
    return explained(client_->hold_vehicle(id, held));
  }
  Expected<void> move_aside(ParticipantId id, double left_m) override {
    return explained(client_->move_aside(id, left_m));
  }
  Expected<std::vector<SumoVehicle>> step() override { return explained(client_->step()); }

 private:
  template <class Value>
  Expected<Value> explained(Expected<Value> outcome) const {
    if (outcome) return outcome;
    Error error = outcome.error();
    if (const std::string said = error_in(log_); !said.empty()) error.what += "; SUMO's own words: " + said;
    return tl::unexpected(std::move(error));
  }

  std::unique_ptr<SumoClient> client_;
  fs::path log_;
};

}  // namespace

Expected<std::unique_ptr<SumoProcess>> SumoProcess::start(const SumoNetwork& network, const SumoOptions& options) {
  auto folder = program::TemporaryFolder::make("septet-sumo");
  if (!folder) return tl::unexpected(folder.error());
  std::unique_ptr<SumoProcess> sumo(new SumoProcess(std::move(*folder)));
  auto done = sumo->write_files(network).and_then([&] { return sumo->convert_network(); }).and_then([&] {
    return sumo->run(options);
  });
  if (!done) return tl::unexpected(done.error());
  return sumo;
}

Expected<void> SumoProcess::write_files(const SumoNetwork& network) {
  return document::write_text_files(folder_.path(), {{"nodes.xml", network.nodes_xml},
                                                     {"edges.xml", network.edges_xml},
                                                     {"connections.xml", network.connections_xml},
                                                     {"types.xml", types_xml}});
}

Expected<void> SumoProcess::convert_network() {
  const auto program = find_program("netconvert");
  if (!program) return tl::unexpected(program.error());
  const auto in = [&](const char* name) { return (folder_.path() / name).string(); };
  auto process = program::ChildProcess::start({.program = program->string(),
                                               .arguments = {"--node-files",
                                                             in("nodes.xml"),
                                                             "--edge-files",
                                                             in("edges.xml"),
                                                             "--connection-files",
                                                             in("connections.xml"),
                                                             "--output-file",
                                                             in("net.xml"),
                                                             "--precision",
                                                             "4",
                                                             "--offset.disable-normalization",
                                                             "true",
                                                             "--no-turnarounds",
                                                             "true",
                                                             "--no-warnings",
                                                             "true",
                                                             "--xml-validation",
                                                             "never",
                                                             "--log",
                                                             in("netconvert.log")},
                                               .environment = {},
                                               .log = folder_.path() / "netconvert.err"});
  if (!process) return tl::unexpected(process.error());
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!process->poll() && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(5ms);
  if (!process->poll() || process->poll()->code != 0)
    return failure("SUMO's netconvert does not accept the road: " + error_or_end(folder_.path() / "netconvert.err"),
                   "--traffic sumo", "drive with --traffic own");
  return {};
}

Expected<void> SumoProcess::run(const SumoOptions& options) {
  // SUMO's client writes to its socket without MSG_NOSIGNAL: a SUMO that is gone must be an error, not this program's
  // end.
  std::signal(SIGPIPE, SIG_IGN);
  const auto connect = load_sumo_module();
  if (!connect) return tl::unexpected(connect.error());
  const auto program = find_program("sumo");
  if (!program) return tl::unexpected(program.error());
  const auto port = free_port();
  if (!port) return tl::unexpected(port.error());
  const auto in = [&](const char* name) { return (folder_.path() / name).string(); };
  auto process = program::ChildProcess::start({.program = program->string(),
                                               .arguments = {"--net-file",
                                                             in("net.xml"),
                                                             "--additional-files",
                                                             in("types.xml"),
                                                             "--remote-port",
                                                             std::to_string(*port),
                                                             "--step-length",
                                                             fmt::format("{}", options.step_s),
                                                             "--step-method.ballistic",
                                                             "true",
                                                             "--lateral-resolution",
                                                             "0.8",
                                                             "--seed",
                                                             std::to_string(options.seed % 2147483647),
                                                             "--collision.action",
                                                             "none",
                                                             "--ignore-route-errors",
                                                             "true",
                                                             "--time-to-teleport",
                                                             "-1",
                                                             "--no-step-log",
                                                             "true",
                                                             "--no-warnings",
                                                             "true",
                                                             "--xml-validation",
                                                             "never",
                                                             "--xml-validation.net",
                                                             "never",
                                                             "--log",
                                                             in("sumo.log")},
                                               .environment = {},
                                               .log = folder_.path() / "sumo.err"});
  if (!process) return tl::unexpected(process.error());
  process_ = std::move(*process);
  // Only the start has a wall-clock limit; from the first step on, SUMO's time is the simulation's.
  const auto until = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < until) {
    if (process_->poll())
      return failure("SUMO does not start: " + error_or_end(folder_.path() / "sumo.err"), "--traffic sumo",
                     "drive with --traffic own");
    auto client = (*connect)(*port);
    if (client) {
      client_ = std::make_unique<ExplainingClient>(std::move(*client), folder_.path() / "sumo.err");
      return {};
    }
    std::this_thread::sleep_for(20ms);
  }
  return failure("SUMO does not answer", "--traffic sumo",
                 "look whether the machine is overloaded, or drive with --traffic own");
}

}  // namespace septet::server
