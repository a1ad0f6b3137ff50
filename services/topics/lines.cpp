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

void append_line(const LineEstimate& estimate, const PointsView& points, double chi_square,
                 std::uint32_t segment, msg::Lines& out) {
  const LineSegment ends = line_segment(estimate, points);
  const Line& line = estimate.line;
  msg::Line& message = out.lines().emplace_back();
  message.alpha(line.alpha);
  message.r(line.r);
  message.covariance_alpha(estimate.covariance(0, 0));
  message.covariance_alpha_r(estimate.covariance(0, 1));
  message.covariance_r(estimate.covariance(1, 1));
  message.start(point_message(ends.start));
  message.end(point_message(ends.end));
  message.points(static_cast<std::uint32_t>(points.size()));
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
    segment.estimate.covariance << line.covariance_alpha(), line.covariance_alpha_r(),
        line.covariance_alpha_r(), line.covariance_r();
    segment.start = {line.start().x(), line.start().y()};
    segment.end = {line.end().x(), line.end().y()};
    segment.points = line.points();
  }
}

}  // namespace quoin::topics
