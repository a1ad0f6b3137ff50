// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace quoin::deploy {

/// Where the scans of a first deployment come from.
enum class ScanSource { simulated, rplidar, ros2, recording };

/// What somebody who begins says of a deployment.
struct FirstDeployment {
  ScanSource source = ScanSource::simulated;
  std::string name_space = "robot";
  std::string serial_port = "auto";  ///< of an RPLIDAR: a device, or tcp:// or udp:// of its kit
  std::string scan_topic = "/scan";  ///< of ROS 2
  std::string odometry_topic = {};   ///< of ROS 2; "" for none
  std::string recording = {};        ///< file, or folder of files
  std::vector<std::string> fitters = {};  ///< methods of line_fitting; none: its default
  bool circles = false;
  bool map = false;
  bool page = false;
  bool recorder = false;
  bool ros2_output = false;
  std::vector<std::string> interfaces = {};  ///< of the network; none: this host alone
};

/// The deployment file with a comment where a choice or a figure of the user's own belongs. Of any
/// text that was given it makes valid YAML; whether names and methods are valid, parse_deployment
/// says. Throws std::invalid_argument for text with "${", which a deployment file would replace.
[[nodiscard]] std::string deployment_text(const FirstDeployment& first);

}  // namespace quoin::deploy
