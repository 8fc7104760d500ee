#pragma once
/// The loops over all faces that the compiler turns into vector instructions; compiled with relaxed rounding.

#include <cstddef>

namespace septet {

/// Unit vectors along a polynomial of this degree in t (Horner): `planes` has the coefficients' x, y, z, lowest first,
/// each an array of `count`. A vector of length zero stays zero.
void polynomial_2(const float* const* planes, std::size_t count, float t, float* const* out);  ///< Of any length.
void unit_polynomial_1(const float* const* planes, std::size_t count, float t, float* const* out);
void unit_polynomial_2(const float* const* planes, std::size_t count, float t, float* const* out);
void unit_polynomial_3(const float* const* planes, std::size_t count, float t, float* const* out);

}  // namespace septet
