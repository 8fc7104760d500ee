#pragma once
/// The outcomes of variants as a table, a plot and a sentence.

#include <span>
#include <string>

#include "sim-server/drive/what_if/variant.hpp"

namespace septet::server {

/// A variant and what it came to.
struct RanVariant {
  std::string changes;          ///< As text.
  std::optional<double> value;  ///< Of the change of a range.
  VariantOutcome outcome;
};

/// CSV: the logged course, then a row a variant. Units are in the columns' names.
std::string variants_csv(const WhatIf& what_if, std::span<const RanVariant> variants);

/// How many collide: "37 of 100 variants collide (37.0 %)".
std::string share_sentence(std::span<const RanVariant> variants);

/// The same of a range, and from which value on none does, where there is such a value.
std::string range_sentence(std::span<const RanVariant> variants);

/// Closing speed of those that collide and least gap of the others over the changed value, as SVG.
std::string range_plot(const WhatIf& what_if, const ChangeRange& range, std::span<const RanVariant> variants);

}  // namespace septet::server
