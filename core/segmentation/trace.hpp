// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/parameters/parameter.hpp"

namespace quoin {

/// What became of a point: the last step of segmentation that took it from a wall, or none did.
enum class PointOutcome : std::uint8_t {
  segment,         ///< of a straight wall
  arc,             ///< of something round
  no_return,       ///< holds what the sensor writes where nothing came back
  foreign,         ///< stands alone, or in front of a surface that goes on behind it
  no_line,         ///< the method found no line through it
  too_few_points,  ///< of a piece with fewer than min_points
  off_line,        ///< its piece is no one wall, or it is not on it
  at_corner,       ///< left out beside a corner: noise decides on which wall it is
  piece_end,       ///< left out at the end of a segment
  too_short,       ///< of a piece shorter than min_length
  too_narrow,      ///< of a piece no longer than its tolerance is wide
  one_point,       ///< of a piece whose direction hangs on one point at an end
  too_bent,        ///< of a piece with a sagitta beyond max_bend
};

template <>
struct EnumNames<PointOutcome> {
  static constexpr std::array<std::pair<PointOutcome, std::string_view>, 13> names{
      {{PointOutcome::segment, "segment"},
       {PointOutcome::arc, "arc"},
       {PointOutcome::no_return, "no_return"},
       {PointOutcome::foreign, "foreign"},
       {PointOutcome::no_line, "no_line"},
       {PointOutcome::too_few_points, "too_few_points"},
       {PointOutcome::off_line, "off_line"},
       {PointOutcome::at_corner, "at_corner"},
       {PointOutcome::piece_end, "piece_end"},
       {PointOutcome::too_short, "too_short"},
       {PointOutcome::too_narrow, "too_narrow"},
       {PointOutcome::one_point, "one_point"},
       {PointOutcome::too_bent, "too_bent"}}};
};

/// Filled by a segmenter when a Segmentation asks for it.
struct SegmentationTrace {
  std::vector<PointOutcome> outcomes;   ///< by point of the scan, as it was given to the segmenter
  std::vector<std::uint32_t> surfaces;  ///< by point: number of the run between breaks; those that
                                        ///< were passed over have that of the point before them
};

}  // namespace quoin
