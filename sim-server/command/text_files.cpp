#include "sim-server/command/text_files.hpp"

#include <fstream>

namespace septet::server {

namespace fs = std::filesystem;

Expected<void> write_text_files(const fs::path& folder,
                                const std::vector<std::pair<std::string, std::string>>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(error.message(), folder.string(), "choose another --out folder");
  for (const auto& [name, text] : files) {
    std::ofstream file(folder / name, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (!file)
      return failure("cannot be written", (folder / name).string(), "choose another --out folder");
  }
  return {};
}

}  // namespace septet::server
