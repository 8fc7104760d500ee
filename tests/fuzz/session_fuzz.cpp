// Altered session files: bytes anywhere in a small session, or any value in one of its cells. All of it is read, the
// report drawn and the scene restored.
//
// The first byte is even: patches follow, each of three bytes where, one how long and so many bytes. Odd: the next byte
// says in which cell the rest is put, and whether as bytes, as text or as a number.
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/store.hpp"
#include "engine/world/crash_record.hpp"
#include "logging/session/outcome.hpp"
#include "logging/session/recorded_scene.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/session/session_writer.hpp"
#include "logging/study/report/report.hpp"

namespace {

using namespace septet;
namespace fs = std::filesystem;

void require(bool holds) {
  if (!holds) std::abort();
}

struct Cell {
  std::string table, column;
};

/// A good session and a file to put altered ones into.
class Place {
 public:
  Place() {
    std::string name = (fs::temp_directory_path() / "septet-session-fuzz-XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr);
    folder_ = name;
    const fs::path good = folder_ / "good.sqlite";
    record(good);
    std::ifstream in(good, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    require(!bytes_.empty());
    find_cells(good);
  }
  ~Place() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path file() const { return folder_ / "altered.sqlite"; }
  void write(const std::string& bytes) const {
    std::error_code ignored;
    for (const char* beside : {"-wal", "-shm", "-journal"}) fs::remove(file().string() + beside, ignored);
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << bytes;
  }
  const std::string& good() const { return bytes_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  static void record(const fs::path& path) {
    logging::SessionInfo info;
    info.septet_version = "0.1.0";
    info.ticks_per_second = 120.0;
    info.seeds = {{"traffic", 7}};
    info.files = {{"rig", "r.toml", "[[screen]]\n"}};
    auto writer = logging::SessionWriter::create(path, info);
    require(writer.has_value());
    Snapshot snapshot;
    snapshot.participants.resize(2);
    snapshot.participants[0].id = 1;
    snapshot.participants[1].id = 2;
    for (Tick tick = 0; tick < 6; ++tick) {
      snapshot.tick = tick;
      snapshot.simulated_time_s = static_cast<double>(tick) / 120.0;
      snapshot.participants[0].world_from_vehicle.position_m.x = static_cast<double>(tick);
      writer->record(std::make_shared<const TakenSnapshot>(snapshot));
      writer->record(logging::InputRecord{.tick = tick});
      writer->record(logging::Sample{.tick = tick, .simulated_time_s = snapshot.simulated_time_s});
    }
    writer->record(logging::Event{.tick = 3, .simulated_time_s = 0.025, .kind = "collision"});
    CrashRecord crash{.tick = 3, .first = 1, .second = 2, .closing_speed_mps = 10.0};
    crash.of_first.delta_v_mps = Vec2(-5.0, 1.0);
    crash.ledger = CrashLedger{8e4, 4e4, 3e4, 5e3, 1e3, 4e3};
    crash.pulse_ns = {Vec2(1e3, 0.0), Vec2(2e3, 50.0)};
    writer->record(logging::Event{.tick = 5,
                                  .simulated_time_s = 0.04,
                                  .kind = std::string(crash_event),
                                  .participant = 1,
                                  .detail = text_of(crash)});
    writer->record(logging::QuestionnaireRecord{.item = "q1"});
    require(writer->finish({{"outcome", logging::to_json(logging::DriveOutcome{})}}).has_value());
  }

  void find_cells(const fs::path& path) {
    sqlite3* database = nullptr;
    require(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
    const auto add = [](void* cells, int, char** values, char**) {
      static_cast<std::vector<Cell>*>(cells)->push_back({values[0], values[1]});
      return 0;
    };
    require(
        sqlite3_exec(database,
                     "SELECT m.name, c.name FROM sqlite_schema m, pragma_table_info(m.name) c WHERE m.type = 'table'",
                     add, &cells_, nullptr) == SQLITE_OK);
    sqlite3_close(database);
    require(!cells_.empty());
  }

  fs::path folder_;
  std::string bytes_;
  std::vector<Cell> cells_;
};

void patch(const Place& place, std::span<const std::uint8_t> script) {
  std::string bytes = place.good();
  while (script.size() > 4) {
    const std::size_t at = (script[0] | std::size_t{script[1]} << 8 | std::size_t{script[2]} << 16) % bytes.size();
    const std::size_t length = std::min<std::size_t>({script[3], script.size() - 4, bytes.size() - at});
    std::memcpy(bytes.data() + at, script.data() + 4, length);
    script = script.subspan(4 + length);
  }
  place.write(bytes);
}

void put_in_cell(const Place& place, std::uint8_t choice, std::span<const std::uint8_t> value) {
  place.write(place.good());
  sqlite3* database = nullptr;
  require(sqlite3_open(place.file().c_str(), &database) == SQLITE_OK);
  sqlite3_exec(database, "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF", nullptr, nullptr, nullptr);
  const Cell& cell = place.cells()[choice / 3u % place.cells().size()];
  const std::string sql = "UPDATE \"" + cell.table + "\" SET \"" + cell.column +
                          "\" = ? WHERE rowid = (SELECT max(rowid) FROM \"" + cell.table + "\")";
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK) {
    const int length = static_cast<int>(value.size());
    double number = 0.0;
    std::memcpy(&number, value.data(), std::min(value.size(), sizeof number));
    if (choice % 3 == 0) sqlite3_bind_blob(statement, 1, value.data(), length, SQLITE_TRANSIENT);
    if (choice % 3 == 1)
      sqlite3_bind_text(statement, 1, reinterpret_cast<const char*>(value.data()), length, SQLITE_TRANSIENT);
    if (choice % 3 == 2) sqlite3_bind_double(statement, 1, number);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  }
  sqlite3_close(database);
}

void read_everything(const fs::path& file) {
  const auto session = logging::SessionReader::open(file);
  if (!session) {
    require(!session.error().what.empty() && !session.error().remedy.empty());
    return;
  }
  session->inputs();
  session->time_span_s();
  session->check_integrity();
  scene::Store store;
  logging::restore_scene(*session, store);
  if (auto snapshots = session->snapshots())
    for (int row = 0; row < 20; ++row) {
      const auto snapshot = snapshots->next();
      if (snapshot && !*snapshot) break;
    }
  if (const auto data = logging::read_report_data(*session)) logging::to_html(*data);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  if (size < 2) return 0;
  const std::span<const std::uint8_t> script(data, size);
  if (script[0] % 2 == 0)
    patch(place, script.subspan(1));
  else
    put_in_cell(place, script[1], script.subspan(2));
  read_everything(place.file());
  return 0;
}
