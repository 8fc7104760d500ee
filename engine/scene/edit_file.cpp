#include "engine/scene/edit_file.hpp"

#include <cstdint>
#include <map>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/scene/difference.hpp"

namespace septet::scene {

Expected<void> apply_edits(Store& store, std::string_view text, std::string_view where) {
  const TextNames names{store, edit_file_ids};
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const auto place = [&](const Error& error) {
      return failure(printable(error.what), fmt::format("{}:{}", where, number), error.remedy);
    };
    const auto words = words_of(line);
    if (!words) return place(words.error());
    if (words->empty()) continue;
    const auto command = command_from_words(*words, names);
    if (!command) return place(command.error());
    if (auto done = store.apply(*command); !done) return place(done.error());
  }
  return {};
}

std::string edits_between(const Store& before, const Store& after) {
  std::map<NodeId, std::uint32_t> numbers;
  for (const auto& [id, node] : after.nodes())
    if (!before.find(id)) numbers.emplace(id, static_cast<std::uint32_t>(numbers.size()));
  const TextNames names{before, 0, &numbers};
  std::string text = "# What differs from the generated world.\n";
  describe_difference(before, after, [&](const Command& command) { text += to_text(command, names) + '\n'; });
  return text;
}

}  // namespace septet::scene
