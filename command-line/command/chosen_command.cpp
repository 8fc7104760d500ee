#include "command-line/command/chosen_command.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

namespace septet::server {
namespace fs = std::filesystem;

std::vector<std::string> command_of(const page::DriveChoice& choice, const OperateOptions& options,
                                    const fs::path& folder) {
  const bool has_keys = !options.keys.empty();
  std::vector<std::string> command{has_keys ? "septet-server" : "septet"};
  if (!has_keys) command.emplace_back("drive");
  // One word, since a value may begin with a hyphen.
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.push_back(fmt::format("--{}={}", option, value));
  };
  const auto add_about = [&](const std::string& key, const std::string& value) {
    if (!value.empty()) has_keys ? add("about", key + '=' + value) : add(key, value);
  };
  add("keys", options.keys.string());
  add("scenario", choice.scenario);
  add("rig", choice.rig.empty() ? options.rig : choice.rig);
  add("driver", choice.driver);
  add("vehicle", choice.vehicle);
  add("models", options.models.string());
  add("participant", choice.participant);
  add_about("group", choice.group);
  add_about("condition", choice.condition);
  add_about("order", choice.order);
  add_about("note", choice.note);
  add("seed", choice.seed);
  add("seconds", choice.seconds);
  for (const auto& [name, value] : choice.parameters) command.push_back(fmt::format("--parameter={}={}", name, value));
  if (choice.start_now) command.emplace_back("--start-now");
  add("out", folder.string());
  add("page", std::to_string(options.port));
  for (const auto& host : options.page_hosts) add("page-host", host);
  return command;
}

std::vector<std::string> command_of_experiment(const std::vector<std::string>& drive, const page::DriveChoice& choice,
                                               const OperateOptions& options) {
  const bool has_keys = !options.keys.empty();
  std::vector<std::string> command{has_keys ? "septet-server" : "septet"};
  if (!has_keys) command.emplace_back("drive");
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) command.push_back(fmt::format("--{}={}", option, value));
  };
  add("keys", options.keys.string());
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const std::string& word = drive[i];
    if (word.find('=') != std::string::npos || i + 1 == drive.size()) {  // "--parameter=NAME=VALUE".
      command.push_back(word);
      continue;
    }
    const std::string option = word.substr(2);
    const std::string& value = drive[++i];
    // A chosen rig is the local one; the other options have other names in septet-server.
    if (const std::string& rig = choice.rig.empty() ? options.rig : choice.rig; option == "rig" && !rig.empty())
      add("rig", rig);
    else if (has_keys && option == "log" && value == "samples")
      command.emplace_back("--log-samples-only");
    else if (has_keys && option == "log")
      continue;  // The whole log is its default.
    else if (has_keys && (option == "group" || option == "part" || option == "order" || option == "condition"))
      add("about", fmt::format("{}={}", option, value));
    else
      add(option, value);
  }
  add("models", options.models.string());
  if (choice.start_now) command.emplace_back("--start-now");
  add("page", std::to_string(options.port));
  for (const auto& host : options.page_hosts) add("page-host", host);
  return command;
}

std::string typed(const std::vector<std::string>& command) {
  std::string line;
  for (const std::string& word : command) {
    const bool is_plain = std::ranges::all_of(word, [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             std::string_view("-_=./:,+@%").find(c) != std::string_view::npos;
    });
    line += line.empty() ? "" : " ";
    if (is_plain && !word.empty()) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) c == '\'' ? line += "'\\''" : line += c;
    line += '\'';
  }
  return line;
}

}  // namespace septet::server
