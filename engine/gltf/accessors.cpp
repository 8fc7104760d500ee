#include "engine/gltf/accessors.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/gltf.hpp"

namespace septet::gltf {
namespace {

enum class Component : std::int64_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

std::size_t bytes_of(Component component) {
  switch (component) {
    case Component::i8:
    case Component::u8:
      return 1;
    case Component::i16:
    case Component::u16:
      return 2;
    case Component::u32:
    case Component::f32:
      return 4;
  }
  return 0;
}

std::size_t width_of(std::string_view type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : type == "MAT4" ? 16 : 0;
}

template <class T>
T value_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Layout of the rows, all of them within `bytes`.
struct Layout {
  std::string_view bytes;
  std::vector<char> owned;  ///< Storage of `bytes`, where the file does not hold the rows as they are.
  std::size_t count = 0, width = 0, stride = 0;
  Component component = Component::f32;
  bool normalised = false;
  std::string where;

  const char* row(std::size_t i) const { return bytes.data() + i * stride; }
};

/// Rows of `size` bytes, all within their buffer view.
struct ViewRows {
  std::string_view bytes;
  std::size_t stride = 0;
};

/// `json`: of an accessor, or of a sparse one's indices or values; only an accessor's rows may be strided.
Expected<ViewRows> rows_in_view(const Container& container, const Json& json, std::size_t size, std::size_t count,
                                bool may_lie_apart, const std::string& where) {
  const std::int64_t view = index_in(json, "bufferView"), offset = index_in(json, "byteOffset", 0);
  const auto bytes = view_bytes(container, view, where);
  if (!bytes) return tl::unexpected(bytes.error());
  const Json& view_json = list_of(*container.json, "bufferViews")[static_cast<std::size_t>(view)];
  const auto packed = static_cast<std::int64_t>(size);
  const std::int64_t stride = may_lie_apart ? index_in(view_json, "byteStride", packed) : packed;
  if (stride < packed || stride > 4096)
    return failure(fmt::format("its rows of {} bytes lie {} apart", size, stride), where, export_anew);
  const std::uint64_t needed = count == 0 ? 0 : (count - 1) * static_cast<std::uint64_t>(stride) + size;
  if (offset < 0 || static_cast<std::uint64_t>(offset) > bytes->size() ||
      needed > bytes->size() - static_cast<std::uint64_t>(offset))
    return failure(fmt::format("its {} rows reach beyond buffer view {} of {} bytes", count, view, bytes->size()),
                   where, export_anew);
  return ViewRows{bytes->substr(static_cast<std::size_t>(offset)), static_cast<std::size_t>(stride)};
}

std::optional<std::uint32_t> index_at(const char* bytes, Component component) {
  switch (component) {
    case Component::u8:
      return value_at<std::uint8_t>(bytes);
    case Component::u16:
      return value_at<std::uint16_t>(bytes);
    case Component::u32:
      return value_at<std::uint32_t>(bytes);
    default:
      return std::nullopt;
  }
}

/// The rows that `sparse` names, over those of `rows` (glTF 2.0, 3.6.2.3).
Expected<void> write_sparse(const Container& container, const Json& sparse, std::size_t size, std::vector<char>& rows,
                            const std::string& where) {
  static const Json none = Json::object();
  const std::size_t row_count = rows.size() / size;
  const std::int64_t count = index_in(sparse, "count");
  const Json& indices = sparse.is_object() && sparse.contains("indices") ? sparse["indices"] : none;
  const Json& values = sparse.is_object() && sparse.contains("values") ? sparse["values"] : none;
  const auto type = static_cast<Component>(index_in(indices, "componentType"));
  if (count < 1 || static_cast<std::uint64_t>(count) > row_count || bytes_of(type) == 0)
    return failure(fmt::format("its sparse part counts {} of {} rows", count, row_count), where, export_anew);
  const auto named = static_cast<std::size_t>(count);
  const auto places = rows_in_view(container, indices, bytes_of(type), named, false, where + ", sparse indices");
  if (!places) return tl::unexpected(places.error());
  const auto written = rows_in_view(container, values, size, named, false, where + ", sparse values");
  if (!written) return tl::unexpected(written.error());
  for (std::size_t i = 0; i < named; ++i) {
    const auto row = index_at(places->bytes.data() + i * places->stride, type);
    if (!row || *row >= row_count)
      return failure(row ? fmt::format("sparse index {} is row {} of {}", i, *row, row_count)
                         : "its sparse indices are no whole numbers",
                     where, export_anew);
    std::memcpy(rows.data() + *row * size, written->bytes.data() + i * size, size);
  }
  return {};
}

Expected<Layout> layout_of(const Container& container, std::int64_t accessor, std::size_t most_rows) {
  const Json& accessors = list_of(*container.json, "accessors");
  Layout layout;
  layout.where = fmt::format("{}, accessor {}", container.where, accessor);
  if (accessor < 0 || static_cast<std::uint64_t>(accessor) >= accessors.size())
    return failure(fmt::format("there is none: the file has {}", accessors.size()), layout.where, export_anew);
  const Json& json = accessors[static_cast<std::size_t>(accessor)];
  layout.component = static_cast<Component>(index_in(json, "componentType"));
  layout.width = width_of(text_in(json, "type"));
  const std::size_t size = bytes_of(layout.component) * layout.width;
  if (size == 0)
    return failure(fmt::format("its type is \"{}\" of {}", printable(text_in(json, "type"), 20),
                               static_cast<std::int64_t>(layout.component)),
                   layout.where, export_anew);
  const std::int64_t count = index_in(json, "count");
  if (count < 0 || static_cast<std::uint64_t>(count) > most_rows)
    return failure(
        fmt::format("it counts {}, more than {}", count < 0 ? "no number" : std::to_string(count), most_rows),
        layout.where, "make the model of fewer triangles");
  layout.count = static_cast<std::size_t>(count);
  const auto normalised = json.find("normalized");
  layout.normalised = normalised != json.end() && normalised->is_boolean() && normalised->get<bool>();
  const bool is_sparse = json.contains("sparse"), has_view = json.contains("bufferView");
  if (has_view) {
    const auto rows = rows_in_view(container, json, size, layout.count, true, layout.where);
    if (!rows) return tl::unexpected(rows.error());
    layout.bytes = rows->bytes;
    layout.stride = rows->stride;
    if (!is_sparse) return layout;
  }
  // Without a view the rows are zeros (3.6.2.3); sparse rows are written over a copy.
  layout.owned.assign(layout.count * size, '\0');
  if (has_view)
    for (std::size_t i = 0; i < layout.count; ++i) std::memcpy(layout.owned.data() + i * size, layout.row(i), size);
  if (is_sparse)
    if (auto written = write_sparse(container, json["sparse"], size, layout.owned, layout.where); !written)
      return tl::unexpected(written.error());
  layout.bytes = {layout.owned.data(), layout.owned.size()};
  layout.stride = size;
  return layout;
}

float number_at(const char* bytes, Component component, bool normalised) {
  const auto scaled = [&](float value, float full) { return normalised ? std::max(value / full, -1.0f) : value; };
  switch (component) {
    case Component::i8:
      return scaled(value_at<std::int8_t>(bytes), 127.0f);
    case Component::u8:
      return scaled(value_at<std::uint8_t>(bytes), 255.0f);
    case Component::i16:
      return scaled(value_at<std::int16_t>(bytes), 32767.0f);
    case Component::u16:
      return scaled(value_at<std::uint16_t>(bytes), 65535.0f);
    case Component::u32:
      return static_cast<float>(value_at<std::uint32_t>(bytes));
    case Component::f32:
      return value_at<float>(bytes);
  }
  return 0.0f;
}

}  // namespace

Expected<Rows> read_rows(const Container& container, std::int64_t accessor, std::size_t least_width,
                         std::size_t most_width, std::size_t most_rows) {
  const auto layout = layout_of(container, accessor, most_rows);
  if (!layout) return tl::unexpected(layout.error());
  if (layout->width < least_width || layout->width > most_width)
    return failure(fmt::format("it has {} numbers a row, not {}", layout->width, least_width), layout->where,
                   export_anew);
  Rows rows{layout->count, layout->width, {}};
  rows.numbers.reserve(rows.count * rows.width);
  const std::size_t step = bytes_of(layout->component);
  for (std::size_t i = 0; i < rows.count; ++i)
    for (std::size_t k = 0; k < rows.width; ++k) {
      const float number = number_at(layout->row(i) + k * step, layout->component, layout->normalised);
      if (!std::isfinite(number))
        return failure(fmt::format("number {} of row {} is not finite", k, i), layout->where, export_anew);
      rows.numbers.push_back(number);
    }
  return rows;
}

Expected<std::vector<std::uint32_t>> read_indices(const Container& container, std::int64_t accessor,
                                                  std::size_t most_rows, std::size_t vertices) {
  const auto layout = layout_of(container, accessor, most_rows);
  if (!layout) return tl::unexpected(layout.error());
  const Component type = layout->component;
  if (layout->width != 1) return failure("it is no list of indices", layout->where, export_anew);
  std::vector<std::uint32_t> indices;
  indices.reserve(layout->count);
  for (std::size_t i = 0; i < layout->count; ++i) {
    const auto index = index_at(layout->row(i), type);
    if (!index) return failure("it is no list of indices", layout->where, export_anew);
    if (*index >= vertices)
      return failure(fmt::format("index {} is vertex {} of {}", i, *index, vertices), layout->where, export_anew);
    indices.push_back(*index);
  }
  return indices;
}

}  // namespace septet::gltf
