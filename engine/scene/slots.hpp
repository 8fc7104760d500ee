#pragma once
/// Slots of one of ResolvedScene's arrays, by the keys of their sources. They keep their index while they are in use.

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace septet::scene {

template <class Key, class Content>
class Slots {
 public:
  /// The slot of `key`, made where it does not exist.
  std::uint32_t of(const Key& key, std::vector<Content>& contents) {
    const auto [found, added] = by_key_.try_emplace(key, 0);
    if (!added) return found->second;
    if (free_.empty()) {
      found->second = static_cast<std::uint32_t>(contents.size());
      contents.emplace_back();
    } else {
      found->second = *free_.begin();
      free_.erase(free_.begin());
    }
    return found->second;
  }
  void release(const Key& key) {
    const auto found = by_key_.find(key);
    free_.insert(found->second);
    by_key_.erase(found);
  }
  const std::map<Key, std::uint32_t>& all() const { return by_key_; }

 private:
  std::map<Key, std::uint32_t> by_key_;
  std::set<std::uint32_t> free_;
};

}  // namespace septet::scene
