#pragma once
/// Errors of the outside world (a file, a packet, a device, an option) travel as values.
///
/// A function that can fail because of its input returns `Expected<T>`. The error says what is wrong, where, and what
/// to do about it; its handler reports it exactly once. Bugs do not travel this way: see check.hpp.

#include <string>
#include <tl/expected.hpp>

namespace septet {

/// One failure in the outside world, ready to be shown to a person.
struct Error {
  std::string what;    ///< Fault: "lane width is negative (-0.2 m)".
  std::string where;   ///< Place: "motorway.xodr:120, <width>", "udp 239.7.7.7:4750", "--seed".
  std::string remedy;  ///< Remedy: "give a width of at least 0 m".
};

template <class T>
using Expected = tl::expected<T, Error>;

/// Shorthand for `return tl::unexpected(Error{…})`.
inline tl::unexpected<Error> failure(std::string what, std::string where, std::string remedy) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(where), std::move(remedy)});
}

/// The one-message form, "where: what. remedy."; the same on every console, log and page.
std::string describe(const Error& error);

}  // namespace septet
