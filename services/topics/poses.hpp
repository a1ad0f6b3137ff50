// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <idl/Pose.h>

#include "core/mapping/localizer.hpp"
#include "core/mapping/motion.hpp"

namespace quoin::topics {

[[nodiscard]] msg::PoseEstimate pose_message(const PoseEstimate& estimate);
[[nodiscard]] PoseEstimate pose_estimate(const msg::PoseEstimate& message);

/// Whether the pose is finite and its covariance one; any program may have sent it.
[[nodiscard]] bool valid(const msg::PoseEstimate& message);

/// Status, weak direction and number of lines; pose and frames are the caller's.
void fill_status(const Localization& result, std::size_t lines, bool odometry, msg::Pose& out);

}  // namespace quoin::topics
