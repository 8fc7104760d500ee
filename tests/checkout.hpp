#pragma once
/// Folders of this checkout, queried at run time: a test's text, and so its entry in a compiler's cache, is the same in
/// every checkout.

#include <string>

namespace septet {

/// Root of the source tree, absolute, without a slash at its end.
std::string source_folder();

/// Folder of this build, absolute, without a slash at its end.
std::string build_folder();

}  // namespace septet
