#include "command-line/command/road_command.hpp"

#include "engine/core/regular_file.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_tables.hpp"
#include "program/console.hpp"

namespace septet::server {
namespace {

using Table = Expected<void> (*)(const road::RoadNetwork&, std::istream&, std::ostream&);

Expected<int> write(const std::string& file, std::istream& in, std::ostream& out, Table table) {
  std::vector<road::Finding> warnings;
  const auto outcome =
      read_regular_file(file)
          .and_then([&](const std::string& text) { return road::read_opendrive(text, file, &warnings); })
          .and_then([&](const road::RoadNetwork& network) { return table(network, in, out); })
          .and_then([&]() -> Expected<void> {
            if (out.flush()) return {};
            return failure("the table cannot be written", "standard output",
                           "free space, or keep the reading program running");
          });
  for (const road::Finding& warning : warnings) program::say("warning: " + describe(warning.error));
  if (!outcome) return tl::unexpected(outcome.error());
  return 0;
}

}  // namespace

Expected<int> run_road_sample(const std::string& file, std::istream& in, std::ostream& out) {
  return write(file, in, out, road::sample_table);
}
Expected<int> run_road_locate(const std::string& file, std::istream& in, std::ostream& out) {
  return write(file, in, out, road::locate_table);
}

}  // namespace septet::server
