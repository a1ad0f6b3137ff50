// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/maps/map_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace quoin::maps {

namespace {

using Json = nlohmann::ordered_json;

/// [m] to the tenth of a millimetre.
std::string metres(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.4f", value == 0.0 ? 0.0 : value);
  return text.data();
}

Json position(const Eigen::Vector2d& point) { return Json::array({point.x(), point.y()}); }

}  // namespace

std::string svg_of(const SavedMap& map) {
  constexpr double margin = 0.5;  // [m]
  Eigen::Vector2d low(0.0, 0.0), high(1.0, 1.0);
  if (!map.lines.empty()) low = high = map.lines.front().start;
  for (const MapLine& line : map.lines) {
    low = low.cwiseMin(line.start).cwiseMin(line.end);
    high = high.cwiseMax(line.start).cwiseMax(line.end);
  }
  low.array() -= margin;
  high.array() += margin;
  const double size = std::max(high.x() - low.x(), high.y() - low.y());
  const double pixels = 1000.0 / size;
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                     metres(pixels * (high.x() - low.x())) + "\" height=\"" +
                     metres(pixels * (high.y() - low.y())) + "\" viewBox=\"" + metres(low.x()) +
                     " " + metres(-high.y()) + " " + metres(high.x() - low.x()) + " " +
                     metres(high.y() - low.y()) + "\">\n<rect class=\"background\" x=\"" +
                     metres(low.x()) + "\" y=\"" + metres(-high.y()) +
                     "\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
                     "<g stroke=\"#1f4e9e\" stroke-width=\"" +
                     metres(0.003 * size) + "\" stroke-linecap=\"round\">\n";
  for (const MapLine& line : map.lines) {
    text += "<line x1=\"" + metres(line.start.x()) + "\" y1=\"" + metres(-line.start.y()) +
            "\" x2=\"" + metres(line.end.x()) + "\" y2=\"" + metres(-line.end.y()) + "\"/>\n";
  }
  return text + "</g>\n</svg>\n";
}

std::string json_of(const SavedMap& map) {
  Json walls = Json::array();
  for (const MapLine& line : map.lines) {
    walls.push_back({{"id", line.id},
                     {"start", position(line.start)},
                     {"end", position(line.end)},
                     {"covariance_direction", line.covariance(0, 0)},
                     {"covariance_direction_offset", line.covariance(0, 1)},
                     {"covariance_offset", line.covariance(1, 1)},
                     {"observations", line.observations}});
  }
  return Json{{"frame", map.frame}, {"begun", map.begun}, {"method", map.method}, {"walls", walls}}
             .dump(2, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

std::string geojson_of(const SavedMap& map) {
  Json features = Json::array();
  for (const MapLine& line : map.lines) {
    features.push_back(
        {{"type", "Feature"},
         {"geometry",
          {{"type", "LineString"},
           {"coordinates", Json::array({position(line.start), position(line.end)})}}},
         {"properties", {{"id", line.id}, {"observations", line.observations}}}});
  }
  return Json{{"type", "FeatureCollection"},
              {"properties", {{"frame", map.frame}, {"unit", "m"}}},
              {"features", features}}
             .dump(1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

std::string dxf_of(const SavedMap& map) {
  std::string text =
      "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n"
      "0\nSECTION\n2\nENTITIES\n";
  for (const MapLine& line : map.lines) {
    text += "0\nLINE\n8\nWALLS\n10\n" + metres(line.start.x()) + "\n20\n" + metres(line.start.y()) +
            "\n30\n0.0\n11\n" + metres(line.end.x()) + "\n21\n" + metres(line.end.y()) +
            "\n31\n0.0\n";
  }
  return text + "0\nENDSEC\n0\nEOF\n";
}

}  // namespace quoin::maps
