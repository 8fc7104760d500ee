// Hostile clients of a screen host, all with keys of its list: any messages of the secure lane in any order,
// connections that come and go, while the server reads. See the script that the bytes are.

#include "tests/sim-server/client_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace septet;
  const auto bytes = std::as_bytes(std::span(data, size));
  if (bytes.empty()) return 0;
  // A control message by itself: a decoded one is encoded the same, and decoded again.
  if (const auto message = control::decode_control(bytes)) {
    const Bytes again = control::encode_control(*message);
    if (!control::decode_control(again) || again.size() != bytes.size()) std::abort();
  }
  server::ClientScript rig;
  if (std::to_integer<int>(bytes[0]) % 2 == 0) rig.connect_all();
  rig.play(bytes.subspan(1));
  return 0;
}
