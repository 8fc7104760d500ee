/// The car on a machine of its own: septet-server and septet-car as two programs. Only the USB device is missing.

#include <csignal>

#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

TEST_CASE("septet-car is let in by its key and learns from the server which device it lacks") {
  const TemporaryFolder folder;
  // The one product id that no device of the vendor has.
  write_text(folder / "small.toml", small_rig(1, "", "source = \"hid\"\nmachine = \"car-pc\"\nproduct_id = 0xfffe"));
  const fs::path keys = make_keys(folder / "keys", "a");
  const auto car = net::load_or_create_identity(keys / "car.key");
  REQUIRE(car.has_value());
  const std::string screens_only = text_of(keys / "allowed-clients");
  const auto serve = [&](const std::string& allowed, const std::string& name) {
    write_text(keys / "allowed-clients", allowed);
    auto server = start("septet-server",
                        {"--rig", (folder / "small.toml").string(), "--keys", keys.string(), "--out",
                         (folder / name).string(), "--any-port"},
                        folder / (name + ".err"));
    const std::string port = ready_port(server, folder / (name + ".err"));
    auto process =
        start("septet-car", {"--server", "127.0.0.1:" + port, "--keys", keys.string()}, folder / (name + "-car.err"));
    // A refused one goes on asking: visible once the server has replied.
    const auto refused = [&] {
      return text_of(folder / (name + ".err")).find("refused a client") != std::string::npos;
    };
    becomes_true([&] { return process.poll().has_value() || refused(); });
    const int code = exit_code(process, refused() ? 200ms : patience);
    server.send_signal(SIGTERM);
    CHECK(exit_code(server) == 3);
    return code;
  };

  CHECK(serve(screens_only + net::to_text(car->public_key()) + " car\n", "known") == 1);
  const std::string said = text_of(folder / "known-car.err");
  CAPTURE(said);
  CHECK(said.find("1209:fffe") != std::string::npos);
  CHECK(said.find("not plugged in") != std::string::npos);
  const std::string server_said = text_of(folder / "known.err");
  CAPTURE(server_said);
  CHECK(server_said.find("car connected") != std::string::npos);

  // Without its key on the list it hears nothing, and keeps asking until it is told to stop.
  CHECK(serve(screens_only, "unknown") == -2);
  CHECK(text_of(folder / "unknown-car.err").find("1209:fffe") == std::string::npos);
  CHECK(text_of(folder / "unknown.err").find("refused a client") != std::string::npos);
}

}  // namespace septet::pipeline
