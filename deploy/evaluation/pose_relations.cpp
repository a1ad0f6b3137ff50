// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/pose_relations.hpp"

#include <array>
#include <charconv>
#include <string_view>

#include "sensor_bridge/recordings/line_reader.hpp"

namespace quoin::deploy {

std::vector<PoseRelation> read_pose_relations(const std::filesystem::path& file, double offset) {
  sensor_bridge::LineReader lines(file);
  std::vector<PoseRelation> relations;
  std::string_view line;
  while (lines.next(line)) {
    std::array<double, 8> values{};
    const char* at = line.data();
    const char* const end = line.data() + line.size();
    const auto skip = [&] {
      while (at != end && (*at == ' ' || *at == '\t')) ++at;
    };
    skip();
    if (at == end || *at == '#') continue;
    for (double& value : values) {
      skip();
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc{} || !(value - value == 0.0)) {
        lines.fail(static_cast<std::size_t>(at - line.data()),
                   "a relation is eight numbers: t1 t2 x y z roll pitch yaw");
      }
      at = next;
    }
    relations.push_back(
        {values[0] - offset, values[1] - offset, {values[2], values[3], values[7]}});
  }
  return relations;
}

}  // namespace quoin::deploy
