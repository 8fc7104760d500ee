// DBC files of any bytes: an accepted one can be sent, heard and planned.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "car-io/can/can_plan.hpp"
#include "car-io/can/dbc.hpp"
#include "car-io/can/signal_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace septet;
  using namespace septet::car_io;
  const auto database = dbc::read_dbc(std::string_view(reinterpret_cast<const char*>(bytes), size), "fuzz.dbc");
  if (!database) {
    if (database.error().what.empty() || !database.error().where.starts_with("fuzz.dbc")) std::abort();
    return 0;
  }
  for (const dbc::Message& message : database->messages) {
    std::array<std::byte, 64> frame{};
    const auto data = std::span(frame).first(message.bytes);
    for (const dbc::Signal& signal : message.signals) {
      for (const double value : {0.0, -1e300, 1e300, std::nan(""), 3.7}) dbc::encode(signal, value, data);
      if (!signal.selected_by && !dbc::decode(message, signal, data)) std::abort();
      dbc::decode(message, signal, data.first(data.size() / 2));
    }
    if (message.signals.size() < 32) dbc::overlap(message);
  }
  (void)plan_can(*database, {.signals = {{"SPEED.speed_kmh", "engine_rpm", 0.0}}});
  return 0;
}
