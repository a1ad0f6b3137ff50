// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/lines.hpp"

#include <string>

namespace quoin::topics {

namespace {

msg::Point point_message(const Eigen::Vector2d& point) {
  msg::Point message;
  message.x(point.x());
  message.y(point.y());
  return message;
}

}  // namespace

void append_line(const LineSegment& line, double chi_square, std::uint32_t segment,
                 msg::Lines& out) {
  const LineEstimate& estimate = line.estimate;
  // What a paper prints is of first order.
  const bool first_order = out.covariance_mode() == enum_name(CovarianceMode::as_published);
  const Eigen::Matrix2d alpha_r =
      first_order ? estimate.about(0.0).covariance : estimate.alpha_r_covariance();
  msg::Line& message = out.lines().emplace_back();
  message.alpha(estimate.line.alpha);
  message.r(estimate.line.r);
  message.covariance_direction(estimate.covariance(0, 0));
  message.covariance_direction_offset(estimate.covariance(0, 1));
  message.covariance_offset(estimate.covariance(1, 1));
  message.covariance_alpha(alpha_r(0, 0));
  message.covariance_alpha_r(alpha_r(0, 1));
  message.covariance_r(alpha_r(1, 1));
  message.gaussian(estimate.is_gaussian_in_alpha_r());
  message.start(point_message(line.start));
  message.end(point_message(line.end));
  message.points(static_cast<std::uint32_t>(line.points));
  message.chi_square(chi_square);
  message.segment(segment);
}

void append_failure(FitFailure failure, std::uint32_t segment, msg::Lines& out) {
  msg::Failure& message = out.failures().emplace_back();
  message.segment(segment);
  message.reason(std::string(enum_name(failure)));
}

void line_segments(const msg::Lines& message, std::vector<LineSegment>& out) {
  out.clear();
  for (const msg::Line& line : message.lines()) {
    LineSegment& segment = out.emplace_back();
    segment.estimate.line = {line.alpha(), line.r()};
    segment.estimate.covariance << line.covariance_direction(), line.covariance_direction_offset(),
        line.covariance_direction_offset(), line.covariance_offset();
    segment.start = {line.start().x(), line.start().y()};
    segment.end = {line.end().x(), line.end().y()};
    const Eigen::Vector2d normal = segment.estimate.line.normal();
    const Eigen::Vector2d middle = 0.5 * (segment.start + segment.end);
    segment.estimate.along = normal.x() * middle.y() - normal.y() * middle.x();
    segment.points = line.points();
  }
}

}  // namespace quoin::topics
