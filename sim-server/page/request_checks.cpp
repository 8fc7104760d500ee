#include "sim-server/page/request_checks.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>
#include <sys/random.h>

#include "engine/core/check.hpp"

namespace septet::page {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_same_text(std::string_view a, std::string_view b) { return std::ranges::equal(a, b, {}, lower, lower); }

bool is_same_secret(std::string_view a, std::string_view b) {
  unsigned differ = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    differ |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b.empty() ? 0 : b[i % b.size()]);
  return differ == 0;
}

}  // namespace

bool is_allowed_host(std::string_view host, std::span<const std::string> allowed) {
  const auto name_end = host.starts_with('[') ? host.find(']') : host.find(':');
  std::string_view name = host.substr(0, name_end);
  std::string_view port;
  if (name_end != std::string_view::npos) {
    if (host.starts_with('[')) name = host.substr(0, name_end + 1);
    port = host.substr(name.size());
  }
  if (!port.empty()) {
    port.remove_prefix(1);
    if (host[name.size()] != ':' || port.empty() || port.size() > 5 ||
        !std::ranges::all_of(port, [](char c) { return c >= '0' && c <= '9'; }))
      return false;
  }
  constexpr std::array own{std::string_view("localhost"), std::string_view("127.0.0.1"), std::string_view("[::1]")};
  const auto is_name = [&](std::string_view other) { return !other.empty() && is_same_text(name, other); };
  return std::ranges::any_of(own, is_name) || std::ranges::any_of(allowed, is_name);
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  for (const std::string_view scheme : {"http://", "https://"})
    if (origin.starts_with(scheme)) return is_same_text(origin.substr(scheme.size()), host);
  return false;
}

bool holds_token(std::string_view protocols, std::string_view token) {
  if (token.empty()) return false;
  bool holds = false;
  while (!protocols.empty()) {
    auto one = protocols.substr(0, protocols.find(','));
    protocols.remove_prefix(std::min(one.size() + 1, protocols.size()));
    while (one.starts_with(' ')) one.remove_prefix(1);
    while (one.ends_with(' ')) one.remove_suffix(1);
    holds = is_same_secret(one, token) || holds;
  }
  return holds;
}

std::string random_token() {
  std::array<std::uint8_t, 16> bytes{};
  const auto got = ::getrandom(bytes.data(), bytes.size(), 0);
  SEPTET_CHECK(got == static_cast<ssize_t>(bytes.size()), "getrandom gave {} bytes", got);
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

}  // namespace septet::page
