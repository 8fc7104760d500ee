#include <iostream>

#include "car-io/devices/device_list.hpp"
#include "command-line/command/list_command.hpp"
#include "command-line/command/rig_command.hpp"
#include "command-line/command/road_command.hpp"
#include "command-line/septet/options.hpp"
#include "program/command_line.hpp"
#include "program/confinement.hpp"

namespace septet::server {

void add_data_option(CLI::App& command, std::vector<std::filesystem::path>& data) {
  command
      .add_option("--data", data,
                  "Folder of rigs, vehicles, scenarios and experiments of your own, beside the one that you stand in; "
                  "as often as needed")
      ->type_name("FOLDER")
      ->default_str("")
      ->allow_extra_args(false);
}

void add_file_commands(CLI::App& app, Options& options) {
  auto* road_command = app.add_subcommand("road", "Questions to a road file");
  road_command->require_subcommand(1);
  auto* sample = road_command->add_subcommand("sample", "Lines road_id,lane_id,s_m,lane_offset_m in, poses out");
  sample->add_option("file", options.road_file, "OpenDRIVE file")->required();
  sample->callback([&] { options.work = [&] { return run_road_sample(options.road_file, std::cin, std::cout); }; });
  auto* locate = road_command->add_subcommand("locate", "Lines x_m,y_m in, road positions out");
  locate->add_option("file", options.road_file, "OpenDRIVE file")->required();
  locate->callback([&] { options.work = [&] { return run_road_locate(options.road_file, std::cin, std::cout); }; });

  auto* rig_command = app.add_subcommand("rig", "Preparation of a rig of several machines");
  rig_command->require_subcommand(1);
  auto* rig_keys =
      rig_command->add_subcommand("keys", "Make the keys of a rig's machines, one folder for each (rigs/EIGHT-PCS.md)");
  RigKeysOptions& keys = options.rig_keys;
  rig_keys->add_option("rig", keys.rig, "Rig: a file or a name")->required();
  rig_keys->add_option("--out", keys.out, "Parent of these folders; existing keys stay")->capture_default_str();
  rig_keys
      ->add_option(
          "--editor", keys.editors,
          "A client that edits the world, or looks: its name, and its rights (look, or edit PREFIX/… hide move "
          "paint create); as often as needed")
      ->type_name("NAME[=RIGHTS]")
      ->default_str("none")
      ->allow_extra_args(false);
  rig_keys->callback([&] { options.work = [&] { return run_rig_keys(options.rig_keys); }; });

  auto* edit_command = app.add_subcommand("edit", "Change the world of a running drive (docs/editing.md)");
  EditOptions& edit = options.edit;
  edit_command->add_option("files", edit.files, "Files of lines; without one the lines of standard input");
  edit_command
      ->add_option("--keys", edit.keys, "Folder that septet drive --editors, or septet rig keys --editor, wrote")
      ->required();
  edit_command->add_option("--key", edit.key, "Name of the key in that folder")->default_str("the only one");
  edit_command->add_option("--server", edit.server, "Server's address and port")->default_str("as in that folder");
  edit_command->add_flag("--json", edit.json, "For programs: one JSON object a line, and ticks");
  edit_command->callback([&] { options.work = [&] { return run_edit(options.edit); }; });

  auto* list_command = app.add_subcommand("list", "List available names, one per line");
  list_command->add_option("kind", options.kind, "Kind of names")->required()->check(CLI::IsMember(listed_kinds()));
  add_data_option(*list_command, options.list_data);
  list_command->callback([&] { options.work = [&] { return run_list(options.kind, options.list_data); }; });

  auto* devices_command = app.add_subcommand(
      "devices", "List connected devices that a rig may use, and remedies for those that cannot be opened");
  devices_command->callback([&] {
    options.work = []() -> Expected<int> {
      std::cout << car_io::device_table(car_io::list_devices("/sys", "/dev")) << std::flush;
      return 0;
    };
  });

  auto* check_command = app.add_subcommand("check", "Say what is wrong with files; exit status 1: a file has an error");
  check_command
      ->add_option(
          "files", options.check.files,
          "Roads (.xodr), scenarios and catalogs (.xosc), rigs, vehicles and film scripts (.toml), models (.glb), "
          "sessions (.sqlite)")
      ->required();
  check_command->add_flag("--json", options.check.json, "Answer in JSON (docs/check.md)");
  check_command->add_flag("--strict", options.check.strict, "Warnings count as errors in the exit status");
  check_command->callback([&] {
    options.work = [&]() -> Expected<int> {
      program::write_only_below({});
      return run_check(options.check, std::cout);
    };
  });
}

}  // namespace septet::server
