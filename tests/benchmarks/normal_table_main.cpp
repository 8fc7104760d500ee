/// Table 1 of "Temporal Face Normal Interpolation" over nine morphs of 15,300 faces: the summed angle errors, and each
/// as a multiple of linear interpolation's, beside the paper's four meshes. Run `build/release/septet-normal-table`.

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "tests/engine/geometry/morphs.hpp"

using namespace septet;

namespace {

constexpr std::array order{NormalMethod::linear,          NormalMethod::quadratic,
                           NormalMethod::cubic,           NormalMethod::t_variant,
                           NormalMethod::vector_slerp,    NormalMethod::spherical_de_casteljau,
                           NormalMethod::quaternion_slerp};

void print_row(std::string_view name, double linear, const std::array<double, order.size()>& errors) {
  fmt::print("{:38}{:10.0f}", name, linear);
  for (const double error : errors) fmt::print("{:9.3f}", error / linear);
  fmt::print("\n");
}

}  // namespace

int main() {
  fmt::print("{:38}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "error as a multiple of linear's", "linear sum",
             "linear", "quad", "cubic", "t-var", "SLERP", "deCast", "quat");
  struct PaperMesh {
    std::string_view name;
    std::array<double, order.size()> errors;
  };
  constexpr std::array<PaperMesh, 4> paper{
      PaperMesh{"paper, 15300 faces", {18916, 4820, 1906, 0, 19427, 7039, 17766}},
      PaperMesh{"paper, 44700 faces", {55756, 15792, 6444, 0, 57999, 21772, 53492}},
      PaperMesh{"paper, 35180 faces", {44078, 9681, 3640, 0, 44972, 16068, 42831}},
      PaperMesh{"paper, 21040 faces", {20061, 5425, 1572, 0, 20861, 7647, 19202}}};
  for (const PaperMesh& mesh : paper) print_row(mesh.name, mesh.errors[0], mesh.errors);
  for (const Morph& morph : all_morphs()) {
    std::array<double, order.size()> errors{};
    std::ranges::transform(order, errors.begin(),
                           [&](NormalMethod method) { return angle_error(morph.faces, method); });
    print_row(morph.name, errors[0], errors);
  }
}
