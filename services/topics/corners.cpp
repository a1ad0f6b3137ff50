// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/corners.hpp"

#include "core/statistics/chi_square.hpp"

namespace quoin::topics {

void fill_corners(const FoundCorners& found, const std::string& covariance_mode,
                  msg::Corners& out) {
  out.covariance_mode(covariance_mode);
  out.corners().resize(found.corners.size());
  for (std::size_t i = 0; i < found.corners.size(); ++i) {
    const Corner& corner = found.corners[i];
    const CornerEstimate& estimate = corner.estimate;
    const Ellipse ellipse95 = ellipse(estimate.covariance, chi_square_2_95);
    msg::Corner& message = out.corners()[i];
    message.x(estimate.position.x());
    message.y(estimate.position.y());
    message.covariance_xx(estimate.covariance(0, 0));
    message.covariance_xy(estimate.covariance(0, 1));
    message.covariance_yy(estimate.covariance(1, 1));
    message.ellipse_area(one_sigma_ellipse_area(estimate.covariance));
    message.ellipse95_major(ellipse95.semi_major);
    message.ellipse95_minor(ellipse95.semi_minor);
    message.ellipse95_direction(ellipse95.direction);
    message.angle(corner.angle);
    message.opening(corner.opening);
    message.seen(corner.seen);
    message.gap(corner.gap);
    message.extrapolation(corner.extrapolation);
    message.first_line(static_cast<std::uint32_t>(corner.first_line));
    message.second_line(static_cast<std::uint32_t>(corner.second_line));
  }
  out.without().resize(found.without.size());
  for (std::size_t i = 0; i < found.without.size(); ++i) {
    const NoCorner& pair = found.without[i];
    out.without()[i].first_line(static_cast<std::uint32_t>(pair.first_line));
    out.without()[i].second_line(static_cast<std::uint32_t>(pair.second_line));
    out.without()[i].reason(std::string(enum_name(pair.reason)));
  }
}

}  // namespace quoin::topics
