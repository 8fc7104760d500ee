#pragma once
/// Checks that a request comes from the page itself: pure functions of its header. See web_server.hpp.

#include <span>
#include <string>
#include <string_view>

namespace septet::page {

/// True for a Host header of this machine (localhost, 127.0.0.1, [::1]) or of `allowed`, as a whole, on any port.
bool is_allowed_host(std::string_view host, std::span<const std::string> allowed);
/// True for an Origin header that names the same scheme-less host and port as the Host header.
bool is_own_origin(std::string_view origin, std::string_view host);
/// True if one of the comma-separated subprotocols is the token; in constant time, so that timing reveals nothing.
bool holds_token(std::string_view protocols, std::string_view token);

/// 128 random bits of the system, as 32 hexadecimal digits.
std::string random_token();

}  // namespace septet::page
