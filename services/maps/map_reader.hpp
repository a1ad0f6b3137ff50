// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/mapping/line_map.hpp"
#include "services/maps/map_file.hpp"

namespace quoin::maps {

/// A map of any format, by the end of the file's name: .qmap, .svg, .dxf, or the .yaml of an
/// occupancy grid. `scale` [m] is the length of one unit of a drawing that does not name its own.
/// Lines of plans have no observations: they are walls from either side. Throws MapError, also when
/// there are no lines.
[[nodiscard]] SavedMap read_map(const std::filesystem::path& file, double scale);

/// The lines of these elements of an SVG: line, polyline, polygon, rect and path (M, L, H, V and Z,
/// in either case); curves are left out. y points down there and up here. An element with a
/// `transform` is an error: apply it first.
[[nodiscard]] std::vector<MapLine> parse_svg(std::string_view text, const std::string& file,
                                             double scale);

/// The LINE, LWPOLYLINE and POLYLINE entities of a text DXF, without those that are inserted from
/// blocks; bulges are chords. Its header's $INSUNITS is the unit, if it is there.
[[nodiscard]] std::vector<MapLine> parse_dxf(std::string_view text, const std::string& file,
                                             double scale);

}  // namespace quoin::maps
