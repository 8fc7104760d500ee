#include "engine/scene/run_codec.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace septet::scene {
namespace {

constexpr std::uint8_t plain_form = 255;
constexpr int finest_grid = 20;
constexpr std::int64_t largest_multiple = 1 << 24;  ///< Floats hold every integer up to here.
constexpr std::size_t most_zeros = 255;

/// The smallest k ≥ 0 for which the value is a multiple of 2^-k; beyond `finest_grid` it may be any larger number.
int grid_of(float value) {
  if (value == 0.0f) return 0;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const int exponent = static_cast<int>(bits >> 23 & 0xFF);
  if (exponent == 0 || exponent == 0xFF) return finest_grid + 1;  // Denormal, infinite, NaN.
  // The value is mantissa · 2^(exponent − 150).
  return std::max(0, 150 - exponent - std::countr_zero((bits & 0x7FFFFFu) | 0x800000u));
}

/// The smallest k for which every value is a multiple of 2^-k, or plain_form.
std::uint8_t grid_of(std::span<const float> values) {
  int k = 0;
  float largest = 0.0f;
  for (const float value : values) {
    k = std::max(k, grid_of(value));
    if (k > finest_grid) return plain_form;
    largest = std::max(largest, std::abs(value));
  }
  return std::ldexp(largest, k) <= static_cast<float>(largest_multiple) ? static_cast<std::uint8_t>(k) : plain_form;
}

}  // namespace

void put_reals(ByteWriter& out, std::span<const float> values, std::size_t stride) {
  const std::uint8_t form = grid_of(values);
  out.put(form);
  if (form == plain_form) {
    for (const float value : values) out.put(value);
    return;
  }
  const float per_step = std::ldexp(1.0f, form);
  std::array<std::int64_t, 3> previous{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto multiple = static_cast<std::int64_t>(values[i] * per_step);
    out.put_signed_varint(multiple - previous[i % stride]);
    previous[i % stride] = multiple;
  }
}

void get_reals(ByteReader& in, std::span<float> values, std::size_t stride) {
  const auto form = in.get<std::uint8_t>();
  if (form != plain_form && form > finest_grid) return in.fail();
  if (form == plain_form) {
    for (float& value : values) value = in.get_float();
    return;
  }
  const float step = std::ldexp(1.0f, -form);
  std::array<std::int64_t, 3> previous{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::int64_t difference = in.get_signed_varint();
    if (!in.ok() || difference > 2 * largest_multiple || difference < -2 * largest_multiple) return in.fail();
    std::int64_t& multiple = previous[i % stride];
    multiple += difference;
    if (multiple > largest_multiple || multiple < -largest_multiple) return in.fail();
    values[i] = static_cast<float>(multiple) * step;
  }
}

void put_integers(ByteWriter& out, std::span<const std::uint32_t> values) {
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t difference = values[i] - previous;
    previous = values[i];
    out.put_signed_varint(static_cast<std::int32_t>(difference));
    if (difference != 0) continue;
    std::size_t zeros = 0;
    while (zeros < most_zeros && i + 1 < values.size() && values[i + 1] == previous) ++zeros, ++i;
    out.put(static_cast<std::uint8_t>(zeros));
  }
}

void get_integers(ByteReader& in, std::span<std::uint32_t> values) {
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::int64_t difference = in.get_signed_varint();
    if (!in.ok() || difference > INT32_MAX || difference < INT32_MIN) return in.fail();
    previous += static_cast<std::uint32_t>(difference);
    values[i] = previous;
    if (difference != 0) continue;
    const std::size_t zeros = in.get<std::uint8_t>();
    if (zeros > values.size() - i - 1) return in.fail();
    for (std::size_t k = 0; k < zeros; ++k) values[++i] = previous;
  }
}

void put_corners(ByteWriter& out, std::span<const PolygonCorners> polygons) {
  std::int64_t previous = 0;
  for (const PolygonCorners& corners : polygons)
    for (const std::uint32_t corner : corners) {
      if (corner == geometry::no_vertex) {
        out.put_varint(0);
        continue;
      }
      const std::int64_t difference = std::int64_t{corner} - previous;
      previous = corner;
      out.put_varint(1 +
                     ((static_cast<std::uint64_t>(difference) << 1) ^ static_cast<std::uint64_t>(difference >> 63)));
    }
}

void get_corners(ByteReader& in, std::span<PolygonCorners> polygons) {
  std::int64_t previous = 0;
  for (PolygonCorners& corners : polygons)
    for (std::uint32_t& corner : corners) {
      const std::uint64_t code = in.get_varint();
      if (!in.ok() || code > (std::uint64_t{1} << 34)) return in.fail();
      if (code == 0) {
        corner = geometry::no_vertex;
        continue;
      }
      const std::uint64_t bits = code - 1;
      previous += static_cast<std::int64_t>((bits >> 1) ^ (0 - (bits & 1)));
      if (previous < 0 || previous >= std::int64_t{geometry::no_vertex}) return in.fail();
      corner = static_cast<std::uint32_t>(previous);
    }
}

}  // namespace septet::scene
