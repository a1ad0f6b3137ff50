// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "services/maps/map_file.hpp"

namespace quoin::maps {

/// A drawing to scale, one unit a metre and y pointing down as SVG has it; parse_svg reads it back.
[[nodiscard]] std::string svg_of(const SavedMap& map);
/// Frame and walls, with covariances and observations.
[[nodiscard]] std::string json_of(const SavedMap& map);
/// A FeatureCollection of LineStrings. Coordinates are metres in the frame of the map, for no map
/// of a building knows where on Earth it is.
[[nodiscard]] std::string geojson_of(const SavedMap& map);
/// A text DXF (R12) of LINE entities on the layer WALLS, in metres.
[[nodiscard]] std::string dxf_of(const SavedMap& map);

}  // namespace quoin::maps
