// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/circles.hpp"

#include <string>

namespace quoin::topics {

void append_circle(const CircleFit& fit, const PointsView& points, std::uint32_t arc,
                   msg::Circles& out) {
  if (!fit.ok()) {
    msg::NoCircle& message = out.failures().emplace_back();
    message.arc(arc);
    message.reason(std::string(enum_name(fit.failure)));
    return;
  }
  const Circle& circle = fit.estimate.circle;
  const Eigen::Matrix3d& covariance = fit.estimate.covariance;
  const Arc seen = seen_arc(circle, points);
  msg::Circle& message = out.circles().emplace_back();
  message.x(circle.center.x());
  message.y(circle.center.y());
  message.radius(circle.radius);
  message.covariance_xx(covariance(0, 0));
  message.covariance_xy(covariance(0, 1));
  message.covariance_yy(covariance(1, 1));
  message.covariance_x_radius(covariance(0, 2));
  message.covariance_y_radius(covariance(1, 2));
  message.covariance_radius(covariance(2, 2));
  message.arc_start(seen.start);
  message.arc_end(seen.end);
  message.concave(seen.concave);
  message.points(static_cast<std::uint32_t>(points.size()));
  message.chi_square(fit.chi_square);
  message.nonlinearity(fit.nonlinearity);
  message.arc(arc);
}

}  // namespace quoin::topics
