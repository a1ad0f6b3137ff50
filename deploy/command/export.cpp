// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "deploy/command/commands.hpp"
#include "deploy/export/compose.hpp"
#include "deploy/export/export_plan.hpp"
#include "deploy/export/output_file.hpp"
#include "deploy/export/systemd.hpp"
#include "deploy/export/visibility.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/host.hpp"
#include "deploy/orchestration/launch.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {

struct ExportOptions {
  std::string file;
  std::string host;
  std::string output;
  std::string programs;  // "": beside quoin
  ComposeOptions compose;
  bool force = false;
};

/// False, and says so, when one of `files` is somebody else's.
bool may_write(const std::vector<std::filesystem::path>& files, bool force) {
  bool all = true;
  for (const std::filesystem::path& file : files) {
    if (force || may_replace(file)) continue;
    std::cerr << file.string() << " was not written by quoin export; --force replaces it\n";
    all = false;
  }
  return all;
}

/// Writes nothing unless all can be written.
bool write_all(const std::filesystem::path& folder, const std::vector<UnitFile>& units,
               bool force) {
  std::vector<std::filesystem::path> files;
  for (const UnitFile& unit : units) files.push_back(folder / unit.name);
  if (!may_write(files, force)) return false;
  std::filesystem::create_directories(folder);
  for (const UnitFile& unit : units) {
    write_whole(folder / unit.name, unit.text);
    std::cout << (folder / unit.name).string() << '\n';
  }
  return true;
}

/// Units that earlier exports of this deployment left for services that it no longer has.
void tell_of_remains(const std::filesystem::path& folder, const std::string& stem,
                     const std::vector<UnitFile>& units) {
  std::set<std::string> names;
  for (const UnitFile& unit : units) names.insert(unit.name);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(stem + "-") || !name.ends_with(".service") || names.contains(name) ||
        !may_replace(entry.path()))
      continue;
    std::cerr << entry.path().string() << " is of no service of this deployment; remove it\n";
  }
}

/// Addresses say where discovery servers run: they are exported on their hosts.
bool serves_here(const Deployment& deployment) {
  if (deployment.network.discovery != Discovery::server) return false;
  try {
    if (serves_discovery(deployment)) return true;
  } catch (const std::runtime_error&) {
    // This machine has none of the deployment's interfaces.
  }
  std::cerr << "this machine has the address of no discovery server; export on those that do\n";
  return false;
}

ExportPlan plan_of(const Deployment& deployment, const ExportOptions& options) {
  return plan_export(deployment, host_to_run(deployment, options.host), serves_here(deployment));
}

int export_systemd(const ExportOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  const ExportPlan plan = plan_of(deployment, options);
  const std::filesystem::path programs =
      options.programs.empty() ? program_folder() : std::filesystem::path(options.programs);
  std::vector<UnitFile> units;
  try {
    units = systemd_units(plan, programs);
  } catch (const std::invalid_argument& error) {
    std::cerr << "quoin export: " << error.what() << '\n';
    return exit_configuration;
  }
  if (!write_all(options.output, units, options.force)) return exit_failure;
  tell_of_remains(options.output, plan.id, units);

  std::set<std::string> obstacles{obstacle_to_others(plan.file, false)};
  for (const ExportedProcess& process : plan.processes) {
    obstacles.insert(obstacle_to_others(programs / process.program, true));
  }
  obstacles.erase("");
  for (const std::string& obstacle : obstacles) {
    std::cerr << "the units cannot start like this: " << obstacle
              << "; install below /usr/local and /etc, for instance\n";
  }
  if (deployment.security) {
    std::cerr << "keys are read by one user only: useradd --system " << user_with_keys
              << ", and chown -R " << user_with_keys << " "
              << deployment.security->directory.string() << '\n';
  }
  std::cerr << "to start: copy them to /etc/systemd/system, systemctl daemon-reload, systemctl "
               "enable --now "
            << units.front().name << '\n';
  return exit_ok;
}

int export_compose(const ExportOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  const ExportPlan plan = plan_of(deployment, options);
  if (!may_write({options.output}, options.force)) return exit_failure;
  write_whole(options.output, compose_file(plan, options.compose));
  std::cout << options.output << '\n';
  for (const ExportedProcess& process : plan.processes) {
    if (process.serial_port != "auto") continue;
    std::cerr << "service '" << process.name << "' finds its serial port by itself; its container"
              << " is given " << options.compose.serial_port << " (--serial-port)\n";
  }
  if (deployment.security) {
    std::cerr
        << "keys are read by one user only: QUOIN_USER=UID:GID is whom the containers run as\n";
  }
  std::cerr << "to start: docker compose -f " << options.output << " up --detach\n";
  return exit_ok;
}

CLI::Option* add_common(CLI::App& line, ExportOptions& options, const std::string& what) {
  line.add_option("file", options.file, "Deployment file (YAML)")->required();
  line.add_option("--host", options.host, "Export the share of this host");
  line.add_flag("--force", options.force, "Replace files that were not exported before");
  return line.add_option("-o,--output", options.output, what)->required();
}

}  // namespace

Command add_export(CLI::App& app) {
  CLI::App* line = app.add_subcommand("export", "Write what other supervisors need to run it");
  line->require_subcommand(1);
  const auto options = std::make_shared<ExportOptions>();
  options->compose.image = "quoin:" QUOIN_VERSION;
  CLI::App* systemd =
      line->add_subcommand("systemd", "A hardened unit for each service, and a target for all");
  add_common(*systemd, *options, "Folder to write the units into");
  systemd
      ->add_option("--programs", options->programs,
                   "Folder of the services' programs; else where quoin is")
      ->check([](const std::string& text) {
        return text.starts_with('/') ? "" : "'" + text + "' is no absolute path";
      });
  CLI::App* compose = line->add_subcommand("compose", "A Compose file, a container for each");
  add_common(*compose, *options, "Compose file to write");
  compose->add_option("--image", options->compose.image, "Image of the containers")
      ->capture_default_str();
  compose
      ->add_option("--serial-port", options->compose.serial_port,
                   "Device for the services that find theirs by themselves")
      ->capture_default_str();
  return {line,
          [=] { return systemd->parsed() ? export_systemd(*options) : export_compose(*options); }};
}

}  // namespace quoin::deploy
