// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/scan_join.hpp"

#include <stdexcept>
#include <utility>

#include "core/parameters/parameter.hpp"
#include "deploy/observation/message_drawing.hpp"
#include "services/deployment/graph.hpp"
#include "services/keys/key_files.hpp"
#include "services/topics/header.hpp"

namespace quoin::deploy {

namespace {

// Scans waiting for their other parts; a chain is never that far apart.
constexpr std::size_t most_pending = 64;

}  // namespace

CornerChain corner_chain(const Deployment& deployment, const std::string& name) {
  const ServiceConfig& corners = deployment.service(name);
  if (corners.output("corners") == nullptr) {
    std::vector<std::string> names;
    for (const ServiceConfig& service : deployment.services) {
      if (service.output("corners") != nullptr) names.push_back(service.name);
    }
    throw std::out_of_range(deployment.file.string() + ": service '" + name + "' of kind " +
                            corners.kind + " gives no corners" + suggestion(name, names));
  }
  const Graph graph(deployment);
  CornerChain chain{&graph.source_of(corners), graph.upstream(corners, "segments"),
                    graph.upstream(corners, "lines"), &corners, nullptr};
  if (chain.segmentation == nullptr || chain.line_fitting == nullptr) {
    throw std::out_of_range(deployment.file.string() + ": the corners of '" + name +
                            "' are not made of segments and lines");
  }
  for (const ServiceConfig& service : deployment.services) {
    if (chain.circles == nullptr && service.output("circles") != nullptr &&
        graph.upstream(service, "segments") == chain.segmentation) {
      chain.circles = &service;
    }
  }
  return chain;
}

namespace {

runtime::ParticipantConfig participant_of(const Deployment& deployment, const CornerChain& chain) {
  auto config = runtime::participant_config(deployment, "quoin_draw", observer_identity);
  config.observes = {chain.segmentation->output("segments")->topic,
                     chain.line_fitting->output("lines")->topic,
                     chain.corners->output("corners")->topic};
  if (chain.circles != nullptr) {
    config.observes.push_back(chain.circles->output("circles")->topic);
  }
  return config;
}

template <class T>
runtime::Reader<T> make_reader(runtime::Participant& participant, const ServiceConfig& service,
                               std::string_view type) {
  const OutputConfig& output = *service.output(type);
  return {participant, output.topic, runtime::observer_qos(service, output)};
}

}  // namespace

ScanJoin::ScanJoin(const Deployment& deployment, const CornerChain& chain,
                   std::optional<std::uint64_t> scan)
    : chain_(chain),
      scan_(scan),
      participant_(participant_of(deployment, chain)),
      segments_(make_reader<msg::Segments>(participant_, *chain.segmentation, "segments")),
      lines_(make_reader<msg::Lines>(participant_, *chain.line_fitting, "lines")),
      corners_(make_reader<msg::Corners>(participant_, *chain.corners, "corners")) {
  wait_set_.add(segments_);
  wait_set_.add(lines_);
  wait_set_.add(corners_);
  if (chain.circles != nullptr) {
    const OutputConfig& output = *chain.circles->output("circles");
    circles_.emplace(participant_, output.topic, runtime::observer_qos(*chain.circles, output));
    wait_set_.add(*circles_);
  }
}

template <class T>
void ScanJoin::take(runtime::Reader<T>& reader, std::optional<T> Parts::*part) {
  T message;
  while (reader.take(message)) {
    const std::uint64_t number = topics::sequence_number(message.header());
    newest_ = number;
    if (scan_ && number != *scan_) continue;
    parts_[number].*part = std::move(message);
    message = T();
  }
}

std::optional<Drawing> ScanJoin::poll(std::chrono::milliseconds timeout) {
  wait_set_.wait(timeout);
  take(segments_, &Parts::segments);
  take(lines_, &Parts::lines);
  take(corners_, &Parts::corners);
  if (circles_) take(*circles_, &Parts::circles);
  for (const auto& [number, parts] : parts_) {
    const bool round = parts.circles || !circles_;
    if (parts.segments && parts.lines && parts.corners && round) return draw(parts);
  }
  while (parts_.size() > most_pending) parts_.erase(parts_.begin());
  return std::nullopt;
}

Drawing ScanJoin::draw(const Parts& parts) const {
  Drawing drawing;
  const msg::Segments& segments = *parts.segments;
  add_points(segments.bearings(), segments.ranges(), drawing);
  add_lines(*parts.lines, drawing);
  add_corners(*parts.corners, drawing);
  if (parts.circles) add_circles(*parts.circles, drawing);
  drawing.title =
      chain_.corners->name + ", scan " + std::to_string(topics::sequence_number(segments.header()));
  // The methods that made the result, which control may have swapped since the start.
  drawing.caption = stages_text(parts.corners->header());
  drawing.caption += "; covariances " + parts.corners->covariance_mode();
  return drawing;
}

}  // namespace quoin::deploy
