// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/world_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "core/parameters/parameter.hpp"
#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"
#include "services/files/regular_file.hpp"

namespace quoin::sensor_bridge {
namespace {

constexpr std::uintmax_t max_file_size = 16U << 20U;  // [byte]

/// Builds a World from nodes; every error has the node's position.
class WorldParser {
 public:
  explicit WorldParser(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] World world(const YAML::Node& root) const {
    expect_keys(root, "a world", {"name", "description", "walls", "pillars", "path"});
    World world;
    world.name =
        root["name"] ? text(root["name"], "name") : std::filesystem::path(file_).stem().string();
    if (root["description"]) world.description = text(root["description"], "description");
    if (root["walls"]) {
      for (const YAML::Node& wall : list(root["walls"], "walls")) add_wall(world, wall);
    }
    if (root["pillars"]) {
      for (const YAML::Node& node : list(root["pillars"], "pillars")) {
        world.pillars.push_back(pillar(node));
      }
    }
    if (world.walls.empty() && world.pillars.empty()) {
      fail(root, "the world has neither walls nor pillars; add a 'walls' or a 'pillars' list");
    }
    for (const YAML::Node& node : list(required(root, "path", "a world"), "path")) {
      const std::vector<double> values = numbers(node, "way point", "[x, y, theta]", 3);
      world.path.push_back({values[0], values[1], values[2]});
    }
    if (world.path.empty())
      fail(root["path"], "the path is empty; give at least one [x, y, theta]");
    return world;
  }

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    // An empty document has no position of its own: its marks are -1.
    throw WorldError(file_ + ":" + std::to_string(std::max(mark.line, 0) + 1) + ":" +
                     std::to_string(std::max(mark.column, 0) + 1) + ": " + what);
  }

 private:
  [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const {
    fail(node.Mark(), what);
  }

  void expect_keys(const YAML::Node& node, const std::string& what,
                   const std::vector<std::string>& known) const {
    if (!node.IsMap()) fail(node, what + " is a mapping with the keys " + joined(known));
    // The parser keeps both of two equal keys and looks up the first: a silent loss.
    std::vector<std::string> seen;
    for (const auto& entry : node) {
      const std::string key = text(entry.first, "key");
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        fail(entry.first, "unknown key " + excerpt(key) + " in " + what + suggestion(key, known));
      }
      if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
        fail(entry.first, "key '" + key + "' is there twice in " + what + "; remove one");
      }
      seen.push_back(key);
    }
  }

  [[nodiscard]] YAML::Node required(const YAML::Node& node, const std::string& key,
                                    const std::string& what) const {
    const YAML::Node value = node[key];
    if (!value) fail(node, what + " needs the key '" + key + "'");
    return value;
  }

  [[nodiscard]] std::string text(const YAML::Node& node, const std::string& what) const {
    if (!node.IsScalar()) fail(node, "'" + what + "' must be a text");
    return node.Scalar();
  }

  [[nodiscard]] YAML::Node list(const YAML::Node& node, const std::string& what) const {
    if (!node.IsSequence()) fail(node, "'" + what + "' must be a list");
    return node;
  }

  [[nodiscard]] double number(const YAML::Node& node) const {
    if (!node.IsScalar()) fail(node, "a number is expected here");
    const std::optional<double> value = parse_number<double>(node.Scalar());
    if (!value || !std::isfinite(*value)) {
      fail(node, excerpt(node.Scalar()) + " is not a finite number");
    }
    return *value;
  }

  [[nodiscard]] std::vector<double> numbers(const YAML::Node& node, const std::string& what,
                                            const std::string& form, std::size_t count) const {
    if (!node.IsSequence() || node.size() != count) fail(node, "a " + what + " is written " + form);
    std::vector<double> values;
    for (const YAML::Node& value : node) values.push_back(number(value));
    return values;
  }

  void add_wall(World& world, const YAML::Node& node) const {
    expect_keys(node, "a wall", {"points", "closed"});
    bool closed = false;
    if (node["closed"] && !YAML::convert<bool>::decode(node["closed"], closed)) {
      fail(node["closed"], "'closed' must be true or false");
    }
    const YAML::Node list_node = list(required(node, "points", "a wall"), "points");
    const std::size_t needed = closed ? 3 : 2;
    if (list_node.size() < needed) {
      fail(list_node, std::string(closed ? "a closed wall" : "a wall") + " needs at least " +
                          std::to_string(needed) + " points");
    }
    std::vector<Eigen::Vector2d> points;
    for (const YAML::Node& point_node : list_node) {
      const std::vector<double> values = numbers(point_node, "point", "[x, y]", 2);
      points.emplace_back(values[0], values[1]);
      // A wall without length has no direction, and would count as a wall that ends at a corner.
      if (points.size() > 1 && points[points.size() - 2] == points.back()) {
        fail(point_node, "this point repeats the one before it; remove one");
      }
    }
    if (closed && points.front() == points.back()) {
      fail(list_node, "a closed wall must not repeat its first point at the end; remove the last");
    }
    world.add_polyline(points, closed);
  }

  [[nodiscard]] Pillar pillar(const YAML::Node& node) const {
    expect_keys(node, "a pillar", {"center", "radius"});
    const std::vector<double> center =
        numbers(required(node, "center", "a pillar"), "center", "[x, y]", 2);
    const YAML::Node radius_node = required(node, "radius", "a pillar");
    const double radius = number(radius_node);
    if (radius <= 0.0) fail(radius_node, "the radius of a pillar must be positive");
    return {{center[0], center[1]}, radius};
  }

  [[nodiscard]] static std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  std::string file_;
};

World read_world(const std::filesystem::path& file) {
  std::string text;
  const std::string problem = read_regular(file, max_file_size, text);
  if (text.size() > max_file_size) {
    throw WorldError("world file '" + file.string() +
                     "' is larger than 16 MiB; is it the right one?");
  }
  if (!problem.empty()) {
    throw WorldError("cannot read world file '" + file.string() + "': " + problem);
  }
  return parse_world(text, file);
}

}  // namespace

World parse_world(const std::string& text, const std::filesystem::path& file) {
  const WorldParser parser(file.string());
  try {
    return parser.world(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    parser.fail(error.mark, error.msg);
  }
}

World load_world(const std::string& environment, const std::filesystem::path& base_directory) {
  if (std::optional<World> world = built_in_world(environment)) return *std::move(world);
  const std::filesystem::path file = base_directory / environment;
  const bool meant_as_path = environment.find('/') != std::string::npos ||
                             file.extension() == ".yaml" || file.extension() == ".yml";
  if (meant_as_path) return read_world(file);

  std::string known;
  for (const std::string& name : world_names()) known += (known.empty() ? "" : ", ") + name;
  const std::string near = nearest_name(environment, world_names());
  throw WorldError("unknown environment '" + environment + "'; " +
                   (near.empty() ? "" : "did you mean '" + near + "'? ") + "(built in are " +
                   known + "; a world of your own is the path of a .yaml file)");
}

}  // namespace quoin::sensor_bridge
