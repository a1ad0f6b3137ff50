// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/paper_corners.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/statistics/order_statistics.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/pictures.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

nlohmann::ordered_json json_of(const std::vector<double>& values) {
  auto array = nlohmann::ordered_json::array();
  for (const double value : values) {
    array.push_back(std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value));
  }
  return array;
}

std::vector<double> in_millimetres(std::vector<double> metres) {
  for (double& value : metres) value *= 1e3;
  return metres;
}

}  // namespace

CornerSigmas sigmas_of(const PaperCorners& method) {
  CornerSigmas sigmas;
  for (const auto& corner : method.corners) {
    sigmas.x.push_back(corner ? std::sqrt(corner->covariance(0, 0)) : std::nan(""));
    sigmas.y.push_back(corner ? std::sqrt(corner->covariance(1, 1)) : std::nan(""));
  }
  return sigmas;
}

std::optional<double> median_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::nullopt;
  return median(std::move(values));
}

std::optional<double> mean_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::string text(const std::optional<double>& value, int digits) {
  return value && std::isfinite(*value) ? fixed(*value, digits) : "-";
}

nlohmann::ordered_json sigmas_json(const PaperCorners& method) {
  const CornerSigmas sigmas = sigmas_of(method);
  return {{"fitter", method.fitter},
          {"covariance", enum_name(method.covariance)},
          {"sigma_x", json_of(sigmas.x)},
          {"sigma_y", json_of(sigmas.y)}};
}

nlohmann::ordered_json positions_json(const std::vector<Eigen::Vector2d>& corners) {
  auto array = nlohmann::ordered_json::array();
  for (const Eigen::Vector2d& corner : corners) {
    array.push_back({{"x", corner.x()}, {"y", corner.y()}});
  }
  return array;
}

void add_published_sigmas(nlohmann::ordered_json& report, const PublishedTable& published,
                          const CornersOf& corners_of, const ColumnSummary& summary) {
  for (const CovarianceMode mode : paper_modes) {
    for (const PublishedSigmas& method : published.methods) {
      const CornerSigmas sigmas = sigmas_of(corners_of(method.method, mode));
      const std::string of = " over the corners, " + method.method + ", " + published.environment +
                             ", " + std::string(enum_name(mode)) + " here";
      const auto add = [&](const char* sigma, const std::vector<double>& theirs,
                           const std::vector<double>& ours) {
        add_published(
            report, {published.paper, published.place, std::string(summary.name) + sigma + of, "mm",
                     summary.of(theirs).value_or(0.0), summary.of(in_millimetres(ours))});
      };
      add(" sigma_x", method.x, sigmas.x);
      add(" sigma_y", method.y, sigmas.y);
    }
  }
}

HtmlTable sigma_table(const PublishedTable& published, const CornersOf& corners_of,
                      const ColumnSummary& summary) {
  HtmlTable table;
  table.last_row_is_summary = true;
  table.groups = {{"", 1}};
  table.head = {"corner"};
  std::vector<std::vector<double>> columns;  // [mm]
  const auto add = [&](const std::string& name, std::vector<double> x, std::vector<double> y) {
    columns.push_back(std::move(x));
    columns.push_back(std::move(y));
    table.head.push_back(name + " x");
    table.head.push_back(name + " y");
  };
  const std::size_t group = 2 * published.methods.size();
  for (const CovarianceMode mode : paper_modes) {
    table.groups.emplace_back("here, " + std::string(enum_name(mode)), group);
    for (const PublishedSigmas& method : published.methods) {
      CornerSigmas sigmas = sigmas_of(corners_of(method.method, mode));
      add(method.method, in_millimetres(std::move(sigmas.x)), in_millimetres(std::move(sigmas.y)));
    }
  }
  table.groups.emplace_back("the paper's " + published.place, group);
  for (const PublishedSigmas& method : published.methods) add(method.method, method.x, method.y);

  std::size_t rows = 0;
  for (const auto& column : columns) rows = std::max(rows, column.size());
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells{std::to_string(row + 1)};
    for (const auto& column : columns) {
      cells.push_back(row < column.size() ? text(column[row], 1) : "");
    }
    table.rows.push_back(std::move(cells));
  }
  std::vector<std::string> last{summary.name};
  for (const auto& column : columns) last.push_back(text(summary.of(column), 1));
  table.rows.push_back(std::move(last));
  return table;
}

Drawing ellipse_drawing(const std::string& world, const std::vector<Eigen::Vector2d>& points,
                        const std::vector<LineSegment>& lines,
                        const std::vector<std::string>& fitters, CovarianceMode mode,
                        const CornersOf& corners_of) {
  Drawing drawing;
  drawing.title = "Corner uncertainty in " + world + ", " + std::string(enum_name(mode));
  drawing.caption = "covariances from " + noise_text(data_sheet_model());
  drawing.ellipses = "one-sigma ellipses";
  for (const Eigen::Vector2d& point : points) drawing.points.push_back(drawn(point));
  for (const LineSegment& line : lines) {
    drawing.lines.push_back({drawn(line.start), drawn(line.end)});
  }
  for (std::size_t k = 0; k < fitters.size(); ++k) {
    drawing.series.push_back(fitters[k]);
    for (const auto& corner : corners_of(fitters[k], mode).corners) {
      if (corner) drawing.corners.push_back(drawn(*corner, 1.0, k));
    }
  }
  return drawing;
}

}  // namespace quoin::deploy
