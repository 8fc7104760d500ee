#include "command-line/command/drive_deletion.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "logging/session/session_editor.hpp"
#include "program/console.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

constexpr std::array results{"summary.json", "report.html", "debrief.html", "panorama.png", "screens"};

/// Removes the results of a drive from its folder, and the folder if nothing else is in it. Returns what stays elsewhere
/// because the folder had only links to it.
std::vector<Error> remove_results(const fs::path& folder) {
  std::vector<Error> left;
  std::error_code error;
  for (const char* name : results) {
    const fs::path result = folder / name;
    if (const fs::path target = fs::is_symlink(result, error) ? fs::canonical(result, error) : fs::path();
        !target.empty())
      left.push_back({"this is left, for the drive's folder had only a link to it", target.string(),
                      "delete it if it is of that drive alone"});
    fs::remove_all(result, error);
  }
  if (!fs::is_symlink(folder, error)) fs::remove(folder, error);  // Only if it is empty.
  return left;
}

}  // namespace

Links links_in(const std::vector<fs::path>& places) {
  Links links;
  std::error_code error;
  const auto add = [&](const fs::path& path) {
    std::error_code none;
    if (!fs::is_symlink(path, none)) return;
    if (auto target = fs::canonical(path, none); !none) links.emplace(path, std::move(target));
  };
  for (const fs::path& place : places) {
    add(place.has_filename() ? place : place.parent_path());
    if (!fs::is_directory(place, error)) continue;
    for (auto it = fs::recursive_directory_iterator(place, fs::directory_options::skip_permission_denied, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error))
      add(it->path());
  }
  return links;
}

bool lies_in(const fs::path& path, const std::vector<fs::path>& places) {
  return std::ranges::any_of(places, [&](const fs::path& place) {
    std::error_code error;
    const fs::path whole = fs::canonical(place, error);
    return !error && std::ranges::mismatch(whole, path).in1 == whole.end();
  });
}

fs::path holder_of(const fs::path& session) {
  std::error_code error;
  auto file = fs::canonical(session, error);
  return error || file == fs::absolute(session).lexically_normal() ? session : file;
}

LeftOver delete_drives(const std::vector<fs::path>& sessions) {
  const auto hidden = [](const fs::path& session) { return fs::path(session.string() + ".forgotten"); };
  LeftOver result;
  std::error_code error;
  for (const fs::path& session : sessions) {
    if (auto ended = logging::check_has_ended(session); !ended) {
      result.why.push_back(std::move(ended.error()));
      continue;
    }
    fs::rename(session, hidden(session), error);
    if (error)
      result.why.push_back({error.message(), session.string(), "make its folder one that can be written"});
    else
      result.done.push_back(session);
  }
  for (const fs::path& session : result.done) {
    fs::remove(hidden(session), error);
    for (const char* beside : {"-wal", "-shm", "-journal"}) fs::remove(session.string() + beside, error);
    for (Error& left : remove_results(session.parent_path())) result.why.push_back(std::move(left));
  }
  return result;
}

std::vector<Error> remove_links_to_nothing(const Links& links) {
  std::vector<Error> left;
  std::error_code error;
  for (const auto& [link, target] : links) {
    if (fs::exists(target, error) || !fs::is_symlink(link, error) || !fs::remove(link, error)) continue;
    program::announce(fmt::format("{}: removed, for it was a link to what was deleted", link.string()));
    if (link.filename() == "session.sqlite")
      for (Error& result : remove_results(link.parent_path())) left.push_back(std::move(result));
  }
  return left;
}

}  // namespace septet::server
