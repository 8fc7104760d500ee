#include "engine/document/text_file.hpp"

#include <fstream>
#include <system_error>

#include "engine/core/whole_file.hpp"

namespace septet::document {

Expected<void> write_text_file(const std::filesystem::path& path, std::string_view text) {
  return write_whole_file(path, [&](const std::filesystem::path& part) -> Expected<void> {
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (out) return {};
    return failure("the file cannot be written", path.string(), "check the folder, its permissions and the free space");
  });
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
