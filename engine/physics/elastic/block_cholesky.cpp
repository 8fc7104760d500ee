#include "engine/physics/elastic/block_cholesky.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace septet::elastic {

std::vector<int> fill_reducing_order(int node_count, std::span<const std::pair<int, int>> edges) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * edges.size() + static_cast<std::size_t>(node_count));
  for (int i = 0; i < node_count; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [a, b] : edges) {
    entries.emplace_back(a, b, 1.0);
    entries.emplace_back(b, a, 1.0);
  }
  Eigen::SparseMatrix<double> graph(node_count, node_count);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  return {order.indices().data(), order.indices().data() + node_count};
}

BlockPattern block_pattern(int node_count, std::span<const std::pair<int, int>> edges) {
  std::vector<std::pair<int, int>> lower;
  lower.reserve(edges.size());
  for (const auto& [a, b] : edges)
    if (a != b) lower.emplace_back(std::max(a, b), std::min(a, b));
  std::ranges::sort(lower);
  lower.erase(std::unique(lower.begin(), lower.end()), lower.end());
  BlockPattern pattern;
  pattern.node_count = node_count;
  pattern.row_start.assign(static_cast<std::size_t>(node_count) + 1, 0);
  for (const auto& [row, column] : lower) {
    ++pattern.row_start[row + 1];
    pattern.column.push_back(column);
  }
  for (int i = 0; i < node_count; ++i) pattern.row_start[i + 1] += pattern.row_start[i];
  return pattern;
}

FactorPattern factor_pattern(const BlockPattern& pattern) {
  // Row k of the factor is the union of the elimination tree's paths from row k's columns to k.
  const int n = pattern.node_count;
  std::vector<int> parent(n, -1), mark(n, -1), column_count(n, 0);
  FactorPattern result;
  result.row_start.assign(static_cast<std::size_t>(n) + 1, 0);
  for (int k = 0; k < n; ++k) {
    mark[k] = k;
    const auto begin = result.row_column.size();
    for (int s = pattern.row_start[k]; s < pattern.row_start[k + 1]; ++s)
      for (int j = pattern.column[s]; mark[j] != k; j = parent[j]) {
        if (parent[j] == -1) parent[j] = k;
        mark[j] = k;
        result.row_column.push_back(j);
        ++column_count[j];
      }
    std::sort(result.row_column.begin() + static_cast<std::ptrdiff_t>(begin), result.row_column.end());
    result.row_start[k + 1] = static_cast<int>(result.row_column.size());
  }
  result.column_start.assign(static_cast<std::size_t>(n) + 1, 0);
  for (int j = 0; j < n; ++j) result.column_start[j + 1] = result.column_start[j] + column_count[j];
  result.row.resize(result.row_column.size());
  result.place.resize(result.row_column.size());
  std::vector<int> next(result.column_start.begin(), result.column_start.end() - 1);
  for (int k = 0; k < n; ++k)
    for (int s = result.row_start[k]; s < result.row_start[k + 1]; ++s) {
      const int place = next[result.row_column[s]]++;
      result.row[place] = k;
      result.place[s] = place;
    }
  return result;
}

namespace {

/// Inverse of the lower Cholesky factor of a symmetric 3×3 block; false if it is not definite.
bool invert_cholesky(const Block& a, Block& inverse) {
  const double a00 = a.column[0][0];
  if (!(a00 > 0)) return false;
  const double l00 = std::sqrt(a00), l10 = a.column[0][1] / l00, l20 = a.column[0][2] / l00;
  const double d1 = a.column[1][1] - l10 * l10;
  if (!(d1 > 0)) return false;
  const double l11 = std::sqrt(d1), l21 = (a.column[1][2] - l20 * l10) / l11;
  const double d2 = a.column[2][2] - l20 * l20 - l21 * l21;
  if (!(d2 > 0)) return false;
  const double i00 = 1 / l00, i11 = 1 / l11, i22 = 1 / std::sqrt(d2);
  const double i10 = -l10 * i00 * i11, i21 = -l21 * i11 * i22;
  inverse.column[0] = Eigen::Array4d(i00, i10, -(l20 * i00 + l21 * i10) * i22, 0);
  inverse.column[1] = Eigen::Array4d(0, i11, i21, 0);
  inverse.column[2] = Eigen::Array4d(0, 0, i22, 0);
  return true;
}

/// y −= a · bᵀ.
inline void subtract_outer(Block& y, const Block& a, const Block& b) {
  for (int c = 0; c < 3; ++c)
    y.column[c] -= a.column[0] * b.column[0][c] + a.column[1] * b.column[1][c] + a.column[2] * b.column[2][c];
}

}  // namespace

bool factorise(const BlockPattern& pattern, const FactorPattern& structure, const BlockMatrix& matrix,
               BlockFactor<double>& factor) {
  const int n = pattern.node_count;
  factor.inverse_diagonal.resize(static_cast<std::size_t>(n));
  factor.lower.resize(structure.row.size());
  std::vector<Block> row(static_cast<std::size_t>(n), zero_block());  // Row k, scattered.
  for (int k = 0; k < n; ++k) {
    for (int s = pattern.row_start[k]; s < pattern.row_start[k + 1]; ++s) row[pattern.column[s]] = matrix.lower[s];
    Block diagonal = matrix.diagonal[k];
    for (int s = structure.row_start[k]; s < structure.row_start[k + 1]; ++s) {
      const int j = structure.row_column[s], place = structure.place[s];
      // L_kj = Y_j · L_jj⁻ᵀ, whose column c is Σ Y_j.column[m] · (L_jj⁻¹)_cm.
      const Block y = row[j];
      row[j] = zero_block();
      const Block& inverse = factor.inverse_diagonal[j];
      Block l;
      l.column[0] = y.column[0] * inverse.column[0][0];
      l.column[1] = y.column[0] * inverse.column[0][1] + y.column[1] * inverse.column[1][1];
      l.column[2] =
          y.column[0] * inverse.column[0][2] + y.column[1] * inverse.column[1][2] + y.column[2] * inverse.column[2][2];
      for (int p = structure.column_start[j]; p < place; ++p) subtract_outer(row[structure.row[p]], l, factor.lower[p]);
      subtract_outer(diagonal, l, l);
      factor.lower[place] = l;
    }
    if (!invert_cholesky(diagonal, factor.inverse_diagonal[k])) return false;
  }
  return true;
}

template <class Scalar>
void solve(const FactorPattern& structure, const BlockFactor<Scalar>& factor,
           std::vector<Eigen::Array<Scalar, 4, 1>>& vector) {
  using Array4 = Eigen::Array<Scalar, 4, 1>;
  const int n = static_cast<int>(vector.size());
  for (int j = 0; j < n; ++j) {
    const auto& d = factor.inverse_diagonal[j];
    const Array4 b = vector[j];
    const Array4 x = d.column[0] * b[0] + d.column[1] * b[1] + d.column[2] * b[2];
    vector[j] = x;
    for (int p = structure.column_start[j]; p < structure.column_start[j + 1]; ++p) {
      const auto& l = factor.lower[p];
      vector[structure.row[p]] -= l.column[0] * x[0] + l.column[1] * x[1] + l.column[2] * x[2];
    }
  }
  for (int j = n - 1; j >= 0; --j) {
    // Column sums stay in registers over the whole column and are added up once at its end.
    Array4 s0 = Array4::Zero(), s1 = Array4::Zero(), s2 = Array4::Zero();
    for (int p = structure.column_start[j]; p < structure.column_start[j + 1]; ++p) {
      const auto& l = factor.lower[p];
      const Array4& x = vector[structure.row[p]];
      s0 += l.column[0] * x;
      s1 += l.column[1] * x;
      s2 += l.column[2] * x;
    }
    const Array4 b = vector[j] - Array4(s0.sum(), s1.sum(), s2.sum(), Scalar(0));
    const auto& d = factor.inverse_diagonal[j];
    vector[j] = Array4((d.column[0] * b).sum(), (d.column[1] * b).sum(), (d.column[2] * b).sum(), Scalar(0));
  }
}

template void solve(const FactorPattern&, const BlockFactor<double>&, std::vector<Eigen::Array<double, 4, 1>>&);
template void solve(const FactorPattern&, const BlockFactor<float>&, std::vector<Eigen::Array<float, 4, 1>>&);

BlockFactor<float> to_single(const BlockFactor<double>& factor) {
  BlockFactor<float> result;
  const auto convert = [](const Block& b) {
    return PaddedBlock<float>{{b.column[0].cast<float>(), b.column[1].cast<float>(), b.column[2].cast<float>()}};
  };
  for (const Block& b : factor.inverse_diagonal) result.inverse_diagonal.push_back(convert(b));
  result.lower.reserve(factor.lower.size());
  for (const Block& b : factor.lower) result.lower.push_back(convert(b));
  return result;
}

}  // namespace septet::elastic
