// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/table.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace quoin::deploy {

namespace {

using Row = std::vector<std::string>;

std::string kind_and_method(const ServiceFigures& service) {
  return service.method.empty() ? service.kind : service.kind + "/" + service.method;
}

Row service_row(const ServiceFigures& service) {
  const ServiceReport& report = service.report;
  return {service.name, kind_and_method(service), report.state, fixed(report.rate, 1),
          std::to_string(report.received), std::to_string(report.published),
          std::to_string(report.lost),
          // A source's results are the scans themselves.
          report.received == 0 ? "-" : milli_pair(report.latency_p50, report.latency_p99),
          fixed(static_cast<double>(report.resident_memory) / (1024.0 * 1024.0), 1),
          std::to_string(service.restarts)};
}

Row corner_row(const CornerFigures& corner) {
  const bool any = corner.mean_corners > 0.0;
  return {corner.name,
          std::to_string(corner.scans_delivered),
          std::to_string(corner.scans_lost),
          fixed(corner.mean_corners, 2),
          any ? fixed(corner.median_sigma * 1e3, 2) : "-",
          any ? fixed(corner.median_ellipse_area * 1e6, 2) : "-"};
}

}  // namespace

void append_table(const std::vector<Row>& rows, std::size_t left, std::size_t width,
                  std::vector<std::string>& lines) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - row[i].size(), ' ');
      if (i > 0) line += "  ";
      line += i < left ? row[i] + padding : padding + row[i];
    }
    lines.push_back(line.substr(0, width));
  }
}

std::string milli_pair(double first, double second) {
  if (first <= 0.0 && second <= 0.0) return "-";
  return fixed(first * 1e3, 2) + " / " + fixed(second * 1e3, 2);
}

std::string fixed(double value, int digits) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
  return buffer.data();
}

std::vector<std::string> table_lines(const DeploymentFigures& figures, std::size_t width) {
  std::vector<std::string> lines;
  // Short heads: the table is to fit into 120 columns.
  std::vector<Row> rows{{"service", "kind/method", "state", "Hz", "received", "published", "lost",
                         "p50 / p99 [ms]", "RSS MiB", "restarts"}};
  for (const ServiceFigures& service : figures.services) rows.push_back(service_row(service));
  append_table(rows, 3, width, lines);
  if (figures.corners.empty()) return lines;

  lines.emplace_back();
  rows.assign({{"corners of", "scans", "lost", "corners/scan", "median sigma [mm]",
                "median ellipse area [mm^2]"}});
  for (const CornerFigures& corner : figures.corners) rows.push_back(corner_row(corner));
  append_table(rows, 1, width, lines);
  return lines;
}

std::vector<std::string> status_lines(const std::vector<ServiceFigures>& services) {
  std::vector<Row> rows{{"service", "host", "kind/method", "state", "Hz", "received", "published",
                         "lost", "p50 / p99 [ms]", "RSS MiB", "age [s]"}};
  for (const ServiceFigures& service : services) {
    Row row = service_row(service);
    row.insert(row.begin() + 1, service.host.empty() ? "-" : service.host);
    row.back() = service.age < 0.0 ? "-" : fixed(service.age, 1);  // instead of the restarts
    rows.push_back(std::move(row));
  }
  std::vector<std::string> lines;
  append_table(rows, 4, std::string::npos, lines);
  return lines;
}

std::string progress_line(const DeploymentFigures& figures) {
  std::string line = fixed(figures.duration, 1) + " s";
  for (const CornerFigures& corner : figures.corners) {
    line += " | " + corner.name + " " + std::to_string(corner.scans_delivered) + " scans, " +
            std::to_string(corner.scans_lost) + " lost";
    if (corner.mean_corners > 0.0) {
      line += ", " + fixed(corner.mean_corners, 1) + " corners, sigma " +
              fixed(corner.median_sigma * 1e3, 2) + " mm";
    }
  }
  const bool arriving =
      std::any_of(figures.corners.begin(), figures.corners.end(),
                  [](const CornerFigures& corner) { return corner.scans_delivered > 0; });
  for (const ServiceFigures& service : figures.services) {
    const bool worth_saying = service.report.state != "active" || service.restarts > 0;
    if (arriving && !worth_saying) continue;
    line += " | " + service.name + " " + service.report.state;
    if (!arriving) line.append(" ").append(std::to_string(service.report.published));
    if (service.restarts > 0) {
      line.append(" (").append(std::to_string(service.restarts)).append(" restarts)");
    }
  }
  return line;
}

}  // namespace quoin::deploy
