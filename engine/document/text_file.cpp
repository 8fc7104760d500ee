#include "engine/document/text_file.hpp"

#include <fstream>
#include <system_error>

namespace septet::document {

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

Expected<void> write_text_files(const std::filesystem::path& folder,
                                const std::vector<std::pair<std::string, std::string>>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return failure(error.message(), folder.string(), "choose a folder that can be written");
  for (const auto& [name, text] : files)
    if (auto written = write_text_file(folder / name, text); !written) return written;
  return {};
}

}  // namespace septet::document
