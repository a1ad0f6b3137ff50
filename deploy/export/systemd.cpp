// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/systemd.hpp"

#include <chrono>

#include "deploy/export/output_file.hpp"
#include "deploy/export/systemd_text.hpp"

namespace quoin::deploy {

namespace {

std::string unit_name(const ExportPlan& plan, const std::string& id) {
  return plan.id + "-" + id + ".service";
}

std::string head(const ExportPlan& plan) {
  return std::string(export_marker) + "\n# Deployment: " + unit_comment(plan.file.string()) +
         "\n\n";
}

UnitFile target(const ExportPlan& plan) {
  std::string text = head(plan);
  text += "[Unit]\nDescription=Quoin deployment " + plan.deployment->name_space + "\n";
  for (const ExportedProcess& process : plan.processes) {
    text += "Wants=" + unit_name(plan, process.id) + "\n";
  }
  text += "\n[Install]\nWantedBy=multi-user.target\n";
  return {plan.id + ".target", text};
}

/// What `quoin up` does, as far as systemd can. Its pauses do not grow before version 254.
std::string restart_lines(const ExportPlan& plan, const ExportedProcess& process) {
  if (process.restart == RestartPolicy::never) return "Restart=no\n";
  // A source that has published everything is done.
  std::string text = process.may_finish ? "Restart=on-failure\n" : "Restart=always\n";
  const auto pause = process.runs_services() ? std::chrono::milliseconds(1000)
                                             : discovery_pause(plan.deployment->network);
  text += "RestartSec=" + std::to_string(pause.count()) + "ms\n";
  // 2: a wrong configuration, 3: an unusable input. But a device or an interface may come later.
  const bool may_come = process.serial_port || !plan.deployment->network.interfaces.empty();
  text += std::string("RestartPreventExitStatus=") + (may_come ? "3\n" : "2 3\n");
  return text;
}

std::string device_lines(const ExportedProcess& process) {
  if (!process.serial_port) return "PrivateDevices=yes\nPrivateUsers=yes\n";
  std::string text =
      "SupplementaryGroups=dialout\n"
      "PrivateDevices=no\n"
      "DeviceAllow=char-ttyUSB rw\n"
      "DeviceAllow=char-ttyACM rw\n";
  const std::string& port = *process.serial_port;
  const bool usb = port == "auto" || port.starts_with("/dev/ttyUSB") ||
                   port.starts_with("/dev/ttyACM") || port.starts_with("/dev/rplidar-");
  if (!usb && port.starts_with("/dev/")) text += "DeviceAllow=" + unit_word(port) + " rw\n";
  return text;
}

std::string network_lines(const ExportPlan& plan, const ExportedProcess& process) {
  // Netlink lists the interfaces, Unix sockets lead to systemd itself.
  std::string text = "RestrictAddressFamilies=AF_INET AF_UNIX AF_NETLINK";
  if (process.own_network) text += " AF_INET6";
  text += "\n";
  const bool loopback_only = plan.deployment->network.interfaces.empty() && !process.own_network;
  if (loopback_only) text += "IPAddressDeny=any\nIPAddressAllow=localhost\n";
  return text;
}

constexpr const char* hardening =
    "UMask=0077\n"
    "CapabilityBoundingSet=\n"
    "AmbientCapabilities=\n"
    "NoNewPrivileges=yes\n"
    "ProtectSystem=strict\n"
    "ProtectHome=yes\n"
    "PrivateTmp=yes\n"
    "PrivateMounts=yes\n"
    "ProtectProc=invisible\n"
    "ProcSubset=pid\n"
    "ProtectClock=yes\n"
    "ProtectControlGroups=yes\n"
    "ProtectHostname=yes\n"
    "ProtectKernelLogs=yes\n"
    "ProtectKernelModules=yes\n"
    "ProtectKernelTunables=yes\n"
    "LockPersonality=yes\n"
    "MemoryDenyWriteExecute=yes\n"
    "RestrictNamespaces=yes\n"
    "RestrictRealtime=yes\n"
    "RestrictSUIDSGID=yes\n"
    "SystemCallArchitectures=native\n"
    "SystemCallFilter=@system-service\n"
    "SystemCallFilter=~@privileged @resources\n"
    "SystemCallErrorNumber=EPERM\n"
    "DevicePolicy=closed\n";

UnitFile unit(const ExportPlan& plan, const ExportedProcess& process,
              const std::filesystem::path& programs) {
  std::string text = head(plan);
  text += "[Unit]\nDescription=Quoin " + plan.deployment->name_space + ": " + process.name + " (" +
          process.kind + ")\n";
  text += "PartOf=" + plan.id + ".target\n";
  if (!plan.deployment->network.interfaces.empty()) {
    text += "Wants=network-online.target\nAfter=network-online.target\n";
  }
  // Started behind those who read its output and stopped before them.
  for (const std::string& id : process.after) text += "After=" + unit_name(plan, id) + "\n";
  text += "StartLimitIntervalSec=0\n";

  text += std::string("\n[Service]\nType=") + (process.runs_services() ? "notify" : "exec") +
          "\nExecStart=" + unit_program((programs / process.program).string());
  for (const std::string& argument : process.arguments(plan.file)) {
    text += " " + unit_argument(argument);
  }
  text += "\n";
  text += "# For variables that the deployment file names.\nEnvironmentFile=-/etc/default/" +
          plan.id + "\n";
  text += restart_lines(plan, process);
  // A lookup of a device's host name alone may take ten seconds.
  if (process.runs_services()) {
    text += std::string("WatchdogSec=") + (process.own_network ? "30s\n" : "10s\n");
  }
  text += "TimeoutStartSec=30s\nTimeoutStopSec=10s\n\n";
  // Keys are for one user's eyes only, and a dynamic user has another number at each start.
  text += plan.deployment->security ? std::string("User=") + user_with_keys + "\n"
                                    : "DynamicUser=yes\n";
  text += hardening;
  text += device_lines(process);
  text += network_lines(plan, process);
  return {unit_name(plan, process.id), text};
}

}  // namespace

std::vector<UnitFile> systemd_units(const ExportPlan& plan, const std::filesystem::path& programs) {
  std::vector<UnitFile> units{target(plan)};
  for (const ExportedProcess& process : plan.processes) {
    units.push_back(unit(plan, process, programs));
  }
  return units;
}

}  // namespace quoin::deploy
