#include "logging/study/report/page_link.hpp"

#include <string_view>
#include <system_error>

#include <fmt/core.h>

namespace septet::logging {
namespace {

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  const auto absolute = std::filesystem::absolute(path.empty() ? "." : path, error);
  const auto canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

}  // namespace

std::string page_link(const std::filesystem::path& file, const std::filesystem::path& page_folder) {
  constexpr std::string_view kept = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string link;
  for (const char c : resolved(file).lexically_relative(resolved(page_folder)).generic_string())
    link += kept.find(c) != kept.npos ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return link;
}

}  // namespace septet::logging
