#include "engine/physics/elastic/block_matrix.hpp"

#include <algorithm>

#include "engine/core/check.hpp"

namespace septet::elastic {

int BlockPattern::slot(int row, int col) const {
  const auto first = column.begin() + row_start[row], last = column.begin() + row_start[row + 1];
  const auto place = std::lower_bound(first, last, col);
  SEPTET_CHECK(place != last && *place == col, "block {} {}", row, col);
  return static_cast<int>(place - column.begin());
}

void BlockMatrix::set_zero(const BlockPattern& pattern) {
  diagonal.assign(static_cast<std::size_t>(pattern.node_count), zero_block());
  lower.assign(pattern.column.size(), zero_block());
}

void multiply(const BlockPattern& pattern, const BlockMatrix& matrix, const BlockVector& vector, BlockVector& result) {
  result.resize(vector.size());
  for (int i = 0; i < pattern.node_count; ++i) {
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): stays in a register while `result` is written.
    const Eigen::Array4d x = vector[i];
    const Block& d = matrix.diagonal[i];
    Eigen::Array4d sum = d.column[0] * x[0] + d.column[1] * x[1] + d.column[2] * x[2];
    for (int s = pattern.row_start[i]; s < pattern.row_start[i + 1]; ++s) {
      const int j = pattern.column[s];
      const Block& a = matrix.lower[s];
      const Eigen::Array4d& other = vector[j];
      sum += a.column[0] * other[0] + a.column[1] * other[1] + a.column[2] * other[2];
      Eigen::Array4d& back = result[j];
      const Eigen::Array4d p0 = a.column[0] * x, p1 = a.column[1] * x, p2 = a.column[2] * x;
      back[0] += p0[0] + p0[1] + p0[2];
      back[1] += p1[0] + p1[1] + p1[2];
      back[2] += p2[0] + p2[1] + p2[2];
    }
    result[i] = sum;
  }
}

}  // namespace septet::elastic
