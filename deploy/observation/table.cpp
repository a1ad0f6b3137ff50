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

Row end_row(const EndFigures& end, bool with_corners) {
  Row row{end.name, end.type, std::to_string(end.scans_delivered), std::to_string(end.lost.sum()),
          milli_pair(end.latency_p50, end.latency_p99)};
  if (!with_corners) return row;
  const bool any = end.corners && end.corners->mean_corners > 0.0;
  row.push_back(end.corners ? fixed(end.corners->mean_corners, 2) : "-");
  row.push_back(any ? fixed(end.corners->median_sigma * 1e3, 2) : "-");
  row.push_back(any ? fixed(end.corners->median_ellipse_area * 1e6, 2) : "-");
  return row;
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

namespace {

std::string place_text(const PoseFigures& pose) {
  return pose.status + " at (" + fixed(pose.x, 2) + ", " + fixed(pose.y, 2) + ") m " +
         fixed(pose.theta * 57.29577951308232, 1) + " deg";
}

std::string map_text(const MapFigures& map) {
  return "map of " + std::to_string(map.walls) + " walls, " + fixed(map.length, 1) + " m";
}

}  // namespace

std::vector<std::string> table_lines(const DeploymentFigures& figures, std::size_t width) {
  std::vector<std::string> lines;
  // Short heads: the table is to fit into 120 columns.
  std::vector<Row> rows{{"service", "kind/method", "state", "Hz", "received", "published", "lost",
                         "p50 / p99 [ms]", "RSS MiB", "restarts"}};
  for (const ServiceFigures& service : figures.services) rows.push_back(service_row(service));
  append_table(rows, 3, width, lines);
  if (figures.ends.empty()) return lines;

  const bool with_corners = std::any_of(figures.ends.begin(), figures.ends.end(),
                                        [](const EndFigures& end) { return end.corners; });
  Row head{"what comes out of", "type", "scans", "lost", "p50 / p99 [ms]"};
  if (with_corners) {
    head.insert(head.end(), {"corners/scan", "median sigma [mm]", "median ellipse area [mm^2]"});
  }
  lines.emplace_back();
  rows.assign({std::move(head)});
  for (const EndFigures& end : figures.ends) rows.push_back(end_row(end, with_corners));
  append_table(rows, 2, width, lines);
  for (const EndFigures& end : figures.ends) {
    if (end.pose) {
      lines.push_back(end.name + ": " + std::to_string(end.pose->tracking) + " tracking, " +
                      std::to_string(end.pose->ambiguous) + " ambiguous, " +
                      std::to_string(end.pose->lost) + " lost; " + place_text(*end.pose));
    }
    if (end.map) lines.push_back(end.name + ": " + map_text(*end.map));
  }
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
  for (const EndFigures& end : figures.ends) {
    line += " | " + end.name + " " + std::to_string(end.scans_delivered) + " scans, " +
            std::to_string(end.lost.sum()) + " lost";
    if (end.corners && end.corners->mean_corners > 0.0) {
      line += ", " + fixed(end.corners->mean_corners, 1) + " corners, sigma " +
              fixed(end.corners->median_sigma * 1e3, 2) + " mm";
    }
    if (end.pose) line += ", " + place_text(*end.pose);
    if (end.map) line += ", " + map_text(*end.map);
  }
  const bool arriving = std::any_of(figures.ends.begin(), figures.ends.end(),
                                    [](const EndFigures& end) { return end.scans_delivered > 0; });
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
