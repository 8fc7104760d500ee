#pragma once
/// Errors of the outside world (a file, a packet, a device, an option) travel as values.
///
/// A function that can fail because of what it was given returns `Expected<T>`. The error says what is wrong, where, and
/// what to do about it; whoever handles it reports it exactly once. Bugs do not travel this way: see check.hpp.

#include <string>
#include <tl/expected.hpp>

namespace septet {

/// One failure in the outside world, ready to be shown to a person.
struct Error {
  std::string what;    ///< What is wrong: "lane width is negative (-0.2 m)".
  std::string where;   ///< Where: "motorway.xodr:120, <width>", "udp 239.7.7.7:4750", "--seed".
  std::string remedy;  ///< What to do: "give a width of at least 0 m".
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
