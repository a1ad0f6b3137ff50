// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/compose.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "deploy/export/output_file.hpp"

namespace quoin::deploy {

namespace {

constexpr const char* deployment_folder = "/etc/quoin";  // in the containers

/// A string of YAML in quotes, in which Compose finds no variable.
std::string yaml_text(std::string_view text) {
  std::string inner;
  for (const char character : text) {
    if (static_cast<unsigned char>(character) < ' ' || character == 127) {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\x%02x", static_cast<unsigned char>(character));
      inner += code.data();
      continue;
    }
    if (character == '"' || character == '\\') inner += '\\';
    if (character == '$') inner += '$';
    inner += character;
  }
  return "\"" + inner + "\"";
}

std::string project_name(const ExportPlan& plan) {
  std::string name = plan.id;
  std::ranges::transform(name, name.begin(), [](char character) {
    return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a')
                                                : character;
  });
  return name;
}

std::string restart_policy(const ExportedProcess& process) {
  if (process.restart == RestartPolicy::never) return "\"no\"";
  return process.may_finish ? "on-failure" : "unless-stopped";
}

std::string device_lines(const ExportedProcess& process, const ComposeOptions& options) {
  if (!process.serial_port) return "";
  const std::string& port =
      *process.serial_port == "auto" ? options.serial_port : *process.serial_port;
  return "    devices:\n      - " + yaml_text(port + ":" + port) +
         "\n    group_add:\n      - dialout\n";
}

std::string service_lines(const ExportPlan& plan, const ExportedProcess& process,
                          const ComposeOptions& options) {
  const auto file = std::filesystem::path(deployment_folder) / plan.file.filename();
  std::string text = "  " + yaml_text(process.id) + ":\n";
  text += "    image: " + yaml_text(options.image) + "\n";
  text += "    command:\n";
  text += "      - " + yaml_text(process.program) + "\n";
  for (const std::string& argument : process.arguments(file)) {
    text += "      - " + yaml_text(argument) + "\n";
  }
  text +=
      "    network_mode: host\n"
      "    init: true\n"
      "    restart: " +
      restart_policy(process) +
      "\n"
      // Nobody, unless another one is to read the keys.
      "    user: \"${QUOIN_USER:-65534:65534}\"\n"
      "    read_only: true\n"
      "    cap_drop:\n      - ALL\n"
      "    security_opt:\n      - no-new-privileges:true\n"
      "    stop_signal: SIGTERM\n"
      "    stop_grace_period: 10s\n"
      "    volumes:\n"
      "      - type: bind\n"
      "        source: " +
      yaml_text(plan.file.parent_path().string()) + "\n        target: " + deployment_folder +
      "\n        read_only: true\n";
  if (plan.deployment->security) {
    const std::string keys =
        yaml_text(std::filesystem::absolute(plan.deployment->security->directory)
                      .lexically_normal()
                      .string());
    text += "      - type: bind\n        source: " + keys + "\n        target: " + keys +
            "\n        read_only: true\n";
  }
  text += device_lines(process, options);
  if (process.after.empty()) return text;
  text += "    depends_on:\n";
  for (const std::string& id : process.after) text += "      - " + yaml_text(id) + "\n";
  return text;
}

}  // namespace

std::string compose_file(const ExportPlan& plan, const ComposeOptions& options) {
  std::string text = std::string(export_marker) + "\n";
  text += "# The image is built by deploy/container/Dockerfile.\n";
  text += "name: " + yaml_text(project_name(plan)) + "\nservices:\n";
  for (const ExportedProcess& process : plan.processes) {
    text += service_lines(plan, process, options);
  }
  return text;
}

}  // namespace quoin::deploy
