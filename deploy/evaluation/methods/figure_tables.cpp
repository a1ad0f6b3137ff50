// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/figure_tables.hpp"

#include <algorithm>
#include <functional>

#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/methods/markdown.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string cell(const std::optional<double>& value, int digits, double factor = 1.0) {
  return value ? fixed(*value * factor, digits) : "-";
}

std::string measured_by(const MeasuredFigures& figures) {
  return "By `quoin evaluate`, version " + figures.version + ", seed " +
         std::to_string(figures.seed) + ". ";
}

std::string setting_of(const FitterFigures& fitter) {
  return fitter.environment + ", noise " + noise_text(fitter.noise);
}

void append_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

std::string time_table(const MeasuredFigures& figures) {
  Rows rows{{"fitter", "points", "time [us]", "over plain covariance"}};
  for (const FitTimeFigures& time : figures.fit_times) {
    if (!time.seconds) continue;
    rows.push_back({time.name, std::to_string(time.points), cell(time.seconds, 3, 1e6),
                    cell(time.over_covariance, 1)});
  }
  if (rows.size() == 1) return "";
  return markdown_paragraph(
             "Time of one line with its covariance on one processor of the machine that measured, "
             "and how many times that of the plain covariance of x and y of the same points "
             "(Eigen, two passes), the last row:") +
         markdown_table(rows, 1);
}

using SegmenterFigure = std::function<std::string(const SegmenterFigures&)>;

/// A row for each segmenter, a column for each noise.
std::string noise_table(const std::vector<SegmenterFigures>& segmenters,
                        const SegmenterFigure& figure) {
  std::vector<std::string> names;
  std::vector<std::string> noises;
  for (const SegmenterFigures& entry : segmenters) {
    append_once(names, entry.name);
    append_once(noises, noise_text(entry.noise));
  }
  Rows rows{{"segmenter"}};
  rows.front().insert(rows.front().end(), noises.begin(), noises.end());
  for (const std::string& name : names) {
    rows.push_back({name});
    for (const std::string& noise : noises) {
      const auto found =
          std::find_if(segmenters.begin(), segmenters.end(), [&](const SegmenterFigures& entry) {
            return entry.name == name && noise_text(entry.noise) == noise;
          });
      rows.back().push_back(found == segmenters.end() ? "-" : figure(*found));
    }
  }
  return markdown_table(rows, 1);
}

}  // namespace

std::string fitter_tables(const MeasuredFigures& figures) {
  const std::vector<FitterFigures>& fitters = figures.fitters;
  std::string text;
  if (!fitters.empty()) {
    text += markdown_paragraph(
        measured_by(figures) + std::to_string(figures.trials) +
        " trials each, with the true segmentation. NEES is the mean squared Mahalanobis distance "
        "of the corners, 2 when the covariance is right; coverage the share of the corners in "
        "their 95 % ellipses; RMSE/CRB the root mean squared error over the least an unbiased fit "
        "can have (Cramer-Rao bound), median over the corners, which does not depend on the "
        "covariance.");
  }
  std::vector<std::string> settings;
  for (const FitterFigures& entry : fitters) append_once(settings, setting_of(entry));
  for (const std::string& setting : settings) {
    Rows rows{{"fitter", "covariance", "NEES", "coverage [%]", "RMSE/CRB"}};
    for (const FitterFigures& entry : fitters) {
      if (setting_of(entry) != setting) continue;
      rows.push_back({entry.name, entry.covariance, cell(entry.nees, 2),
                      cell(entry.coverage95, 1, 100.0), cell(entry.rmse_over_crb, 3)});
    }
    text += markdown_paragraph(setting + ":") + markdown_table(rows, 2);
  }
  return text + time_table(figures);
}

std::string segmenter_tables(const MeasuredFigures& figures) {
  const std::vector<SegmenterFigures>& segmenters = figures.segmenters;
  if (segmenters.empty()) return "";
  std::string text = markdown_paragraph(
      measured_by(figures) + std::to_string(segmenters.front().scans) +
      " simulated scans at each noise of range and bearing. True positives: share of the true "
      "segments that were found [%]");
  text += noise_table(segmenters, [](const SegmenterFigures& entry) {
    return fixed(100.0 * entry.true_positive_rate, 1);
  });
  text += markdown_paragraph("False positives: share of the found segments that are none [%]");
  text += noise_table(segmenters, [](const SegmenterFigures& entry) {
    return fixed(100.0 * entry.false_positive_rate, 1);
  });
  const bool timed = std::any_of(segmenters.begin(), segmenters.end(),
                                 [](const auto& entry) { return entry.scans_per_second; });
  if (!timed) return text;
  text += markdown_paragraph(
      "Thousands of scans per second on one processor of the machine that measured");
  return text + noise_table(segmenters, [](const SegmenterFigures& entry) {
           return cell(entry.scans_per_second, 1, 1e-3);
         });
}

}  // namespace quoin::deploy
