// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/definitions.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace quoin::ros2 {

namespace {

// As ROS 2 has had them since Humble.
constexpr std::array standard{
    Definition{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec"},
    Definition{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec"},
    Definition{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id"},
    Definition{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a"},
    Definition{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z"},
    Definition{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z"},
    Definition{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w"},
    Definition{"geometry_msgs/Pose", "Point position\nQuaternion orientation"},
    Definition{"geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance"},
    Definition{"geometry_msgs/PoseWithCovarianceStamped",
               "std_msgs/Header header\nPoseWithCovariance pose"},
    Definition{"geometry_msgs/Twist", "Vector3 linear\nVector3 angular"},
    Definition{"geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance"},
    Definition{"geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation"},
    Definition{"geometry_msgs/TransformStamped",
               "std_msgs/Header header\nstring child_frame_id\nTransform transform"},
    Definition{"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms"},
    Definition{"sensor_msgs/LaserScan",
               "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 "
               "angle_increment\nfloat32 time_increment\nfloat32 scan_time\nfloat32 "
               "range_min\nfloat32 range_max\nfloat32[] ranges\nfloat32[] intensities"},
    Definition{"sensor_msgs/CompressedImage",
               "std_msgs/Header header\nstring format\nuint8[] data"},
    Definition{"nav_msgs/Odometry",
               "std_msgs/Header header\nstring child_frame_id\n"
               "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist"},
    Definition{"nav_msgs/MapMetaData",
               "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 "
               "height\ngeometry_msgs/Pose origin"},
    Definition{"nav_msgs/OccupancyGrid", "std_msgs/Header header\nMapMetaData info\nint8[] data"},
    Definition{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v"},
    Definition{"visualization_msgs/MeshFile", "string filename\nuint8[] data"},
    Definition{"visualization_msgs/Marker",
               "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
               "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
               "builtin_interfaces/Duration lifetime\nbool frame_locked\n"
               "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\n"
               "string texture_resource\nsensor_msgs/CompressedImage texture\n"
               "UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n"
               "MeshFile mesh_file\nbool mesh_use_embedded_materials"},
    Definition{"visualization_msgs/MarkerArray", "Marker[] markers"},
    Definition{"diagnostic_msgs/KeyValue", "string key\nstring value"},
    Definition{"diagnostic_msgs/DiagnosticStatus",
               "byte level\nstring name\nstring message\nstring hardware_id\nKeyValue[] values"},
    Definition{"diagnostic_msgs/DiagnosticArray",
               "std_msgs/Header header\nDiagnosticStatus[] status"},
};

constexpr std::array basic{"bool",  "byte",   "char",  "float32", "float64", "int8",   "uint8",
                           "int16", "uint16", "int32", "uint32",  "int64",   "uint64", "string"};

const Definition* find(std::string_view type) {
  const auto row = std::ranges::find(standard, type, &Definition::type);
  if (row != standard.end()) return row;
  const auto own = own_definitions();
  const auto found = std::ranges::find(own, type, &Definition::type);
  return found == own.end() ? nullptr : &*found;
}

/// The fields of a type; the types of those that are none of the basic ones go to `needed`.
std::string fields_of(const Definition& definition, std::vector<std::string>& needed) {
  const std::string package(definition.type.substr(0, definition.type.find('/')));
  std::string fields;
  std::istringstream lines{std::string(definition.text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type, name;
    if (!(words >> type >> name) || name.find('=') != std::string::npos) continue;
    const std::size_t bracket = std::min(type.find('['), type.size());
    std::string element = type.substr(0, bracket);
    if (std::ranges::find(basic, element) == basic.end()) {
      if (element.find('/') == std::string::npos) element = package + "/" + element;
      if (std::ranges::find(needed, element) == needed.end()) needed.push_back(element);
    }
    fields += element + type.substr(bracket) + " " + name + "\n";
  }
  return fields;
}

}  // namespace

std::string definition(std::string_view type) {
  const std::string_view package = type.substr(0, type.find('/'));
  std::vector<std::string> needed{std::string(package) + "/" +
                                  std::string(type.substr(type.rfind('/') + 1))};
  std::string text;
  for (std::size_t i = 0; i < needed.size(); ++i) {  // which grows
    const std::string name = needed[i];
    const Definition* const found = find(name);
    if (found == nullptr) return "";
    if (i > 0) text += std::string(80, '=') + "\nMSG: " + name + "\n";
    text += fields_of(*found, needed);
  }
  return text;
}

}  // namespace quoin::ros2
