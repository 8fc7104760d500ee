#pragma once
/// The page while no drive goes on: a drive is chosen and started here, and past ones are looked at.
///
///     auto page = StartPage::open(listening, …);
///     again and again:  page->show(view);  for (auto& wish : page->take_wishes()) page->answer(wish, …);
///
/// Everything that browsers do is done in the page's own thread. A file of a past session is read there, by a path that is made of the
/// folder of that session and a name that is one of a few: no bytes of a browser are part of it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-server/page/drive_choice.hpp"
#include "sim-server/page/listening_socket.hpp"
#include "sim-server/page/wish_box.hpp"

namespace septet::page {

/// What is made of a past drive.
struct PastWorkView {
  std::uint64_t session = 0;
  std::string what;  ///< "film" or "replay".
  bool is_running = false, has_failed = false;
  std::string said;  ///< Its newest line.
  bool operator==(const PastWorkView&) const = default;
};

/// How things stand without a drive.
struct StartView {
  bool is_starting = false;
  std::string command;            ///< What was started, as a command line.
  std::vector<std::string> said;  ///< What it has said so far, or at its end.
  std::string last;               ///< How the last drive ended, or why it did not start.
  bool has_failed = false;        ///< That.
  std::vector<PastSession> sessions;
  std::optional<PastWorkView> work;
  bool is_looking = false;  ///< Not all of them have been read yet.
};

class StartPage {
 public:
  static Expected<std::unique_ptr<StartPage>> open(const ListeningSocket& listening, std::string token,
                                                   std::vector<std::string> allowed_hosts, Choices choices);
  /// Browsers that look on are told that they will be served by the drive.
  ~StartPage();

  /// `folders` are those of the view's sessions.
  void show(StartView view, std::vector<std::filesystem::path> folders);
  std::vector<OperatorWish> take_wishes();
  void answer(const OperatorWish& wish, const std::optional<std::string>& why_not);

 private:
  struct Shared;
  explicit StartPage(std::unique_ptr<Shared> shared);
  std::unique_ptr<Shared> shared_;
};

/// Files of a past session that may be looked at: those of its results, and the pictures that they show.
bool is_past_file(std::string_view name);
inline constexpr std::size_t largest_past_file_bytes = std::size_t{64} << 20,
                             largest_film_bytes = std::size_t{512} << 20;

}  // namespace septet::page
