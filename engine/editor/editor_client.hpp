#pragma once
/// A program's own editor of a running drive: connects, mirrors the scene, and has lines done (docs/editing.md) by the
/// server, through the gate by which all change the world.
///
///     auto editor = EditorClient::connect("keys", seconds);
///     (*editor)->take({"create mine/post 10 2 0"});
///     (*editor)->save("my.edits");
///
/// Each call waits for the server's answer. Between calls pump() is due at least once a second, or the server gives the
/// editor up; it comes back by itself, and its things are then its own still. The ticks are not read. One thread.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/editor/edit_place.hpp"
#include "engine/scene/store.hpp"

namespace septet::editor {

/// Seconds of a clock that never goes back; its zero is any.
using Clock = std::function<double()>;

/// What a batch has made.
struct Taken {
  std::uint64_t tick = 0;               ///< The first that shows it.
  std::vector<std::string> messages{};  ///< Of files: sizes, and what is left out.
};

class EditorClient {
 public:
  /// `keys`: folder that `septet drive --editors` or `septet rig keys --editor` wrote. `within_s`: longest wait for the
  /// server, and for each answer later on. Error: a file of the folder is missing, or nobody answers or lets this key in.
  static Expected<std::unique_ptr<EditorClient>> connect(const std::filesystem::path& keys, Clock clock,
                                                         double within_s = 30.0);
  static Expected<std::unique_ptr<EditorClient>> connect(EditPlace place, Clock clock, double within_s = 30.0);
  ~EditorClient();

  /// Has the lines done from one tick on, all or none. Shapes and pictures beyond 2 MiB go ahead in batches of their own,
  /// of which nothing is seen (content_ahead.hpp). `tick`: the first that is to show them, for which the call waits; 0, or
  /// one that is past: the next. Error: a line that cannot be read, or why the server refuses it.
  Expected<Taken> take(const std::vector<std::string>& lines, std::uint64_t tick = 0);
  /// Writes what differs from the world as this editor found it, as bare commands for `septet drive --edits`.
  Expected<void> save(const std::filesystem::path& file);
  /// Receives and sends.
  void pump();

  /// The scene, with all that the server had done when the last call returned.
  const scene::Store& scene() const;

 private:
  struct State;
  explicit EditorClient(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace septet::editor
