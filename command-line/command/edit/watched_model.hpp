#pragma once
/// A model's file that is read again each time when a modelling program has saved it: what differs becomes commands, so
/// that a live link costs what was changed.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/editor/edit_verbs.hpp"
#include "engine/scene/store.hpp"

namespace septet::server {

/// Ids that are kept for a watched model's nodes.
inline constexpr scene::NodeId watched_ids = 4096;

class WatchedModel {
 public:
  /// Nodes get ids from `first` on.
  WatchedModel(std::string name, std::filesystem::path file, const scene::Transform& transform, scene::NodeId first)
      : name_(std::move(name)), file_(std::move(file)), transform_(transform), first_(first) {}

  /// The commands that bring the model to what the file holds now. Error: as of make_model, or too many nodes; nothing
  /// has changed then.
  Expected<editor::EditedLine> read();
  /// True once after each time when the file was saved and has rested since.
  bool is_saved(double now_s);
  const std::filesystem::path& file() const { return file_; }

 private:
  struct Stamp {
    std::filesystem::file_time_type time{};
    std::uintmax_t bytes = 0;
    bool operator==(const Stamp&) const = default;
  };
  Stamp stamp() const;

  std::string name_;
  std::filesystem::path file_;
  scene::Transform transform_;
  scene::NodeId first_;
  scene::Store made_;  ///< As of the last reading.
  Stamp known_, seen_;
  double looked_s_ = 0.0, rests_since_s_ = 0.0;
};

/// By the line `watch NAME FILE.glb [X Y Z [HEADING]]`: ids are kept for its nodes, and its name is known.
Expected<WatchedModel> watched_of(const std::vector<scene::TextWord>& words, const scene::Store& store,
                                  editor::EditNames& names);

}  // namespace septet::server
