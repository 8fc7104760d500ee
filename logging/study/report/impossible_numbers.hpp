#pragma once
/// Impossible numbers, which no car, road or clock gives: an altered session, or a faulty disk, may hold them. They
/// enter no figure, and their omission is reported.
///
/// The bounds are far beyond all driving (a thousand metres a second, ten thousand m/s²), so that no crash is mistaken
/// for one. A missing number (NaN) is not impossible.

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

struct ImpossibleNumbers {
  std::size_t samples = 0, inputs = 0, answers = 0;  ///< Rows left out, and answers without their number.
  std::string first;                                 ///< "speed_mps is 1e+300 at tick 12"; empty without any.
  bool any() const { return samples + inputs + answers > 0; }
};

/// Removes such rows. `samples` and `inputs` keep their order.
ImpossibleNumbers leave_out_impossible(std::vector<Sample>& samples, std::vector<InputRecord>& inputs);
/// The answer stays, without its number; an impossible observation time becomes 0.
void leave_out_impossible(std::vector<QuestionnaireRecord>& answers, ImpossibleNumbers& found);

/// The omission as a sentence for users of the figures; empty if nothing was left out.
std::string told(const ImpossibleNumbers& found);

/// True if a computed figure is possible.
inline bool can_be_told(double value) { return std::abs(value) < 1e12; }

}  // namespace septet::logging
