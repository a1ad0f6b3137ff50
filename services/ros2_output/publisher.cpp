// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2_output/publisher.hpp"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "services/deployment/graph.hpp"
#include "services/ros2/markers.hpp"
#include "services/ros2/occupancy_grid.hpp"
#include "services/ros2/poses.hpp"
#include "services/ros2/scan_export.hpp"
#include "services/ros2_output/publication.hpp"
#include "services/topics/line_map.hpp"

namespace quoin {

using topics::RawMessage;

namespace {

Pose2 pose_of(const msg::PoseEstimate& estimate) {
  return {estimate.x(), estimate.y(), estimate.theta()};
}

}  // namespace

/// What becomes of the messages of an observed topic; false when the bytes are none of its type.
using Handler = std::function<bool(const RawMessage&)>;

struct Ros2Publisher::Impl {
  Impl(runtime::Participant& participant_of_all, const Ros2OutputParameters& parameters_of_all,
       const std::string& name_space, std::string own_label)
      : participant(participant_of_all),
        owner(std::move(own_label)),
        parameters(parameters_of_all),
        prefix("/" + (parameters.prefix.empty() ? name_space : parameters.prefix)) {}

  void add(const Connection& input, std::size_t number);
  void add_scan(const std::string& topic, const std::string& service);
  template <class T>
  void add_markers(const std::string& topic, const ros2::MarkerStyle& style);
  void add_pose(const std::string& topic, const std::string& service);
  void add_odometry(const std::string& topic, const std::string& service);
  void add_map(const std::string& topic, const std::string& service, ros2::MarkerStyle style);
  void add_numbers(const std::string& topic, const std::string& service, const std::string& type);
  void publish_mounting(const msg::Header& header);
  void publish_from_map(ros2::TransformStamped transform);
  void publish_transform(const ros2::TransformStamped& transform);

  template <class T>
  TypedPublication<T>& publication(const std::string& topic, bool latched = false) {
    auto& made = publications[topic];
    if (!made) made = std::make_unique<TypedPublication<T>>(participant, owner, topic, latched);
    return static_cast<TypedPublication<T>&>(*made);
  }

  runtime::Participant& participant;
  const std::string owner;  // of the writers
  const Ros2OutputParameters parameters;
  const std::string prefix;
  std::map<std::string, std::unique_ptr<Publication>> publications;  // by ROS 2's name
  std::map<std::string, std::vector<Handler>> handlers;              // by topic observed
  bool has_odometry = false;
  bool mounted = false;
  ros2::MapToOdom map_to_odom;
};

/// Marker arrays of all services go out on one topic, told apart by their namespaces.
template <class T>
void Ros2Publisher::Impl::add_markers(const std::string& topic, const ros2::MarkerStyle& style) {
  auto& markers = publication<ros2::MarkerArray>(prefix + "/markers");
  handlers[topic].push_back([&markers, style, in = std::make_shared<T>(),
                             array = std::make_shared<ros2::MarkerArray>()](const RawMessage& raw) {
    if (!markers.wanted()) return true;
    if (!topics::decode(raw, *in)) return false;
    ros2::fill_markers(*in, style, *array);
    std::swap(*array, markers.message());
    markers.write();
    std::swap(*array, markers.message());
    return true;
  });
}

void Ros2Publisher::Impl::add_scan(const std::string& topic, const std::string& service) {
  auto& scans = publication<ros2::LaserScan>(prefix + "/" + service + "/scan");
  handlers[topic].push_back([this, &scans, in = std::make_shared<msg::Scan>(),
                             beams = std::make_shared<ros2::ScanExport>(static_cast<std::size_t>(
                                 parameters.beams))](const RawMessage& raw) {
    if (!scans.wanted() && (mounted || parameters.base_frame.empty())) return true;
    if (!topics::decode(raw, *in)) return false;
    publish_mounting(in->header());
    if (beams->convert(*in, scans.message())) scans.write();
    return true;
  });
}

/// Where the sensor is on the robot, once its frame is known.
void Ros2Publisher::Impl::publish_mounting(const msg::Header& header) {
  if (mounted || parameters.base_frame.empty() || header.frame().empty()) return;
  mounted = true;
  auto& fixed = publication<ros2::TFMessage>("/tf_static", true);
  fixed.message().transforms().assign(
      1, ros2::transform(header.stamp(), parameters.base_frame, header.frame(),
                         {parameters.mounting_x, parameters.mounting_y, parameters.mounting_yaw},
                         parameters.mounting_z));
  fixed.write();
}

/// Of the map, whose next one comes with the next pose: dated later.
void Ros2Publisher::Impl::publish_from_map(ros2::TransformStamped transform) {
  const std::string map = transform.header().frame_id();
  ros2::set_header(transform.header(),
                   ros2::nanoseconds(transform.header().stamp()) +
                       std::llround(parameters.transform_tolerance * 1e9),
                   map);
  publish_transform(transform);
}

void Ros2Publisher::Impl::publish_transform(const ros2::TransformStamped& transform) {
  auto& transforms = publication<ros2::TFMessage>("/tf");
  transforms.message().transforms().assign(1, transform);
  transforms.write();
}

void Ros2Publisher::Impl::add_pose(const std::string& topic, const std::string& service) {
  auto& poses = publication<ros2::PoseWithCovarianceStamped>(prefix + "/" + service + "/pose");
  if (parameters.pose_tf) (void)publication<ros2::TFMessage>("/tf");
  handlers[topic].push_back(
      [this, &poses, in = std::make_shared<msg::Pose>()](const RawMessage& raw) {
        if (!topics::decode(raw, *in)) return false;
        // A pose that is lost is no pose; its message of quoin_msgs says so.
        if (in->status() == msg::PoseStatus::POSE_LOST) return true;
        ros2::fill_pose(*in, poses.message());
        poses.write();
        if (!parameters.pose_tf) return true;
        if (!has_odometry) {
          publish_from_map(ros2::transform(in->header().stamp(), in->header().frame(),
                                           in->child_frame(), pose_of(in->pose())));
        } else if (const auto made = map_to_odom.add(*in)) {
          publish_from_map(*made);
        }
        return true;
      });
}

void Ros2Publisher::Impl::add_odometry(const std::string& topic, const std::string& service) {
  has_odometry = true;
  auto& odometry = publication<ros2::Odometry>(prefix + "/" + service + "/odom");
  handlers[topic].push_back(
      [this, &odometry, in = std::make_shared<msg::Odometry>()](const RawMessage& raw) {
        if (!topics::decode(raw, *in)) return false;
        ros2::fill_odometry(*in, odometry.message());
        odometry.write();
        if (parameters.odometry_tf) {
          publish_transform(ros2::transform(in->header().stamp(), in->header().frame(),
                                            in->child_frame(), pose_of(in->pose())));
        }
        // A pose may have waited for it.
        if (const auto made = map_to_odom.add(*in); made && parameters.pose_tf) {
          publish_from_map(*made);
        }
        return true;
      });
}

void Ros2Publisher::Impl::add_map(const std::string& topic, const std::string& service,
                                  ros2::MarkerStyle style) {
  auto& markers = publication<ros2::MarkerArray>(prefix + "/" + service + "/markers", true);
  auto& grid = publication<ros2::OccupancyGrid>(prefix + "/" + service + "/grid");
  style.lifetime = 0.0;
  handlers[topic].push_back(
      [this, &markers, &grid, style, in = std::make_shared<msg::LineMap>(),
       map = std::make_shared<topics::ReceivedLineMap>()](const RawMessage& raw) {
        if (!topics::decode(raw, *in)) return false;
        if (!map->take(*in) || !map->complete()) return true;
        const std::vector<MapLine> walls = map->lines();
        ros2::fill_markers(walls, in->header(), style, markers.message());
        markers.write();
        ros2::fill_grid(walls, in->header(), parameters.grid_resolution, grid.message());
        grid.write();
        return true;
      });
}

void Ros2Publisher::Impl::add_numbers(const std::string& topic, const std::string& service,
                                      const std::string& type) {
  if (!parameters.numbers) return;
  const std::string name = prefix + "/" + service + "/numbers/" + type;
  auto made = std::make_unique<RawPublication>(participant, owner, name, ros2::own_type(type));
  handlers[topic].push_back([&own = *made](const RawMessage& raw) {
    own.write(raw);
    return true;
  });
  publications[name] = std::move(made);
}

void Ros2Publisher::Impl::add(const Connection& input, std::size_t number) {
  const std::string& topic = input.output.topic;
  const std::string& service = input.writer->name;
  const std::string& type = input.output.type;
  const ros2::MarkerStyle style{.ns = service,
                                .color = number,
                                .width = parameters.marker_width,
                                .lifetime = parameters.marker_lifetime};
  if (type == "scan") add_scan(topic, service);
  if (type == "segments") add_markers<msg::Segments>(topic, style);
  if (type == "lines") add_markers<msg::Lines>(topic, style);
  if (type == "corners") add_markers<msg::Corners>(topic, style);
  if (type == "circles") add_markers<msg::Circles>(topic, style);
  if (type == "pose") add_pose(topic, service);
  if (type == "odometry") add_odometry(topic, service);
  if (type == "line_map") add_map(topic, service, style);
  add_numbers(topic, service, type);
}

Ros2Publisher::Ros2Publisher(runtime::Participant& participant, const Deployment& deployment,
                             const ServiceConfig& service, const Ros2OutputParameters& parameters)
    : impl_(
          std::make_unique<Impl>(participant, parameters, deployment.name_space, label(service))) {
  std::size_t number = 0;
  for (const Connection& input : Graph(deployment).inputs_of(service)) impl_->add(input, number++);
}

Ros2Publisher::~Ros2Publisher() = default;

bool Ros2Publisher::handle(const std::string& topic, const RawMessage& raw) {
  bool understood = true;
  for (const Handler& handler : impl_->handlers[topic]) understood = handler(raw) && understood;
  return understood;
}

std::map<std::string, Ros2Publisher::Count> Ros2Publisher::counts() const {
  std::map<std::string, Count> counts;
  for (const auto& [name, publication] : impl_->publications) {
    counts[name] = {publication->readers(), publication->written()};
  }
  return counts;
}

}  // namespace quoin
