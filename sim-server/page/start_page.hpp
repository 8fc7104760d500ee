#pragma once
/// The page while there is no drive: a drive is chosen and started here, and past ones are viewed.
///
///     auto page = StartPage::open(listening, …);
///     again and again:  page->show(view);  for (auto& wish : page->take_wishes()) page->answer(wish, …);
///
/// Browsers are served in the page's own thread. A file of a past session is read there, by a path made of the folder
/// of that session and a name from a short list: no bytes of a browser are part of it.

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

/// Product of a past drive in the making.
struct PastWorkView {
  std::uint64_t session = 0;
  std::string what;  ///< "film" or "replay".
  bool is_running = false, has_failed = false;
  std::string said;  ///< Its newest output line.
  bool operator==(const PastWorkView&) const = default;
};

/// State without a drive.
struct StartView {
  bool is_starting = false;
  std::string command;            ///< Command line of the started program.
  std::vector<std::string> said;  ///< Its output so far, or at its end.
  std::string last;               ///< End of the last drive, or the reason that it did not start.
  bool has_failed = false;        ///< The last drive failed.
  std::vector<PastSession> sessions;
  std::optional<PastWorkView> work;
  bool is_looking = false;  ///< Not all of them have been read yet.
};

class StartPage {
 public:
  static Expected<std::unique_ptr<StartPage>> open(const ListeningSocket& listening, std::string token,
                                                   std::vector<std::string> allowed_hosts, Choices choices);
  /// Viewers are told that the drive will serve them.
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

/// True for files of a past session that may be viewed: its results, and the pictures that they show.
bool is_past_file(std::string_view name);
inline constexpr std::size_t largest_past_file_bytes = std::size_t{64} << 20,
                             largest_film_bytes = std::size_t{512} << 20;

}  // namespace septet::page
