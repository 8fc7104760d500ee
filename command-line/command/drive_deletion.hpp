#pragma once
/// Deletion of drives, and of the symbolic links that led to them.
///
/// Nothing is deleted outside the places that a person has named: links there are not followed, and what lies behind
/// them is told.

#include <filesystem>
#include <map>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// Symbolic links, each with what it leads to (canonical).
using Links = std::map<std::filesystem::path, std::filesystem::path>;

/// Links among the places and anywhere below them. Links that lead nowhere are left out.
Links links_in(const std::vector<std::filesystem::path>& places);

/// True for one of the places themselves and for anything below one. `path` is canonical.
bool lies_in(const std::filesystem::path& path, const std::vector<std::filesystem::path>& places);

/// The file with a session's data: another one if the session, or a folder above it, is a link.
std::filesystem::path holder_of(const std::filesystem::path& session);

/// Sessions that could not be processed, and the reasons.
struct LeftOver {
  std::vector<std::filesystem::path> done;
  std::vector<Error> why;
};

/// Deletes sessions with all that lies beside them, and their folders if nothing else is left in them. First all are
/// moved out of sight, then deleted: after a kill in between, a visible session is whole. Of a picture folder or a
/// report that is a link the link goes; what it led to stays and is named in `why`.
LeftOver delete_drives(const std::vector<std::filesystem::path>& sessions);

/// Removes the links whose data have gone since links_in, with the results beside a session's link, and says so. Returns
/// what stays, as `why` of delete_drives.
std::vector<Error> remove_links_to_nothing(const Links& links);

}  // namespace septet::server
