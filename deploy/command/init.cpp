// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "core/text/printable.hpp"
#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/starter/first_deployment.hpp"
#include "services/files/atomic_file.hpp"

namespace quoin::deploy {

namespace {

const std::map<std::string, ScanSource> source_names{{"simulated", ScanSource::simulated},
                                                     {"rplidar", ScanSource::rplidar},
                                                     {"ros2", ScanSource::ros2},
                                                     {"recording", ScanSource::recording}};

const std::map<std::string, bool FirstDeployment::*> additions{
    {"circles", &FirstDeployment::circles},
    {"map", &FirstDeployment::map},
    {"page", &FirstDeployment::page},
    {"recorder", &FirstDeployment::recorder},
    {"ros2", &FirstDeployment::ros2_output}};

struct InitOptions {
  std::string file = "robot.yaml";
  std::string source;
  FirstDeployment first;
  std::vector<std::string> additions;
  bool force = false;
};

/// Asks until the answer is one of `choices`, or anything where there are none; an empty answer is
/// `usual`. Throws std::runtime_error at the end of the input.
std::string ask(const std::string& question, const std::vector<std::string>& choices,
                const std::string& usual) {
  while (true) {
    std::cerr << question << " [" << usual << "] " << std::flush;
    std::string answer;
    if (!std::getline(std::cin, answer)) throw std::runtime_error("no answer; nothing is written");
    if (answer.empty()) return usual;
    if (choices.empty()) return answer;
    for (const std::string& choice : choices) {
      if (choice.starts_with(answer)) return choice;
    }
    std::cerr << "  '" << printable(answer) << "' is none of these\n";
  }
}

bool ask_yes(const std::string& question) { return ask(question, {"yes", "no"}, "no") == "yes"; }

void ask_all(InitOptions& options) {
  FirstDeployment& first = options.first;
  options.source = ask("Where do scans come from: simulated, rplidar, ros2 or recording?",
                       {"simulated", "rplidar", "ros2", "recording"}, "simulated");
  first.source = source_names.at(options.source);
  if (first.source == ScanSource::rplidar) {
    first.serial_port =
        ask("Serial port, or tcp:// or udp:// of a network kit?", {}, first.serial_port);
  } else if (first.source == ScanSource::ros2) {
    first.scan_topic = ask("Topic of sensor_msgs/LaserScan?", {}, first.scan_topic);
  } else if (first.source == ScanSource::recording) {
    while (first.recording.empty()) first.recording = ask("File, or folder of files?", {}, "");
  }
  first.name_space = ask("Name of the robot, the prefix of all topics?", {}, first.name_space);
  first.map = ask_yes("A map and a pose in it?");
  first.page = ask_yes("A page that shows it live?");
  first.recorder = ask_yes("A recording of each run?");
  first.ros2_output = ask_yes("Lines and corners to ROS 2?");
}

/// Throws std::invalid_argument for an option that belongs to another source, which would be
/// without effect.
void check_options(const CLI::App& line, const InitOptions& options) {
  const auto belongs = [&](const char* option, std::string_view source) {
    if (line.count(option) > 0 && options.source != source) {
      throw std::invalid_argument(std::string(option) + " is for --source " + std::string(source));
    }
  };
  belongs("--port", "rplidar");
  belongs("--topic", "ros2");
  belongs("--odometry", "ros2");
  belongs("--recording", "recording");
  if (options.first.source == ScanSource::recording && options.first.recording.empty()) {
    throw std::invalid_argument("--source recording needs --recording FILE");
  }
}

/// A path, given from here, from the folder of a deployment file.
std::string seen_from(const std::filesystem::path& file, const std::filesystem::path& path) {
  const std::filesystem::path folder =
      file == "-" ? std::filesystem::current_path() : std::filesystem::absolute(file).parent_path();
  return path.is_absolute() ? path : std::filesystem::absolute(path).lexically_proximate(folder);
}

int run(const CLI::App& line, InitOptions options) {
  const bool asks = line.count_all() == line.count("file") + 1 && isatty(STDIN_FILENO) == 1;
  std::string text;
  try {
    if (asks) {
      ask_all(options);
    } else {
      if (options.source.empty()) {
        options.source = options.first.recording.empty() ? "simulated" : "recording";
      }
      options.first.source = source_names.at(options.source);
      for (const std::string& name : options.additions) options.first.*additions.at(name) = true;
      check_options(line, options);
    }
    if (!options.first.recording.empty()) {
      options.first.recording = seen_from(options.file, options.first.recording);
    }
    text = deployment_text(options.first);
  } catch (const std::invalid_argument& error) {
    std::cerr << "quoin init: " << printable(error.what()) << '\n';
    return exit_configuration;
  }
  // What it would complain about is not written.
  const Deployment deployment = parse_deployment(text, options.file);
  if (options.file == "-") {
    std::cout << text;
    return exit_ok;
  }
  if (const int error = write_atomically(options.file, text, 0644, options.force)) {
    std::cerr << "quoin init: " << printable(options.file) << ": "
              << (error == EEXIST ? "is there already; --force replaces it"
                                  : std::generic_category().message(error))
              << '\n';
    return exit_failure;
  }
  const std::string file = printable(options.file);
  std::cout << file << ": " << deployment.services.size() << " services\n"
            << "  quoin up " << file << "       runs it until Ctrl-C\n"
            << "  quoin status " << file << "   says how it is, from another terminal\n"
            << "  quoin doctor " << file << "   finds what keeps it from working\n";
  return exit_ok;
}

}  // namespace

Command add_init(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "init", "Write a first deployment file with comments; without options it asks");
  const auto options = std::make_shared<InitOptions>();
  line->add_option("file", options->file, "File to write; - is the standard output")
      ->capture_default_str();
  line->add_option("--source", options->source, "Where scans come from")
      ->check(CLI::IsMember({"simulated", "rplidar", "ros2", "recording"}));
  line->add_option("--port", options->first.serial_port,
                   "Of an RPLIDAR: a serial device, auto, tcp://HOST or udp://HOST");
  line->add_option("--topic", options->first.scan_topic, "Of ROS 2: sensor_msgs/LaserScan");
  line->add_option("--odometry", options->first.odometry_topic, "Of ROS 2: nav_msgs/Odometry");
  line->add_option("--recording", options->first.recording, "File, or folder of scan files");
  line->add_option("--namespace", options->first.name_space, "Prefix of all topics")
      ->capture_default_str();
  line->add_option("--fitter", options->first.fitters,
                   "Methods of line fitting, side by side (quoin methods line_fitting)")
      ->delimiter(',');
  line->add_option("--add", options->additions, "What else: circles, map, page, recorder, ros2")
      ->delimiter(',')
      ->check(CLI::IsMember(additions));
  line->add_option("--interface", options->first.interfaces,
                   "Interfaces of the robot's network; without one, this host alone")
      ->delimiter(',');
  line->add_flag("--force", options->force, "Replace a file that is there");
  return {line, [line, options] { return run(*line, *options); }};
}

}  // namespace quoin::deploy
