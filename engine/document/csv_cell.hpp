#pragma once
/// A text as a cell of a CSV file.

#include <string>

namespace septet::document {

/// As in RFC 4180. A cell that a spreadsheet would take for a formula is made a text by an apostrophe before it; so is
/// one that begins with an apostrophe, so that removing the first one gives every text back.
std::string csv_cell(const std::string& text);

}  // namespace septet::document
