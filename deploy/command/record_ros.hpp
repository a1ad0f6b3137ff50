// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "sensor_bridge/message_files/compression.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

struct RosRecordOptions {
  std::filesystem::path file;  ///< that does not exist yet
  sensor_bridge::Compression compression = sensor_bridge::Compression::zstd;
  double keep_free = 0.0;  ///< [MB]
  double duration = 0.0;   ///< [s] 0: no end
  bool json = false;
};

/// Records the topics of ROS 2 that anybody writes in the domain of the deployment, of the types
/// that Quoin knows, in an MCAP file as ROS 2 has them, until a signal or the duration ends it.
/// Returns an exit code. Throws mcap::WriteError.
[[nodiscard]] int record_ros(const Deployment& deployment, const RosRecordOptions& options);

}  // namespace quoin::deploy
