#pragma once
/// Numbers that no car, road or clock gives: a session that somebody altered, or whose disk lied, may hold them. No figure is made of
/// them, and what was left out is told.
///
/// The bounds are far beyond everything that drives (a thousand metres a second, ten thousand m/s²), so that no crash is taken for one.
/// A number that is missing (NaN) is none of them.

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "logging/records.hpp"

namespace septet::logging {

struct ImpossibleNumbers {
  std::size_t samples = 0, inputs = 0, answers = 0;  ///< Rows that were left out, and answers without their number.
  std::string first;                                 ///< "speed_mps is 1e+300 at tick 12"; empty without any.
  bool any() const { return samples + inputs + answers > 0; }
};

/// Takes such rows away. `samples` and `inputs` keep their order.
ImpossibleNumbers leave_out_impossible(std::vector<Sample>& samples, std::vector<InputRecord>& inputs);
/// The answer stays, without its number; a time until which somebody was observed becomes 0.
void leave_out_impossible(std::vector<QuestionnaireRecord>& answers, ImpossibleNumbers& found);

/// What was left out, as a sentence for whoever uses the figures; empty where it is nothing.
std::string told(const ImpossibleNumbers& found);

/// Whether a figure that was computed can be one.
inline bool can_be_told(double value) { return std::abs(value) < 1e12; }

}  // namespace septet::logging
