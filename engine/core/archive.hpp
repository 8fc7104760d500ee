#pragma once
/// Plain state to bytes, back, and into the state hash, by one list of members for all three.
///
///     SEPTET_MEMBERS(WheelState, travel_m, spin_rad)     beside the struct's models, in the struct's namespace
///     StateWriter writer(bytes);  transfer(writer, wheel);
///     StateReader reader(bytes);  transfer(reader, wheel);  if (!reader.ok()) …reader.problem()…
///     hash_members(hash, wheel);
///
/// The list names every member in its order, else it does not compile: it is a structured binding, and the offsets of its
/// names must ascend. Each member is kept and hashed, unless the list says otherwise, in groups:
///
///     SEPTET_MEMBER_GROUPS(Fire, hashed(vehicle, burning_s), kept(nearest_hint), left_out(picture))
///
/// `kept` but not hashed: members that only speed up the way to the next state, or were drawn or read once and stay. A
/// comment beside the list gives the reason, also for `left_out`: the member follows from the rest, or has a reader of
/// its own.
///
/// Bytes are those of this build: numbers as they stand in memory (little-endian), counts of 64 bits, no names. The
/// reader trusts nothing: a count is no more than the bytes that are left, memory has a limit, no number is NaN and no
/// vector infinite; bounds of an index are for the caller to require. After the first problem everything reads as zero.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/hash.hpp"
#include "engine/core/random.hpp"

namespace septet {

static_assert(std::endian::native == std::endian::little);

class StateWriter {
 public:
  static constexpr bool reads = false, hashes = false;
  explicit StateWriter(Bytes& out) : out_(out) {}

  void put(const void* from, std::size_t count) {
    const auto* bytes = static_cast<const std::byte*>(from);
    out_.insert(out_.end(), bytes, bytes + count);
  }
  std::size_t size() const { return out_.size(); }

 private:
  Bytes& out_;
};

/// Bytes in words of eight, the last one filled up with zeros.
class StateHasher {
 public:
  static constexpr bool reads = false, hashes = true;

  void put(const void* from, std::size_t count) {
    const auto* bytes = static_cast<const std::byte*>(from);
    if (count > 4 * word_size) {  // Local copies, which the bytes cannot alias.
      auto chains = chains_;
      for (; count >= 4 * word_size; bytes += 4 * word_size, count -= 4 * word_size)
        for (std::size_t i = 0; i < 4; ++i) chains[i].add(word_of(bytes + i * word_size, word_size));
      chains_ = chains;
    }
    for (; count >= word_size; bytes += word_size, count -= word_size) add(word_of(bytes, word_size));
    if (count > 0) add(word_of(bytes, count));
  }
  void finish(StateHash& hash) const {
    for (const StateHash& chain : chains_) hash.add(chain.value());
  }

 private:
  static constexpr std::size_t word_size = sizeof(std::uint64_t);
  static std::uint64_t word_of(const std::byte* bytes, std::size_t count) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, count);
    return word;
  }
  void add(std::uint64_t word) { chains_[turn_++ % chains_.size()].add(word); }

  std::array<StateHash, 4> chains_;  ///< Used in turns: a single chain would wait for every product.
  std::size_t turn_ = 0;
};

class StateReader {
 public:
  static constexpr bool reads = true, hashes = false;
  explicit StateReader(std::span<const std::byte> bytes, std::size_t most_memory = std::size_t{256} << 20)
      : bytes_(bytes), memory_left_(most_memory) {}

  bool ok() const { return problem_.empty(); }
  const std::string& problem() const { return problem_; }
  std::size_t remaining() const { return bytes_.size(); }
  /// Fails: every later read is zero, and the first problem stays.
  void fail(std::string_view problem) {
    if (ok()) problem_ = problem;
    bytes_ = {};
  }
  /// Fails and returns false where the condition does not hold.
  bool require(bool holds, std::string_view problem) {
    if (!holds) fail(problem);
    return ok();
  }
  void get(void* to, std::size_t count) {
    if (count > bytes_.size()) fail("it ends too early");
    if (!ok()) {
      std::memset(to, 0, count);
      return;
    }
    if (count == 0) return;
    std::memcpy(to, bytes_.data(), count);
    bytes_ = bytes_.subspan(count);
  }
  /// Call before allocating.
  bool take_memory(std::size_t bytes) {
    if (!require(bytes <= memory_left_, "it asks for too much memory")) return false;
    memory_left_ -= bytes;
    return true;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t memory_left_;
  std::string problem_;
};

/// T, const or not.
template <class S, class T>
concept SameButForConst = std::same_as<std::remove_const_t<S>, T>;

namespace archive {
/// A member that is kept and not hashed.
template <class T>
struct Kept {
  T& value;
};
template <class T>
inline constexpr bool is_kept = false;
template <class T>
inline constexpr bool is_kept<Kept<T>> = true;

template <class T>
const T& plain(const T& member) {
  return member;
}
template <class T>
const T& plain(const Kept<T>& member) {
  return member.value;
}

template <class... T>
std::tuple<T&...> hashed(T&... values) {
  return {values...};
}
template <class... T>
std::tuple<Kept<T>...> kept(T&... values) {
  return {Kept<T>{values}...};
}
constexpr bool ascend(std::initializer_list<std::size_t> offsets) {
  return std::ranges::adjacent_find(offsets, std::greater_equal{}) == offsets.end();
}

template <class... T>
std::tuple<> left_out(T&...) {
  return {};
}
}  // namespace archive

/// Lists all members of a plain struct, in their order: kept and hashed.
#define SEPTET_MEMBERS(Type, ...) SEPTET_MEMBER_GROUPS(Type, hashed(__VA_ARGS__))

/// Lists members in groups, each hashed(…), kept(…) or left_out(…).
#define SEPTET_MEMBER_GROUPS(Type, ...)                                              \
  template <::septet::SameButForConst<Type> S_>                                      \
  auto members(S_& whole_) {                                                         \
    auto& [SEPTET_EXPAND(SEPTET_EACH(SEPTET_NAMES_OF, __VA_ARGS__))] = whole_;       \
    SEPTET_REQUIRE_ORDER(SEPTET_EXPAND(SEPTET_EACH(SEPTET_NAMES_OF, __VA_ARGS__)))   \
    return std::tuple_cat(SEPTET_EXPAND(SEPTET_EACH(SEPTET_TUPLE_OF, __VA_ARGS__))); \
  }
// A group stands for a call of one of the three functions above, and behind SEPTET_NAMES_ for its names alone.
#define SEPTET_NAMES_hashed(...) __VA_ARGS__
#define SEPTET_NAMES_kept(...) __VA_ARGS__
#define SEPTET_NAMES_left_out(...) __VA_ARGS__
#define SEPTET_NAMES_OF(group) SEPTET_NAMES_##group
#define SEPTET_TUPLE_OF(group) ::septet::archive::group
// A binding takes members by their place and would call one by another's name. Compilers only warn that offsets of
// structs with constructors need not be supported; both support them.
#define SEPTET_REQUIRE_ORDER(...)                                                                        \
  _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Winvalid-offsetof\"") static_assert( \
      ::septet::archive::ascend({SEPTET_EXPAND_MORE(SEPTET_EACH(SEPTET_OFFSET_OF, __VA_ARGS__))}),       \
      "members are listed in the order of their struct");                                                \
  _Pragma("GCC diagnostic pop")
#define SEPTET_OFFSET_OF(name) offsetof(std::remove_const_t<S_>, name)
// Expands to macro(first), macro(second), …: a macro does not expand itself, so each round of SEPTET_EXPAND makes one
// more of SEPTET_AGAIN.
#define SEPTET_EACH(macro, first, ...) macro(first) __VA_OPT__(, SEPTET_AGAIN SEPTET_PARENTHESES(macro, __VA_ARGS__))
#define SEPTET_AGAIN() SEPTET_EACH
#define SEPTET_PARENTHESES ()
#define SEPTET_EXPAND(...) SEPTET_EXPAND_3(SEPTET_EXPAND_3(SEPTET_EXPAND_3(__VA_ARGS__)))
#define SEPTET_EXPAND_MORE(...) SEPTET_EXPAND(SEPTET_EXPAND(SEPTET_EXPAND(__VA_ARGS__)))
#define SEPTET_EXPAND_3(...) SEPTET_EXPAND_1(SEPTET_EXPAND_1(SEPTET_EXPAND_1(__VA_ARGS__)))
#define SEPTET_EXPAND_1(...) __VA_ARGS__

namespace archive {
template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t n>
inline constexpr bool is_array<std::array<T, n>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_shared = false;
template <class T>
inline constexpr bool is_shared<std::shared_ptr<const T>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class K, class V>
inline constexpr bool is_map<std::map<K, V>> = true;
/// GLM's vectors and quaternions.
template <class T>
concept FixedVector = requires(T v) {
  typename T::value_type;
  T::length();
  v[0];
};
template <class T>
concept Quaternion = FixedVector<T> && requires(T v) {
  v.w;
} && T::length()
== 4;
/// Eigen's matrices of fixed size.
template <class T>
concept FixedMatrix = requires(T m) {
  T::SizeAtCompileTime;
  typename T::Scalar;
  m.data();
};

template <class T>
void require_number(StateReader& reader, T& value) {
  if (!std::isnan(value)) return;
  reader.fail("a number in it is NaN");
  value = 0;
}
}  // namespace archive

/// Number of elements that follow, each of at least one byte; 0 after a problem.
inline std::size_t transfer_count(StateReader& reader, std::size_t element_size = 1) {
  std::uint64_t count = 0;
  reader.get(&count, sizeof count);
  return reader.require(count <= reader.remaining() / element_size, "it ends too early")
             ? static_cast<std::size_t>(count)
             : 0;
}

/// `V` is const for the writer.
template <class Archive, class V>
void transfer(Archive& archive, V& value) {
  using T = std::remove_const_t<V>;
  if constexpr (archive::is_kept<T>) {
    if constexpr (!Archive::hashes) transfer(archive, value.value);
  } else if constexpr (std::is_same_v<T, bool>) {
    auto byte = static_cast<std::uint8_t>(value);
    if constexpr (Archive::reads) {
      archive.get(&byte, 1);
      value = archive.require(byte <= 1, "a boolean in it is neither 0 nor 1") && byte == 1;
    } else {
      archive.put(&byte, 1);
    }
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::byte>) {
    if constexpr (Archive::reads) {
      archive.get(&value, sizeof value);
      if constexpr (std::is_floating_point_v<T>) archive::require_number(archive, value);
    } else {
      archive.put(&value, sizeof value);
    }
  } else if constexpr (archive::is_vector<T> || std::is_same_v<T, std::string>) {
    using Element = typename T::value_type;
    constexpr bool is_flat = (std::is_arithmetic_v<Element> || std::is_enum_v<Element>)&&!std::is_same_v<Element, bool>;
    if constexpr (Archive::reads) {
      const std::size_t count = transfer_count(archive, is_flat ? sizeof(Element) : 1);
      value.clear();
      if constexpr (is_flat) {
        if (!archive.take_memory(count * sizeof(Element))) return;
        value.resize(count);
        archive.get(value.data(), count * sizeof(Element));
        if constexpr (std::is_floating_point_v<Element>)
          for (Element& element : value) archive::require_number(archive, element);
      } else {
        for (std::size_t i = 0; i < count && archive.take_memory(sizeof(Element)); ++i)
          transfer(archive, value.emplace_back());
      }
    } else {
      const std::uint64_t count = value.size();
      archive.put(&count, sizeof count);
      if constexpr (is_flat)
        archive.put(value.data(), count * sizeof(Element));
      else
        for (const Element& element : value) transfer(archive, element);
    }
  } else if constexpr (std::is_same_v<T, Random>) {  // Its state is its only member.
    if constexpr (Archive::reads) {
      Random::State state{};
      transfer(archive, state);
      if (const auto restored = Random::from_state(state))
        value = *restored;
      else
        archive.fail("its random numbers would all be the same");
    } else {
      transfer(archive, value.state());
    }
  } else if constexpr (archive::is_array<T>) {
    for (auto& element : value) transfer(archive, element);
  } else if constexpr (archive::is_optional<T>) {
    bool has = false;
    if constexpr (Archive::reads) {
      transfer(archive, has);
      value.reset();
      if (has) transfer(archive, value.emplace());
    } else {
      has = value.has_value();
      transfer(archive, std::as_const(has));
      if (has) transfer(archive, *value);
    }
  } else if constexpr (archive::is_shared<T>) {
    bool has = value != nullptr;
    if constexpr (Archive::reads) {
      transfer(archive, has);
      value.reset();
      if (!has) return;
      auto made = std::make_shared<std::remove_const_t<typename T::element_type>>();
      transfer(archive, *made);
      value = std::move(made);
    } else {
      transfer(archive, std::as_const(has));
      if (has) transfer(archive, *value);
    }
  } else if constexpr (archive::is_map<T>) {
    using Entry = std::pair<typename T::key_type, typename T::mapped_type>;
    if constexpr (Archive::reads) {
      const std::size_t count = transfer_count(archive);
      value.clear();
      for (std::size_t i = 0; i < count && archive.take_memory(sizeof(Entry)); ++i) {
        Entry entry;
        transfer(archive, entry.first);
        transfer(archive, entry.second);
        value.insert(std::move(entry));
      }
    } else {
      const std::uint64_t count = value.size();
      archive.put(&count, sizeof count);
      for (const auto& [key, mapped] : value) {
        transfer(archive, key);
        transfer(archive, mapped);
      }
    }
  } else if constexpr (archive::FixedVector<T>) {
    for (int i = 0; i < static_cast<int>(T::length()); ++i) {
      transfer(archive, value[i]);
      if constexpr (Archive::reads) archive.require(std::isfinite(value[i]), "a vector in it is not finite");
    }
    if constexpr (Archive::reads && archive::Quaternion<T>) {
      const double square = value.w * value.w + value.x * value.x + value.y * value.y + value.z * value.z;
      archive.require(std::abs(square - 1.0) < 1e-3, "a quaternion in it is not of unit length");
    }
  } else if constexpr (archive::FixedMatrix<T>) {
    for (int i = 0; i < static_cast<int>(T::SizeAtCompileTime); ++i) {
      transfer(archive, value.data()[i]);
      if constexpr (Archive::reads) archive.require(std::isfinite(value.data()[i]), "a matrix in it is not finite");
    }
  } else {
    auto all = members(value);
    std::apply([&](auto&... each) { (transfer(archive, each), ...); }, all);
  }
}

/// Hashes the members that the lists mark as hashed.
template <class... V>
void hash_members(StateHash& hash, const V&... values) {
  StateHasher hasher;
  (transfer(hasher, values), ...);
  hasher.finish(hash);
}

}  // namespace septet
