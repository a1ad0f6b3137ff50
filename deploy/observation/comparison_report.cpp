// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/comparison_report.hpp"

#include <nlohmann/json.hpp>

#include "deploy/observation/summary.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;

Row row(const ComparedService& service, bool is_reference) {
  const bool any = service.mean_corners > 0.0;
  const AgainstReference& against = service.against;
  const bool both = !is_reference && against.scans > 0;
  return {
      service.name,
      std::to_string(service.scans),
      std::to_string(service.missing),
      both ? std::to_string(against.scans) : "-",
      fixed(service.mean_corners, 2),
      both ? std::to_string(against.matched) : "-",
      both ? fixed(against.share() * 100.0, 1) : "-",
      both && against.matched > 0 ? milli_pair(against.median_distance, against.distance_p95) : "-",
      any ? fixed(service.median_sigma * 1e3, 2) : "-",
      any ? fixed(service.median_ellipse_area * 1e6, 2) : "-",
      service.scans == 0 ? "-" : milli_pair(service.latency_p50, service.latency_p99),
      service.methods};
}

}  // namespace

std::vector<std::string> table_lines(const ComparisonFigures& figures, std::size_t width) {
  // Short heads: all but the methods is to fit into 120 columns.
  std::vector<Row> rows{{"corners of", "scans", "missing", "compared", "corners/scan", "matched",
                         "[%]", "apart [mm]", "sigma [mm]", "area [mm^2]", "latency [ms]",
                         "methods"}};
  rows.push_back(row(figures.services[figures.reference], true));
  for (std::size_t i = 0; i < figures.services.size(); ++i) {
    if (i != figures.reference) rows.push_back(row(figures.services[i], false));
  }
  std::vector<std::string> lines;
  append_table(rows, 1, width, lines);
  return lines;
}

std::string progress_line(const ComparisonFigures& figures) {
  std::string line = fixed(figures.duration, 1) + " s, " + std::to_string(figures.scans) + " scans";
  for (std::size_t i = 0; i < figures.services.size(); ++i) {
    const ComparedService& service = figures.services[i];
    line.append(" | ").append(service.name).append(" ");
    line.append(std::to_string(service.missing)).append(" missing");
    if (service.mean_corners > 0.0) {
      line.append(", sigma ").append(fixed(service.median_sigma * 1e3, 2)).append(" mm");
    }
    if (i != figures.reference && service.against.matched > 0) {
      line.append(", ").append(fixed(service.against.share() * 100.0, 1)).append(" % matched, ");
      line.append(fixed(service.against.median_distance * 1e3, 2)).append(" mm apart");
    }
  }
  return line;
}

nlohmann::ordered_json summary(const ComparisonFigures& figures) {
  Json services = Json::object();
  for (std::size_t i = 0; i < figures.services.size(); ++i) {
    const ComparedService& service = figures.services[i];
    Json json{{"methods", service.methods},
              {"scans", service.scans},
              {"scans_missing", service.missing},
              {"mean_corners", rounded(service.mean_corners)},
              {"median_sigma_mm", rounded(service.median_sigma * 1e3)},
              {"median_ellipse_area_mm2", rounded(service.median_ellipse_area * 1e6)},
              {"latency_p50_us", rounded(service.latency_p50 * 1e6)},
              {"latency_p99_us", rounded(service.latency_p99 * 1e6)}};
    if (i != figures.reference) {
      const AgainstReference& against = service.against;
      json["against_reference"] = {{"scans", against.scans},
                                   {"corners", against.own_corners},
                                   {"reference_corners", against.reference_corners},
                                   {"matched", against.matched},
                                   {"share_matched", rounded(against.share())},
                                   {"distance_p50_mm", rounded(against.median_distance * 1e3)},
                                   {"distance_p95_mm", rounded(against.distance_p95 * 1e3)}};
    }
    services[service.name] = std::move(json);
  }
  return {{"deployment", figures.deployment},
          {"duration_s", rounded(figures.duration)},
          {"scans", figures.scans},
          {"reference", figures.services[figures.reference].name},
          {"services", std::move(services)}};
}

}  // namespace quoin::deploy
