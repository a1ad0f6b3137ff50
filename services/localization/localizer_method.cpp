// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/localization/localizer_method.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <idl/LineMap.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Segments.h>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/mapping/localizers.hpp"
#include "services/localization/map_keeper.hpp"
#include "services/localization/odometry_motion.hpp"
#include "services/maps/map_reader.hpp"
#include "services/topics/line_map.hpp"
#include "services/topics/lines.hpp"
#include "services/topics/poses.hpp"

namespace quoin {

namespace {

using std::chrono::steady_clock;

// At constant velocity a robot would be anywhere after that [s].
constexpr double longest_without_odometry = 2.0;
constexpr double map_period = 0.5;  // [s] by stamps: a map is published so often where it changes

std::uint64_t now_since_epoch() {
  return static_cast<std::uint64_t>(
      std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count());
}

/// Settings of the parameters `P` apart from those of a method.
template <class P>
std::pair<P, ParameterSettings> split(const ParameterSettings& settings) {
  const std::vector<ParameterInfo> own = describe_parameters<P>();
  ParameterSettings of_own, others;
  for (const ParameterSetting& setting : settings) {
    const bool mine = std::ranges::any_of(
        own, [&](const ParameterInfo& info) { return info.name == setting.name; });
    (mine ? of_own : others).push_back(setting);
  }
  return {make_parameters<P>(of_own), others};
}

/// What stands before the bytes of the localizer in the state.
struct Frame {
  std::uint64_t begun = 0;  // of the map
  double x = 0.0;           // of the origin of the localizer in the map
  double y = 0.0;
  double theta = 0.0;
  double last_time = 0.0;  // [s] of the last scan, by the clock of the localizer
  std::int64_t last_stamp = 0;
};

/// A localizer as the method of a node.
class LocalizerNode {
 public:
  LocalizerNode(Localizer localizer, const RobotParameters& robot)
      : robot_(robot),
        localizer_(std::move(localizer)),
        motion_(robot),
        published_(now_since_epoch()),
        from_mounting_(between(robot.mounting(), Pose2{})) {
    frame_.begun = now_since_epoch();
  }
  ~LocalizerNode() {
    if (keeper_ && changed_) keeper_->save(saved());
  }
  LocalizerNode(const LocalizerNode&) = delete;
  LocalizerNode& operator=(const LocalizerNode&) = delete;

  /// Where the origin of the localizer's map is in the map that is published.
  void set_origin(const Pose2& origin) {
    frame_.x = origin.x;
    frame_.y = origin.y;
    frame_.theta = origin.theta;
  }
  /// Localizes in these walls and maps nothing.
  void use_map(std::vector<MapLine> lines, const std::optional<PoseEstimate>& sensor) {
    localizer_.use_map(lines, sensor);
    given_ = std::move(lines);
  }
  /// Goes on with the map of this file, or keeps a new one in it. Throws ParameterError.
  void keep(const std::filesystem::path& file, const std::string& method, const std::string& form) {
    method_ = method;
    form_ = form;
    if (std::filesystem::exists(file)) {
      try {
        const maps::SavedMap map = maps::parse_map(maps::read_text(file), file.string());
        if (map.state_form != form) {
          throw maps::MapError(file.string() + ": holds a map of method " + map.method + " (" +
                               map.state_form + "), which " + method + " (" + form +
                               ") cannot go on with; name another file, or that method");
        }
        restore(map.state);
        interrupted_ = true;
      } catch (const std::exception& error) {
        throw ParameterError("map", error.what());
      }
    }
    keeper_.emplace(file);
  }

  void handle(runtime::Work& work);

  [[nodiscard]] runtime::State save() const {
    runtime::State state(sizeof(Frame));
    std::memcpy(state.data(), &frame_, sizeof(Frame));
    const std::vector<std::uint8_t> inside = localizer_.save();
    state.insert(state.end(), inside.begin(), inside.end());
    return state;
  }
  void restore(const runtime::State& state) {
    Frame frame;
    if (state.size() < sizeof(Frame)) throw std::invalid_argument("a state that is cut off");
    std::memcpy(&frame, state.data(), sizeof(Frame));
    if (!std::isfinite(frame.x + frame.y + frame.theta + frame.last_time)) {
      throw std::invalid_argument("a state that is damaged");
    }
    localizer_.restore(std::span(state).subspan(sizeof(Frame)));
    frame_ = frame;
    started_ = true;
    published_ = topics::PublishedLineMap(now_since_epoch());
  }

 private:
  double time_of(std::int64_t stamp, runtime::Work& work);
  [[nodiscard]] static PoseEstimate anywhere_near();
  void take_points(const msg::Segments* segments);
  void publish_map(runtime::Work& work);
  void report(runtime::Work& work, std::size_t lines);
  [[nodiscard]] Pose2 origin() const { return {frame_.x, frame_.y, frame_.theta}; }
  [[nodiscard]] PoseEstimate of_robot(const PoseEstimate& sensor) const;
  [[nodiscard]] MapLine in_map(MapLine line) const;
  [[nodiscard]] maps::SavedMap saved() const;

  RobotParameters robot_;
  Localizer localizer_;
  OdometryMotion motion_;
  topics::PublishedLineMap published_;
  Pose2 from_mounting_;
  Frame frame_;
  bool started_ = false;      // a scan has been localized, or a state goes on
  bool interrupted_ = false;  // nobody knows what the robot did since the last scan
  std::vector<MapLine> given_;
  std::string method_, form_;
  std::optional<MapKeeper> keeper_;
  bool changed_ = false;  // since it was saved
  std::vector<LineSegment> lines_;
  std::vector<std::pair<float, Eigen::Vector2d>> rays_;
  std::vector<Eigen::Vector2d> points_;
  Localization result_;
  std::vector<MapLine> map_;  // as published
  double next_map_ = 0.0;     // [s] by the clock of the localizer
  std::size_t unpublished_ = 0;
  std::size_t stamps_back_ = 0;
  steady_clock::time_point reported_{};
};

/// Stamps that ascend, whatever those of the scans do: a recording may begin again.
double LocalizerNode::time_of(std::int64_t stamp, runtime::Work& work) {
  if (!started_) return 0.0;
  const double passed =
      (static_cast<double>(stamp) - static_cast<double>(frame_.last_stamp)) * 1e-9;
  if (passed > longest_without_odometry) interrupted_ = true;
  if (passed > 0.0) return frame_.last_time + passed;
  interrupted_ = true;
  ++stamps_back_;
  work.set_diagnostic("Stamps", "went back " + std::to_string(stamps_back_) +
                                    " times; the time between scans was not known there");
  return frame_.last_time + 0.1;
}

/// The motion of a robot that was not watched. If it was carried away, the method finds out.
PoseEstimate LocalizerNode::anywhere_near() {
  constexpr double position = 0.5;  // [m]
  constexpr double heading = 0.3;   // [rad]
  return {
      {},
      Eigen::Vector3d(position * position, position * position, heading * heading).asDiagonal()};
}

PoseEstimate LocalizerNode::of_robot(const PoseEstimate& sensor) const {
  const Eigen::Matrix3d turned = compose_by_second(origin());
  const PoseEstimate in_frame{compose(origin(), sensor.pose),
                              turned * sensor.covariance * turned.transpose()};
  return compose(in_frame, PoseEstimate{from_mounting_, Eigen::Matrix3d::Zero()});
}

MapLine LocalizerNode::in_map(MapLine line) const {
  line.start = origin().transform(line.start);
  line.end = origin().transform(line.end);
  return line;
}

/// All points of the scan, in the order of their bearings.
void LocalizerNode::take_points(const msg::Segments* segments) {
  points_.clear();
  if (segments == nullptr || segments->bearings().size() != segments->ranges().size()) return;
  rays_.clear();
  for (std::size_t i = 0; i < segments->ranges().size(); ++i) {
    const double range = segments->ranges()[i];
    const double bearing = segments->bearings()[i];
    if (!std::isfinite(range) || !std::isfinite(bearing)) continue;
    rays_.emplace_back(segments->bearings()[i],
                       Eigen::Vector2d(range * std::cos(bearing), range * std::sin(bearing)));
  }
  std::ranges::sort(rays_, {}, &std::pair<float, Eigen::Vector2d>::first);
  for (const auto& [bearing, point] : rays_) points_.push_back(point);
}

void LocalizerNode::handle(runtime::Work& work) {
  const msg::Lines& in = work.input<msg::Lines>();
  const std::int64_t stamp = in.header().stamp();
  topics::line_segments(in, lines_);
  std::erase_if(lines_, [](const LineSegment& line) {
    return !line.start.allFinite() || !line.end.allFinite() ||
           !line.estimate.covariance.allFinite() || !std::isfinite(line.estimate.line.alpha) ||
           !std::isfinite(line.estimate.line.r);
  });
  const auto odometry = work.around<msg::Odometry>("odometry");
  const auto segments = work.around<msg::Segments>("segments");
  take_points(segments.before == segments.after ? segments.before : nullptr);

  LocalizationInput input;
  input.stamp = time_of(stamp, work);
  input.lines = lines_;
  input.points = points_;
  input.motion = motion_.to_scan(stamp, odometry.before, odometry.after);
  if (!started_) input.motion.reset();
  const bool has_odometry = input.motion.has_value();
  if (std::exchange(interrupted_, false) && !has_odometry) input.motion = anywhere_near();
  input.wants_map = input.stamp >= next_map_;
  localizer_(input, result_);
  started_ = true;
  changed_ = true;
  frame_.last_stamp = stamp;
  frame_.last_time = input.stamp;

  msg::Pose& out = work.output<msg::Pose>();
  out.child_frame(robot_.base_frame);
  out.pose(topics::pose_message(of_robot(result_.pose)));
  topics::fill_status(result_, lines_.size(), has_odometry, out);
  if (result_.weak_direction) out.weak_direction(*result_.weak_direction + frame_.theta);
  work.set_frame(robot_.map_frame);
  if (input.wants_map) {
    next_map_ = input.stamp + map_period;
    publish_map(work);
  }
  if (keeper_ && keeper_->due()) {
    keeper_->save(saved());
    changed_ = false;
  }
  report(work, lines_.size());
}

void LocalizerNode::publish_map(runtime::Work& work) {
  map_.clear();
  for (const MapLine& line : given_.empty() ? result_.map : given_) map_.push_back(in_map(line));
  unpublished_ = published_.update(map_);
  work.publish_while<msg::LineMap>([this](msg::LineMap& out) { return published_.next(out); });
}

maps::SavedMap LocalizerNode::saved() const {
  return {robot_.map_frame, frame_.begun, method_, form_, save(), map_};
}

void LocalizerNode::report(runtime::Work& work, std::size_t lines) {
  const auto now = steady_clock::now();
  if (now < reported_ + std::chrono::seconds(1)) return;
  reported_ = now;
  double length = 0.0;
  for (const MapLine& line : map_) length += line.length();
  std::string text =
      std::to_string(map_.size()) + " walls, " + std::to_string(std::lround(length)) + " m";
  if (unpublished_ > 0) {
    text += "; " + std::to_string(unpublished_) + " walls beyond the " +
            std::to_string(topics::most_walls) + " that a topic holds are not published";
  }
  work.set_diagnostic("Map", text);
  work.set_diagnostic("Pose", std::string(enum_name(result_.status)) + ", " +
                                  std::to_string(result_.matched) + " of " + std::to_string(lines) +
                                  " lines in the map");
  if (motion_.rejected() > 0) {
    work.set_diagnostic("Odometry", "not used for " + std::to_string(motion_.rejected()) +
                                        " scans, the last time because " + motion_.reason());
  }
  if (keeper_) work.set_diagnostic("Map File", keeper_->status());
}

runtime::Method as_method(const std::shared_ptr<LocalizerNode>& node, std::string form) {
  return {.handle = [node](runtime::Work& work) { node->handle(work); },
          .state_form = std::move(form),
          .save = [node] { return node->save(); },
          .restore = [node](const runtime::State& state) { node->restore(state); }};
}

template <class List>
std::string state_form(const std::string& method) {
  for (const MethodInfo& info : List::descriptions()) {
    if (info.name == method) return info.state;
  }
  return "";
}

}  // namespace

runtime::Method make_mapper(const std::string& method, const ParameterSettings& settings,
                            const std::filesystem::path& directory) {
  const auto [own, others] = split<MappingParameters>(settings);
  const std::string form = state_form<Mappers>(method);
  auto node = std::make_shared<LocalizerNode>(Mappers::make<Localizer>(method, others), own);
  node->set_origin(compose(own.start(), own.mounting()));
  if (!own.map.empty()) node->keep(directory / own.map, method, form);
  return as_method(node, form);
}

runtime::Method make_localizer(const std::string& method, const ParameterSettings& settings,
                               const std::filesystem::path& directory) {
  const auto [own, others] = split<GivenMapParameters>(settings);
  auto node = std::make_shared<LocalizerNode>(Localizers::make<Localizer>(method, others), own);
  std::vector<MapLine> lines;
  try {
    lines = maps::read_map(directory / own.map, own.map_scale).lines;
  } catch (const maps::MapError& error) {
    throw ParameterError("map", error.what());
  }
  std::optional<PoseEstimate> start;
  if (own.start_known) {
    start.emplace();
    start->pose = compose(own.start(), own.mounting());
    const double position = own.start_stddev * own.start_stddev;
    const double heading = own.start_yaw_stddev * own.start_yaw_stddev;
    start->covariance = Eigen::Vector3d(position, position, heading).asDiagonal();
  }
  node->use_map(std::move(lines), start);
  return as_method(node, state_form<Localizers>(method));
}

runtime::Component localizer_component(const KindInfo& kind, MakeInFolder make) {
  return runtime::node_component(
      kind,
      runtime::port_types(runtime::Reads<msg::Lines, msg::Odometry, msg::Segments>(),
                          runtime::Writes<msg::Pose, msg::LineMap>()),
      [make](const Deployment& deployment, const ServiceConfig& config) -> runtime::BindMethods {
        const std::filesystem::path folder = deployment.file.parent_path();
        (void)make(config.method, config.parameters, folder);  // throws
        const runtime::MethodFactory factory = [make, folder](const std::string& method,
                                                              const ParameterSettings& parameters) {
          return make(method, parameters, folder);
        };
        return [factory](runtime::Participant&) { return factory; };
      });
}

}  // namespace quoin
