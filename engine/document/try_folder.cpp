#include "engine/document/try_folder.hpp"

#include <system_error>
#include <vector>

namespace septet::document {
namespace fs = std::filesystem;

Expected<void> try_folder(const fs::path& folder) {
  std::error_code error, ignored;
  const fs::path whole = fs::absolute(folder, error);
  std::vector<fs::path> made;
  for (fs::path missing = whole; !error && !fs::exists(missing, ignored) && missing.has_relative_path();
       missing = missing.parent_path())
    made.push_back(missing);
  if (!error) fs::create_directories(whole, error);
  if (!error) {
    // A folder within it: no file of that name is touched.
    const fs::path within = whole / ".septet-writes-here";
    fs::create_directory(within, error);
    fs::remove(within, ignored);
  }
  for (const fs::path& one : made) fs::remove(one, ignored);
  if (error) return failure(error.message(), folder.string(), "choose a folder that can be written");
  return {};
}

}  // namespace septet::document
