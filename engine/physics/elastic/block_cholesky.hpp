#pragma once
/// Cholesky factorisation of a BlockMatrix, with the structure found once and reused every step.
///
/// The rows are expected in a fill-reducing order (Eigen's AMD, see `fill_reducing_order`). The numeric part is the
/// up-looking method (Davis 2006, Direct Methods for Sparse Linear Systems, ch. 4) over 3×3 blocks: one index per nine
/// numbers and a register per column, its advantage over Eigen's scalar SimplicialLLT.

#include <span>
#include <utility>
#include <vector>

#include "engine/physics/elastic/block_matrix.hpp"

namespace septet::elastic {

/// Order of elimination with little fill: entry k is the node that comes k-th.
std::vector<int> fill_reducing_order(int node_count, std::span<const std::pair<int, int>> edges);

/// Pattern of a matrix whose node pairs (either order, repeats allowed) are coupled.
BlockPattern block_pattern(int node_count, std::span<const std::pair<int, int>> edges);

/// Positions of the factor's blocks: by columns for the solve, and by rows for the factorisation.
struct FactorPattern {
  std::vector<int> column_start, row;             ///< Strictly lower blocks by column.
  std::vector<int> row_start, row_column, place;  ///< Row k: its columns, and their positions above.
};
FactorPattern factor_pattern(const BlockPattern& pattern);

/// L of A = L·Lᵀ. The diagonal blocks are kept inverted.
template <class Scalar>
struct BlockFactor {
  std::vector<PaddedBlock<Scalar>> inverse_diagonal;
  std::vector<PaddedBlock<Scalar>> lower;  ///< In FactorPattern's column order.
};

/// Returns false where the matrix is not positive definite (then the factor is unusable).
bool factorise(const BlockPattern& pattern, const FactorPattern& structure, const BlockMatrix& matrix,
               BlockFactor<double>& factor);

/// Overwrites the right-hand side with the solution.
template <class Scalar>
void solve(const FactorPattern& structure, const BlockFactor<Scalar>& factor,
           std::vector<Eigen::Array<Scalar, 4, 1>>& vector);

/// The same factor in single precision: half the memory to stream, good enough to precondition.
BlockFactor<float> to_single(const BlockFactor<double>& factor);

}  // namespace septet::elastic
