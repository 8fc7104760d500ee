/// Puts a post into a running drive, where it can be hit, and saves what differs as a file of edits.
///
///     septet drive --scenario first-lesson --editors keys      # and in another terminal
///     edit_drive keys my.edits && septet drive --scenario first-lesson --edits my.edits
#include <chrono>

#include <fmt/core.h>

#include "engine/editor/editor_client.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return fmt::print(stderr, "usage: edit_drive KEYS FILE.edits\n"), 2;
  const auto now_s = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  const auto saved = septet::editor::EditorClient::connect(argv[1], now_s).and_then([&](const auto& editor) {
    const auto done = editor->take({"board mine/post 0.2 1.2 10 2 0.6", "solid mine/post"});
    return done ? editor->save(argv[2]) : tl::unexpected(done.error());
  });
  if (!saved) return fmt::print(stderr, "edit_drive: {}\n", describe(saved.error())), 1;
}
