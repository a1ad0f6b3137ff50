// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/summary.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace quoin::deploy {

namespace {

using Json = nlohmann::ordered_json;

/// An object even when it is empty.
Json counts(const std::map<std::string, std::uint64_t>& values) {
  Json json = Json::object();
  for (const auto& [name, count] : values) json[name] = count;
  return json;
}

Json end_summary(const EndFigures& end) {
  return {{"scans_expected", end.scans_expected}, {"scans_delivered", end.scans_delivered},
          {"scans_lost", end.lost.sum()},         {"lost_by_stage", counts(end.lost.by_service)},
          {"lost_on_link", end.lost.on_link},     {"lost_at_start", end.lost.at_start},
          {"lost_at_end", end.lost.at_end}};
}

/// The same, with what belongs to corners.
Json corner_summary(const EndFigures& end) {
  Json json = end_summary(end);
  json["mean_corners"] = rounded(end.corners->mean_corners);
  json["median_sigma_mm"] = rounded(end.corners->median_sigma * 1e3);
  json["median_ellipse_area_mm2"] = rounded(end.corners->median_ellipse_area * 1e6);
  return json;
}

}  // namespace

double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return 0.0;
  const double scale = std::pow(10.0, 3.0 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

Json service_summary(const ServiceFigures& service) {
  const ServiceReport& report = service.report;
  Json json = {{"kind", service.kind},
               {"method", service.method},
               {"state", report.state},
               {"received", report.received},
               {"published", report.published},
               {"lost", report.lost},
               {"losses", counts(report.losses)},
               {"upstream_lost", report.upstream_lost},
               {"failures", report.failures},
               {"latency_p50_us", rounded(report.latency_p50 * 1e6)},
               {"latency_p99_us", rounded(report.latency_p99 * 1e6)},
               {"processing_p50_us", rounded(report.processing_p50 * 1e6)},
               {"processing_p99_us", rounded(report.processing_p99 * 1e6)},
               {"resident_memory_bytes", report.resident_memory},
               {"restarts", service.restarts}};
  if (!service.numbered.empty()) json["numbered"] = counts(service.numbered);
  return json;
}

Json summary(const DeploymentFigures& figures) {
  Json services = Json::object();
  for (const ServiceFigures& service : figures.services) {
    services[service.name] = service_summary(service);
  }
  Json ends = Json::object();
  Json corners = Json::object();
  for (const EndFigures& end : figures.ends) {
    Json& json = ends[end.name] = end_summary(end);
    json["type"] = end.type;
    json["latency_p50_us"] = rounded(end.latency_p50 * 1e6);
    json["latency_p99_us"] = rounded(end.latency_p99 * 1e6);
    if (end.pose) {
      json["pose"] = {{"tracking", end.pose->tracking},
                      {"ambiguous", end.pose->ambiguous},
                      {"lost", end.pose->lost},
                      {"status", end.pose->status},
                      {"x", end.pose->x},
                      {"y", end.pose->y},
                      {"theta", end.pose->theta}};
    }
    if (end.map) {
      json["map"] = {{"walls", end.map->walls}, {"length_m", rounded(end.map->length)}};
    }
    if (end.corners) corners[end.name] = corner_summary(end);
  }
  return {{"deployment", figures.deployment},
          {"duration_s", rounded(figures.duration)},
          {"scans_published", figures.scans_published},
          {"services", services},
          {"ends", ends},
          {"corners", corners}};
}

}  // namespace quoin::deploy
