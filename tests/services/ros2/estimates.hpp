// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Pose.h>

namespace quoin::tests {

/// With a covariance of which no two entries are the same.
inline msg::PoseEstimate estimate(double x, double y, double theta) {
  msg::PoseEstimate made;
  made.x(x);
  made.y(y);
  made.theta(theta);
  made.covariance_xx(0.01);
  made.covariance_xy(0.002);
  made.covariance_yy(0.03);
  made.covariance_x_theta(0.004);
  made.covariance_y_theta(-0.005);
  made.covariance_theta(0.06);
  return made;
}

}  // namespace quoin::tests
