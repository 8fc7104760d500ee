#include "engine/gltf/accessors.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

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
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

/// Where the rows lie, all of them within `bytes`.
struct Layout {
  std::string_view bytes;
  std::size_t count = 0, width = 0, stride = 0;
  Component component = Component::f32;
  bool normalised = false;
  std::string where;

  const char* row(std::size_t i) const { return bytes.data() + i * stride; }
};

Expected<Layout> layout_of(const Container& container, std::int64_t accessor, std::size_t most_rows) {
  const Json& accessors = list_of(*container.json, "accessors");
  Layout layout;
  layout.where = fmt::format("{}, accessor {}", container.where, accessor);
  if (accessor < 0 || static_cast<std::uint64_t>(accessor) >= accessors.size())
    return failure(fmt::format("there is none: the file has {}", accessors.size()), layout.where, export_anew);
  const Json& json = accessors[static_cast<std::size_t>(accessor)];
  if (json.is_object() && json.contains("sparse"))
    return failure("it is sparse, which is not read", layout.where, "export it without sparse accessors");
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
  const std::int64_t view = index_in(json, "bufferView"), offset = index_in(json, "byteOffset", 0);
  const auto bytes = view_bytes(container, view, layout.where);
  if (!bytes) return tl::unexpected(bytes.error());
  const Json& view_json = list_of(*container.json, "bufferViews")[static_cast<std::size_t>(view)];
  const std::int64_t stride = index_in(view_json, "byteStride", static_cast<std::int64_t>(size));
  if (stride < static_cast<std::int64_t>(size) || stride > 4096)
    return failure(fmt::format("its rows of {} bytes lie {} apart", size, stride), layout.where, export_anew);
  layout.stride = static_cast<std::size_t>(stride);
  const std::uint64_t needed = layout.count == 0 ? 0 : (layout.count - 1) * layout.stride + size;
  if (offset < 0 || static_cast<std::uint64_t>(offset) > bytes->size() ||
      needed > bytes->size() - static_cast<std::uint64_t>(offset))
    return failure(
        fmt::format("its {} rows reach beyond buffer view {} of {} bytes", layout.count, view, bytes->size()),
        layout.where, export_anew);
  layout.bytes = bytes->substr(static_cast<std::size_t>(offset));
  const auto normalised = json.find("normalized");
  layout.normalised = normalised != json.end() && normalised->is_boolean() && normalised->get<bool>();
  return layout;
}

template <class T>
T value_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
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
        return failure(fmt::format("number {} of row {} is none", k, i), layout->where, export_anew);
      rows.numbers.push_back(number);
    }
  return rows;
}

Expected<std::vector<std::uint32_t>> read_indices(const Container& container, std::int64_t accessor,
                                                  std::size_t most_rows, std::size_t vertices) {
  const auto layout = layout_of(container, accessor, most_rows);
  if (!layout) return tl::unexpected(layout.error());
  const Component type = layout->component;
  if (layout->width != 1 || (type != Component::u8 && type != Component::u16 && type != Component::u32))
    return failure("it is no list of indices", layout->where, export_anew);
  std::vector<std::uint32_t> indices;
  indices.reserve(layout->count);
  for (std::size_t i = 0; i < layout->count; ++i) {
    const char* at = layout->row(i);
    const std::uint32_t index = type == Component::u8    ? value_at<std::uint8_t>(at)
                                : type == Component::u16 ? value_at<std::uint16_t>(at)
                                                         : value_at<std::uint32_t>(at);
    if (index >= vertices)
      return failure(fmt::format("index {} is vertex {} of {}", i, index, vertices), layout->where, export_anew);
    indices.push_back(index);
  }
  return indices;
}

}  // namespace septet::gltf
