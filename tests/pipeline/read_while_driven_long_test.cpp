// 24 drives in real time, each with a reader of its session meanwhile: all whole, all with exit status 0.

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "logging/session/session_reader.hpp"
#include "tests/pipeline/foreign_reader.hpp"
#include "tests/pipeline/x_display.hpp"

namespace septet::pipeline {
namespace {

/// One of Septet's own readers, again and again.
class OwnReader {
 public:
  OwnReader(const fs::path& out, std::vector<std::string> arguments) : out_(out), arguments_(std::move(arguments)) {
    thread_ = std::thread([this] {
      std::error_code ignored;
      while (!is_over_) {
        if (fs::exists(out_ / "session.sqlite", ignored)) {
          auto reader = start("septet", arguments_, out_.string() + ".reader");
          (void)exit_code(reader);
          ++looks_;
        }
        std::this_thread::sleep_for(50ms);
      }
    });
  }
  OwnReader(const OwnReader&) = delete;
  OwnReader& operator=(const OwnReader&) = delete;
  ~OwnReader() {
    is_over_ = true;
    thread_.join();
  }
  int looks() const { return looks_; }

 private:
  fs::path out_;
  std::vector<std::string> arguments_;
  std::atomic<bool> is_over_ = false;
  std::atomic<int> looks_ = 0;
  std::thread thread_;
};

struct Driven {
  int code = 0;
  std::string said;
};

/// Three seconds in real time without a screen, with traffic and a simulated driver.
Driven drive_headless(const TemporaryFolder& folder, const fs::path& out) {
  write_text(folder / "small.toml", small_rig(1));
  const auto keys = make_keys(folder / "keys", "a");
  auto server = start("septet-server",
                      {"--rig", (folder / "small.toml").string(), "--scenario", "rescue-lane", "--driver", "plain",
                       "--parameter", "vehicles=40", "--keys", keys.string(), "--out", out.string(), "--any-port",
                       "--wait-for-screens", "0", "--start-now", "--seconds", "3"},
                      out.string() + ".err");
  const int code = exit_code(server);
  return {code, text_of(out.string() + ".err")};
}

/// The same in a window.
Driven drive_in_window(const XDisplay& display, const fs::path& out) {
  const auto ended = run("septet",
                         {"drive", "--rig", "desktop", "--scenario", "rescue-lane", "--driver", "plain", "--parameter",
                          "vehicles=40", "--start-now", "--seconds", "3", "--out", out.string()},
                         out.string() + ".err", display.environment());
  return {ended.code, ended.error};
}

void check_whole(const Driven& driven, const fs::path& out) {
  INFO(driven.said);
  CHECK(driven.code == 0);
  const auto reader = logging::SessionReader::open(out / "session.sqlite");
  REQUIRE(reader.has_value());
  CHECK(reader->ended_cleanly());
  CHECK(reader->check_integrity().has_value());
  CHECK(reader->missing_ticks() == 0);
  CHECK(text_of(out / "summary.json").find("\"exit_status\": 0") != std::string::npos);
  CHECK(run("septet", {"replay", "--verify", (out / "session.sqlite").string()}, out.string() + ".verify").code == 0);
}

}  // namespace

TEST_CASE("24 drives in real time are whole and end with 0 whoever reads them") {
  const XDisplay display;
  for (int n = 0; n < 24; ++n) {
    CAPTURE(n);
    const TemporaryFolder folder;
    const fs::path out = folder / "out";
    const bool in_window = n % 8 == 7;  // One of each kind of foreign reader.
    const auto drive = [&] { return in_window ? drive_in_window(display, out) : drive_headless(folder, out); };
    const std::string session = (out / "session.sqlite").string();
    if (!in_window && n % 4 == 3) {
      const std::vector<std::string> commands[] = {
          {"check", session}, {"replay", "--verify", session}, {"report", session}};
      const OwnReader reader(out, commands[(n / 8) % 3]);
      check_whole(drive(), out);
      CHECK(reader.looks() > 0);
    } else {
      constexpr Reading kinds[] = {Reading::idle, Reading::transaction, Reading::coming_and_going};
      const ForeignReader reader(session, kinds[(in_window ? n / 8 : n) % 3], n % 2 == 0);
      check_whole(drive(), out);
      CHECK(reader.looks() > 0);
    }
  }
}

}  // namespace septet::pipeline
