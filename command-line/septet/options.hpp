#pragma once
/// The commands of `septet` with their options.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "command-line/command/check_command.hpp"
#include "command-line/command/drive_command.hpp"
#include "command-line/command/edit_command.hpp"
#include "command-line/command/experiment_command.hpp"
#include "command-line/command/operate_command.hpp"
#include "command-line/command/report_command.hpp"
#include "command-line/command/rig_command.hpp"
#include "command-line/command/session_command.hpp"
#include "command-line/command/session_participants.hpp"
#include "command-line/command/traffic_command.hpp"
#include "command-line/command/vehicle_command.hpp"
#include "command-line/command/what_if_command.hpp"
#include "engine/core/expected.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace septet::server {

/// Parsed command line. The parser holds pointers into it, so it must not move.
struct Options {
  DriveOptions drive, replay;
  bool verify = false;
  std::vector<std::string> passed_on;  ///< Arguments for septet-film, septet-sound, septet-sight or septet-ice.
  ReportOptions report;
  VehicleTestOptions track;
  double track_speed_kmh = 0.0;
  TrafficDiagramOptions diagram;
  std::string road_file, kind;
  RigKeysOptions rig_keys;
  EditOptions edit;
  std::vector<std::filesystem::path> list_data;  ///< User folders, of list.
  CheckOptions check;
  ParticipantsOptions participants;
  WhatIfCommandOptions what_if;
  AnswerOptions answer;
  StopOptions stop;
  ForgetOptions forget;
  ExperimentOptions experiment;
  OperateOptions operate;
  std::function<Expected<int>()> work;  ///< Work of the chosen command.
};

/// --data, of the commands that choose among rigs, scenarios and experiments.
void add_data_option(CLI::App& command, std::vector<std::filesystem::path>& data);
void add_drive_commands(CLI::App& app,
                        Options& options);  ///< drive, operate, replay, film, accident, sight, …, report.
void add_track_commands(CLI::App& app, Options& options);       ///< vehicle, traffic.
void add_session_commands(CLI::App& app, Options& options);     ///< session, what-if.
void add_experiment_commands(CLI::App& app, Options& options);  ///< experiment.
void add_file_commands(CLI::App& app, Options& options);        ///< road, rig, edit, list, devices, check.

}  // namespace septet::server
