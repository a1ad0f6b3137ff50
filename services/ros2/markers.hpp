// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Segments.h>
#include <span>
#include <string>

#include "core/mapping/line_map.hpp"
#include "services/ros2/messages.hpp"

namespace quoin::ros2 {

/// How the markers of a service look.
struct MarkerStyle {
  std::string ns;         ///< the service: viewers switch markers on and off by it
  std::size_t color = 0;  ///< number in a palette, which repeats
  double width = 0.03;    ///< [m] of lines and points
  double lifetime = 1.0;  ///< [s] after which a viewer takes them away; 0: never
};

// Each fills `out`, whose memory is reused, with markers whose ids stay the same from message to
// message, so that each message takes the place of the one before. Coordinates [m] are in the
// frame of the message.

/// Points of the segments, each segment in a color of its own, those of arcs and of no segment in
/// grey.
void fill_markers(const msg::Segments& in, const MarkerStyle& style, MarkerArray& out);
/// Lines from end point to end point.
void fill_markers(const msg::Lines& in, const MarkerStyle& style, MarkerArray& out);
/// Corners with their 95 % ellipses.
void fill_markers(const msg::Corners& in, const MarkerStyle& style, MarkerArray& out);
/// Circles, the arc that was seen wider than the rest.
void fill_markers(const msg::Circles& in, const MarkerStyle& style, MarkerArray& out);
/// The walls of a map.
void fill_markers(std::span<const MapLine> walls, const msg::Header& header,
                  const MarkerStyle& style, MarkerArray& out);

}  // namespace quoin::ros2
