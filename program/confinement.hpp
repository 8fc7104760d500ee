#pragma once
/// A second wall around a program that reads files of others: should one of them make it do what it is not meant to, the kernel lets it
/// write, make and remove nothing but what it is there for.

#include <filesystem>
#include <vector>

namespace septet::program {

/// From here on this process (with the threads and children that it starts) may write, make and remove files below `places` and in the
/// temporary folder alone; reading stays as it was, and so do devices and what is open. A place that is not there yet stands for the nearest
/// folder above it. Cannot be undone. Call it before any thread starts.
/// Linux's Landlock (kernel 5.13 or newer, landlock(7)); returns false where that is missing, and nothing changes.
bool write_only_below(const std::vector<std::filesystem::path>& places);

}  // namespace septet::program
