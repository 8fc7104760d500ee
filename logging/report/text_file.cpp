#include "logging/report/text_file.hpp"

#include <fstream>
#include <system_error>

namespace septet::logging {

Expected<void> write_text_file(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::path draft = path;
  draft += ".part";
  std::error_code error;
  {
    std::ofstream out(draft, std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (!out) {
      std::filesystem::remove(draft, error);
      return failure("the file cannot be written", path.string(),
                     "check the folder, its permissions and the free space");
    }
  }
  std::filesystem::rename(draft, path, error);
  if (error) return failure(error.message(), path.string(), "check the folder and its permissions");
  return {};
}

}  // namespace septet::logging
