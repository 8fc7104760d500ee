#pragma once
/// Confinement of a program that reads untrusted files: should one of them take the program over, the kernel still
/// restricts its writes to the intended places.

#include <filesystem>
#include <vector>

namespace septet::program {

/// From here on this process (with the threads and children that it starts) may write, create and remove files below
/// `places` and in the temporary folder alone; reading stays unrestricted, and so do devices and open files. A place
/// that does not exist yet stands for the nearest folder above it. Cannot be undone. Call it before any thread starts.
/// Linux's Landlock (kernel 5.13 or newer, landlock(7)); returns false where that is missing, and changes nothing.
bool write_only_below(const std::vector<std::filesystem::path>& places);

}  // namespace septet::program
