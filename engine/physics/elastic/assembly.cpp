#include "engine/physics/elastic/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/shell_assembly.hpp"

namespace septet::elastic {
namespace {

/// Δt² σ₁ |g|² / ρ from which an element gets its geometric stiffness; 4 would be unstable.
constexpr double tension_limit = 1.0;

/// One number of each of four elements: four elements are worked on in the lanes of one register.
constexpr int lanes = 4;
using Lanes = Eigen::Array4d;
struct LaneVector {
  Lanes x, y, z;
  const Lanes& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  Lanes& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
};
/// Stored by columns.
struct LaneMatrix {
  std::array<LaneVector, 3> column;
  const Lanes& operator()(int row, int col) const { return column[col][row]; }
  Lanes& operator()(int row, int col) { return column[col][row]; }
};

inline LaneVector times(const LaneMatrix& m, const LaneVector& v) {
  LaneVector r;
  for (int i = 0; i < 3; ++i) r[i] = m(i, 0) * v.x + m(i, 1) * v.y + m(i, 2) * v.z;
  return r;
}
inline LaneMatrix times(const LaneMatrix& a, const LaneMatrix& b) {
  return {{times(a, b.column[0]), times(a, b.column[1]), times(a, b.column[2])}};
}
inline Lanes dot(const LaneVector& a, const LaneVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline LaneVector minus_sum(const LaneVector& a, const LaneVector& b, const LaneVector& c) {
  return {-(a.x + b.x + c.x), -(a.y + b.y + c.y), -(a.z + b.z + c.z)};
}
/// Aᵀ·A; with rows for columns A·Aᵀ.
inline LaneMatrix gram(const LaneMatrix& a) {
  LaneMatrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) r(i, j) = r(j, i) = dot(a.column[i], a.column[j]);
  return r;
}
inline LaneMatrix transposed(const LaneMatrix& a) {
  LaneMatrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = a(j, i);
  return r;
}
inline Lanes squared_norm(const LaneMatrix& a) {
  return dot(a.column[0], a.column[0]) + dot(a.column[1], a.column[1]) + dot(a.column[2], a.column[2]);
}

/// The vector of each of the four elements, padded with a zero.
inline std::array<Lanes, lanes> by_element(const LaneVector& v) {
  Eigen::Array<double, 4, 4> t;
  t.col(0) = v.x;
  t.col(1) = v.y;
  t.col(2) = v.z;
  t.col(3).setZero();
  t.transposeInPlace();
  return {t.col(0), t.col(1), t.col(2), t.col(3)};
}

/// Four elements side by side. The last batch repeats its last element with no volume.
struct Batch {
  std::array<const Element*, lanes> element;
  int count;
  LaneMatrix rest_inverse;
  Lanes volume;
};

Batch load(const std::vector<Element>& elements, std::size_t first) {
  Batch b;
  b.count = static_cast<int>(std::min<std::size_t>(lanes, elements.size() - first));
  for (int k = 0; k < lanes; ++k) b.element[k] = &elements[first + static_cast<std::size_t>(std::min(k, b.count - 1))];
  for (int c = 0; c < 9; ++c)
    for (int k = 0; k < lanes; ++k) b.rest_inverse(c % 3, c / 3)[k] = b.element[k]->rest_inverse.data()[c];
  for (int k = 0; k < lanes; ++k) b.volume[k] = k < b.count ? b.element[k]->rest_volume_m3 : 0.0;
  return b;
}

/// Edges from the first node to the three others, of places or of velocities.
LaneMatrix edges(const Batch& b, const std::vector<Eigen::Vector3d>& of) {
  LaneMatrix d;
  for (int k = 0; k < lanes; ++k) {
    const auto& nodes = b.element[k]->nodes;
    const double* origin = of[nodes[0]].data();
    for (int a = 0; a < 3; ++a) {
      const double* x = of[nodes[a + 1]].data();
      for (int c = 0; c < 3; ++c) d(c, a)[k] = x[c] - origin[c];
    }
  }
  return d;
}

inline void add(Block& block, const std::array<std::array<Lanes, lanes>, 3>& columns, int k) {
  for (int c = 0; c < 3; ++c) block.column[c] += columns[c][k];
}

/// A bound of the tensile part of a symmetric stress: ½ (S + |S|), with |S| from above by the polynomial 0.135 + 1.93
/// x² − 1.065 x⁴ of S over its norm; at most 0.135 of the norm too large.
LaneMatrix tensile_bound(const LaneMatrix& stress, const Lanes& norm) {
  const Lanes scale = 1.0 / norm.max(1e-300);
  LaneMatrix s;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) s(r, c) = stress(r, c) * scale;
  const LaneMatrix square = gram(s), fourth = gram(square);
  LaneMatrix result;
  for (int c = 0; c < 3; ++c)
    for (int r = c; r < 3; ++r) {
      Lanes value = s(r, c) + 1.93 * square(r, c) - 1.065 * fourth(r, c);
      if (r == c) value += 0.135;
      result(r, c) = result(c, r) = 0.5 * norm * value;
    }
  return result;
}

/// Shape gradients of the four nodes.
std::array<LaneVector, 4> gradients(const LaneMatrix& rest_inverse) {
  std::array<LaneVector, 4> g;
  for (int a = 0; a < 3; ++a) g[a + 1] = {rest_inverse(a, 0), rest_inverse(a, 1), rest_inverse(a, 2)};
  g[0] = minus_sum(g[1], g[2], g[3]);
  return g;
}

/// Adds V·scale·(λ h_a h_bᵀ + μ h_b h_aᵀ + μ (g_a·g_b) F Fᵀ + (g_aᵀ T g_b) I) for all node pairs.
void add_stiffness_blocks(const Batch& b, const LaneMatrix& f, const LaneMatrix* tension, const LameConstants& lame,
                          double scale, BlockMatrix& matrix) {
  const auto g = gradients(b.rest_inverse);
  const Lanes volume = scale * b.volume, lambda = lame.lambda_pa * volume, mu = lame.mu_pa * volume;
  const LaneMatrix fft = gram(transposed(f));
  std::array<LaneVector, 4> h, lambda_h, mu_h, pull_g;
  for (int a = 1; a < 4; ++a) h[a] = times(f, g[a]);
  h[0] = minus_sum(h[1], h[2], h[3]);
  for (int a = 0; a < 4; ++a)
    for (int c = 0; c < 3; ++c) {
      lambda_h[a][c] = lambda * h[a][c];
      mu_h[a][c] = mu * h[a][c];
    }
  if (tension)
    for (int a = 0; a < 4; ++a) pull_g[a] = times(*tension, g[a]);
  const auto block = [&](int p, int q) {
    const Lanes shear = mu * dot(g[p], g[q]);
    std::array<std::array<Lanes, lanes>, 3> columns;
    for (int c = 0; c < 3; ++c) {
      LaneVector v;
      for (int r = 0; r < 3; ++r) v[r] = lambda_h[p][r] * h[q][c] + mu_h[q][r] * h[p][c] + shear * fft(r, c);
      if (tension) v[c] += volume * dot(g[p], pull_g[q]);
      columns[c] = by_element(v);
    }
    return columns;
  };
  for (int a = 0; a < 4; ++a) {
    const auto columns = block(a, a);
    for (int k = 0; k < b.count; ++k) add(matrix.diagonal[b.element[k]->nodes[a]], columns, k);
  }
  std::size_t slot = 0;
  for (int p = 1; p < 4; ++p)
    for (int q = 0; q < p; ++q, ++slot) {
      const auto columns = block(p, q);
      for (int k = 0; k < b.count; ++k) add(matrix.lower[b.element[k]->slots[slot]], columns, k);
    }
}

/// Adds one vector to each of the last three nodes and their negative sum to the first.
void add_forces(const Batch& b, const LaneMatrix& force, BlockVector& right_side) {
  const std::array<std::array<Lanes, lanes>, 3> columns{by_element(force.column[0]), by_element(force.column[1]),
                                                        by_element(force.column[2])};
  for (int k = 0; k < b.count; ++k) {
    const auto& nodes = b.element[k]->nodes;
    right_side[nodes[0]] -= columns[0][k] + columns[1][k] + columns[2][k];
    for (int a = 0; a < 3; ++a) right_side[nodes[a + 1]] += columns[a][k];
  }
}

/// Elements that are flat or inverted, one by one: stiffness and stress of their determinant.
void add_volume_constraint(const ElasticBody& body, const Element& e, double dt, double scale, StepWorkspace& w) {
  const LameConstants lame = lame_constants(body.material);
  const double stiffness_pa = lame.lambda_pa + 2.0 * lame.mu_pa;
  const Eigen::Matrix3d f = deformation_gradient(e, body.position_m);
  add_volume_stiffness(e, f, scale * stiffness_pa, w.matrix);
  const Eigen::Matrix3d impulse = -dt * e.rest_volume_m3 * stiffness_pa * (f.determinant() - least_determinant) *
                                  cofactor(f) * e.rest_inverse.transpose();
  w.right_side[e.nodes[0]] -= padded(impulse.rowwise().sum());
  for (int a = 0; a < 3; ++a) w.right_side[e.nodes[a + 1]] += padded(impulse.col(a));
}

void guard_volume(const ElasticBody& body, const Element& e, double determinant, double dt, double scale,
                  StepWorkspace& w, StepReport& report) {
  if (!(determinant < least_determinant)) return;
  add_volume_constraint(body, e, dt, scale, w);
  if (determinant <= 0.0) ++report.inverted;
}

/// The shell and its elements' guard.
void assemble_sheet(ElasticBody& body, const StepSettings& settings, bool mean_deformation, StepReport& report) {
  StepWorkspace& w = body.workspace;
  assemble_shell(body, settings, report);
  const double dt = settings.step_s, scale = dt * dt / gamma_of(settings);
  for (const Element& e : body.elements) {
    const Eigen::Matrix3d f = deformation_gradient(e, body.position_m);
    guard_volume(body, e, f.determinant(), dt, scale, w, report);
    if (!mean_deformation) continue;
    for (const int node : e.nodes)
      for (int c = 0; c < 3; ++c) w.mean_deformation[node].column[c] += e.rest_volume_m3 * padded(f.col(c));
  }
}

}  // namespace

void assemble(ElasticBody& body, const StepSettings& settings, bool mean_deformation, StepReport& report) {
  StepWorkspace& w = body.workspace;
  const double dt = settings.step_s, scale = dt * dt / gamma_of(settings);
  const LameConstants lame = lame_constants(body.material);
  w.matrix.set_zero(body.pattern);
  const int n = body.node_count();
  w.right_side.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double m = body.mass_kg[i];
    for (int c = 0; c < 3; ++c) w.matrix.diagonal[i].column[c][c] = m;
    w.right_side[i] = padded(m * body.velocity_mps[i] + dt * (body.force_n[i] + m * settings.gravity_mps2));
  }
  if (mean_deformation) w.mean_deformation.assign(static_cast<std::size_t>(n), zero_block());
  if (!body.shell.empty()) {
    assemble_sheet(body, settings, mean_deformation, report);
    return;
  }
  const double limit_factor = tension_limit * body.material.density_kgpm3 / (dt * dt);
  for (std::size_t first = 0; first < body.elements.size(); first += lanes) {
    const Batch b = load(body.elements, first);
    const LaneMatrix f = times(edges(b, body.position_m), b.rest_inverse);
    LaneMatrix stress = gram(f);  // S = λ tr(E) I + μ (FᵀF − I).
    const Lanes trace = 0.5 * lame.lambda_pa * (stress(0, 0) + stress(1, 1) + stress(2, 2) - 3.0) - lame.mu_pa;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) stress(r, c) *= lame.mu_pa;
      stress(c, c) += trace;
    }
    const Lanes determinant = f(0, 0) * (f(1, 1) * f(2, 2) - f(2, 1) * f(1, 2)) +
                              f(1, 0) * (f(2, 1) * f(0, 2) - f(0, 1) * f(2, 2)) +
                              f(2, 0) * (f(0, 1) * f(1, 2) - f(1, 1) * f(0, 2));

    LaneMatrix tension;
    bool with_tension = false;
    if (settings.tension_stiffness) {
      const Lanes limit = limit_factor / squared_norm(b.rest_inverse);
      const Lanes norm = squared_norm(stress).sqrt();
      if ((norm > limit).any()) {
        tension = tensile_bound(stress, norm);
        const Lanes pulls = (squared_norm(tension) > limit.square()).cast<double>();
        for (int c = 0; c < 9; ++c) tension(c % 3, c / 3) *= pulls;
        report.under_tension += static_cast<int>(pulls.head(b.count).sum());
        with_tension = (pulls != 0.0).any();
      }
    }
    add_stiffness_blocks(b, f, with_tension ? &tension : nullptr, lame, scale, w.matrix);

    const LaneMatrix first_piola = times(f, stress), gradient = transposed(b.rest_inverse);
    LaneMatrix impulse = times(first_piola, gradient);
    for (int c = 0; c < 9; ++c) impulse(c % 3, c / 3) *= -dt * b.volume;
    if (with_tension) {
      // K_g acts on the change of velocity, so that a body that spins under tension is not slowed.
      const LaneMatrix kept = times(times(times(edges(b, body.velocity_mps), b.rest_inverse), tension), gradient);
      for (int c = 0; c < 9; ++c) impulse(c % 3, c / 3) += scale * b.volume * kept(c % 3, c / 3);
    }
    add_forces(b, impulse, w.right_side);
    if (!(determinant >= least_determinant).all())
      for (int k = 0; k < b.count; ++k) guard_volume(body, *b.element[k], determinant[k], dt, scale, w, report);
    if (!mean_deformation) continue;
    LaneMatrix weighted = f;
    for (int c = 0; c < 9; ++c) weighted(c % 3, c / 3) *= b.volume;
    const std::array<std::array<Lanes, lanes>, 3> columns{
        by_element(weighted.column[0]), by_element(weighted.column[1]), by_element(weighted.column[2])};
    for (int k = 0; k < b.count; ++k)
      for (const int node : b.element[k]->nodes) add(w.mean_deformation[node], columns, k);
  }
}

}  // namespace septet::elastic
