#include "engine/effects/ice/ice_keyframe.hpp"

#include <algorithm>
#include <cmath>

namespace septet::ice {
namespace {

constexpr std::uint8_t version = 1;
constexpr double quanta_per_m = 1000.0, quanta_per_kh = 256.0;
/// In quanta: bounds of a place relative to the one before, and of all sizes.
constexpr std::int64_t furthest = 1'000'000'000, largest = 20'000, most_thaw = 1 << 24;

std::int64_t quantised(double value, double per_unit, std::int64_t low, std::int64_t high) {
  if (!(value == value)) return low;
  return std::llround(std::clamp(value * per_unit, static_cast<double>(low), static_cast<double>(high)));
}

struct Writer {
  ByteWriter out;
  Vec3 last_m{0.0};  ///< As it was written.

  void put(double value, double per_unit, std::int64_t high) {
    out.put_varint(static_cast<std::uint64_t>(quantised(value, per_unit, 0, high)));
  }
  void put_place(const Vec3& place_m) {
    for (int c = 0; c < 3; ++c) {
      const std::int64_t step = quantised(place_m[c] - last_m[c], quanta_per_m, -furthest, furthest);
      out.put_signed_varint(step);
      last_m[c] += static_cast<double>(step) / quanta_per_m;
    }
  }
};

struct Reader {
  ByteReader in;
  Vec3 last_m{0.0};

  double get(double per_unit, std::int64_t high) {
    const std::uint64_t value = in.get_varint();
    if (value > static_cast<std::uint64_t>(high)) in.fail();
    return in.ok() ? static_cast<double>(value) / per_unit : 0.0;
  }
  Vec3 get_place() {
    for (int c = 0; c < 3; ++c) {
      const std::int64_t step = in.get_signed_varint();
      if (step < -furthest || step > furthest) in.fail();
      if (in.ok()) last_m[c] += static_cast<double>(step) / quanta_per_m;
      if (std::abs(last_m[c]) > 2.0 * static_cast<double>(furthest) / quanta_per_m) in.fail();
    }
    return last_m;
  }
  /// Number of items of at least `bytes_each` bytes.
  std::size_t get_count(std::size_t most, std::size_t bytes_each) {
    return in.get_count(std::min(most, in.remaining() / bytes_each));
  }
};

}  // namespace

Bytes encode(const StillIce& ice) {
  Bytes bytes;
  Writer writer{ByteWriter(bytes)};
  writer.out.put(version);
  writer.put(ice.thawed_kh, quanta_per_kh, most_thaw);
  const std::size_t slabs = std::min(ice.slabs.size(), most_slabs);
  writer.out.put_varint(slabs);
  for (std::size_t i = 0; i < slabs; ++i) {
    const LyingSlab& slab = ice.slabs[i];
    writer.out.put_varint(slab.vehicle);
    writer.last_m = Vec3(0.0);
    writer.put_place(slab.foot_m);
    for (int c = 0; c < 3; ++c) writer.put(slab.size_m[c], quanta_per_m, largest);
  }
  writer.last_m = Vec3(0.0);
  const std::size_t rows = std::min(ice.rows.size(), most_rows);
  writer.out.put_varint(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const IcicleRow& row = ice.rows[i];
    writer.put_place(row.from_m);
    writer.put_place(row.to_m);
    writer.put(row.longest_m, quanta_per_m, largest);
    writer.out.put_varint(row.seed);
  }
  const std::size_t sheets = std::min(ice.sheets.size(), most_sheets);
  writer.out.put_varint(sheets);
  for (std::size_t i = 0; i < sheets; ++i) {
    const Sheet& sheet = ice.sheets[i];
    const std::size_t points = std::min({sheet.left_m.size(), sheet.right_m.size(), most_sheet_points});
    writer.put(sheet.thickness_m, quanta_per_m, largest);
    writer.out.put_varint(points);
    for (std::size_t k = 0; k < points; ++k) {
      writer.put_place(sheet.left_m[k]);
      writer.put_place(sheet.right_m[k]);
    }
  }
  return bytes;
}

Expected<StillIce> decode(std::span<const std::byte> bytes) {
  Reader reader{ByteReader(bytes)};
  StillIce ice;
  if (reader.in.get<std::uint8_t>() != version) reader.in.fail();
  ice.thawed_kh = reader.get(quanta_per_kh, most_thaw);
  ice.slabs.resize(reader.get_count(most_slabs, 7));
  for (LyingSlab& slab : ice.slabs) {
    const std::uint64_t vehicle = reader.in.get_varint();
    if (vehicle > UINT32_MAX) reader.in.fail();
    slab.vehicle = static_cast<ParticipantId>(vehicle);
    reader.last_m = Vec3(0.0);
    slab.foot_m = reader.get_place();
    for (int c = 0; c < 3; ++c) slab.size_m[c] = reader.get(quanta_per_m, largest);
  }
  reader.last_m = Vec3(0.0);
  ice.rows.resize(reader.get_count(most_rows, 8));
  for (IcicleRow& row : ice.rows) {
    row.from_m = reader.get_place();
    row.to_m = reader.get_place();
    row.longest_m = reader.get(quanta_per_m, largest);
    const std::uint64_t seed = reader.in.get_varint();
    if (seed > UINT32_MAX) reader.in.fail();
    row.seed = static_cast<std::uint32_t>(seed);
  }
  ice.sheets.resize(reader.get_count(most_sheets, 2));
  for (Sheet& sheet : ice.sheets) {
    sheet.thickness_m = reader.get(quanta_per_m, largest);
    const std::size_t points = reader.get_count(most_sheet_points, 6);
    for (std::size_t k = 0; k < points && reader.in.ok(); ++k) {
      sheet.left_m.push_back(reader.get_place());
      sheet.right_m.push_back(reader.get_place());
    }
  }
  if (!reader.in.ok() || !reader.in.at_end())
    return failure("the bytes are of another kind, or damaged", "ice keyframe",
                   "send what the same version of Septet wrote");
  return ice;
}

}  // namespace septet::ice
