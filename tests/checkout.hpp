#pragma once
/// Folders of this checkout, asked for at run time: a test's text, and so what a compiler's cache keeps of it, is the same in every checkout.

#include <string>

namespace septet {

/// Root of the source tree, absolute, without a slash at its end.
std::string source_folder();

/// Folder of this build, absolute, without a slash at its end.
std::string build_folder();

}  // namespace septet
