// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/explainer.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "services/explanation/explanation_report.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/segments.hpp"

namespace quoin::viewer {

namespace {

using nlohmann::json;

constexpr std::size_t most_bytes = 16'000'000;
// A page has stamps as numbers of 53 bits.
constexpr std::int64_t same_stamp = 1024;  // [ns]

double number(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number() || !std::isfinite(found->get<double>())) {
    throw std::invalid_argument(std::string("'") + key + "' is not a number");
  }
  return found->get<double>();
}

}  // namespace

void Explainer::add(const std::string& topic, std::int64_t stamp, const Payload& scan) {
  const std::lock_guard lock(mutex_);
  scans_.push_back({topic, stamp, scan});
  bytes_ += scan.bytes.size();
  while (bytes_ > most_bytes && scans_.size() > 1) {
    bytes_ -= scans_.front().scan.bytes.size();
    scans_.pop_front();
  }
}

std::string Explainer::answer(const std::string& request) const {
  const json object = json::parse(request, nullptr, false);
  if (!object.is_object()) throw std::invalid_argument("the request is not a JSON object");
  const ExplainedServices services =
      explained_services(deployment_, object.value("service", std::string()));
  const Place place = Place::at(number(object, "x"), number(object, "y"));
  const std::string topic =
      services.source->external() && !services.source->outputs.empty()
          ? services.source->outputs.front().topic
          : output_topic(deployment_.name_space, services.source->name, "scan");
  std::optional<double> stamp;
  if (object.contains("stamp")) stamp = number(object, "stamp");
  Payload kept;
  {
    const std::lock_guard lock(mutex_);
    for (const Kept& each : scans_) {
      const bool wanted =
          !stamp || std::abs(static_cast<double>(each.stamp) - *stamp) < double{same_stamp};
      if (each.topic == topic && wanted) kept = each.scan;
    }
  }
  if (!kept.owner) throw std::invalid_argument("that scan of " + topic + " is not kept any more");
  msg::Scan scan;
  if (!topics::decode(topics::cdr_codec<msg::Scan>(), kept.bytes.data(), kept.bytes.size(),
                      &scan)) {
    throw std::invalid_argument("what came by " + topic + " is no scan");
  }
  const Explanation found =
      explain({scan.bearings(), scan.ranges(), scan.range_min(), scan.range_max()},
              topics::sensor_model(scan.sensor_model()), services.chain, place);
  return to_json(services, place, found).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace quoin::viewer
