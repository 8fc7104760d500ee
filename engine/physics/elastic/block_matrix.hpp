#pragma once
/// Symmetric sparse matrices of 3×3 blocks, one block row per node: the systems that the stepper assembles and solves.
///
/// A column of a block is padded to four numbers, and so is every vector's node, so that one column is one AVX
/// register; the padding stays zero. Only the diagonal and the strictly lower blocks are stored, by rows, columns
/// ascending.

#include <array>
#include <vector>

#include <Eigen/Core>

namespace septet::elastic {

template <class Scalar>
struct PaddedBlock {
  std::array<Eigen::Array<Scalar, 4, 1>, 3> column;
};
using Block = PaddedBlock<double>;
/// One vector of three numbers and a zero per node.
using BlockVector = std::vector<Eigen::Array4d>;

inline Block zero_block() { return {{Eigen::Array4d::Zero(), Eigen::Array4d::Zero(), Eigen::Array4d::Zero()}}; }
inline Eigen::Array4d padded(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z(), 0.0}; }

/// Positions of the strictly lower blocks.
struct BlockPattern {
  int node_count = 0;
  std::vector<int> row_start;  ///< node_count + 1 entries.
  std::vector<int> column;     ///< Column of each block; ascending within a row.

  /// Index of the block (row, column), which must exist.
  int slot(int row, int col) const;
};

struct BlockMatrix {
  std::vector<Block> diagonal;
  std::vector<Block> lower;  ///< In the order of the pattern.

  void set_zero(const BlockPattern& pattern);
};

/// result = matrix · vector.
void multiply(const BlockPattern& pattern, const BlockMatrix& matrix, const BlockVector& vector, BlockVector& result);

}  // namespace septet::elastic
