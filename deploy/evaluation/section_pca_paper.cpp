// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/evaluation/papers/pca_paper.hpp"
#include "core/geometry/angle.hpp"
#include "core/statistics/order_statistics.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t paper_trials = 10000;

/// What changes from row to row in one of the paper's tables.
struct Variation {
  int table;
  const char* title;
  const char* axis;
  double PcaSimulation::*value;
  double factor;
};

constexpr std::array variations{
    Variation{1, "separation of the points", "separation [mm]", &PcaSimulation::separation, 1e3},
    Variation{2, "noise", "noise [mm]", &PcaSimulation::noise, 1e3},
    Variation{3, "outliers", "outliers [%]", &PcaSimulation::outliers, 100.0}};

nlohmann::ordered_json accuracy_json(const LineAccuracy& accuracy) {
  nlohmann::ordered_json object{{"residual", accuracy.residual},
                                {"angle_rmse", accuracy.angle_rmse},
                                {"offset_rmse", accuracy.offset_rmse},
                                {"seconds", nullptr}};
  if (accuracy.seconds > 0.0) object["seconds"] = accuracy.seconds;
  return object;
}

std::string microseconds(const LineAccuracy& accuracy) {
  return accuracy.seconds > 0.0 ? fixed(1e6 * accuracy.seconds, 2) : "-";
}

/// Table 1 varies the length of the line, too: a curve for each.
std::string length_of(const PcaSimulation& simulation) {
  if (simulation.table != 1) return "";
  return ", " + fixed(simulation.separation * static_cast<double>(simulation.points), 0) + " m";
}

/// The series of that name, new if need be.
LineSeries& series_of(LineChart& chart, const std::string& name) {
  const auto found = std::find_if(chart.series.begin(), chart.series.end(),
                                  [&](const LineSeries& series) { return series.name == name; });
  if (found != chart.series.end()) return *found;
  return chart.series.emplace_back(LineSeries{name, {}, {}});
}

class PcaPaperSection : public Section {
 public:
  explicit PcaPaperSection(const EvaluationSetup& setup)
      // The paper's number by default, fewer when fewer trials are wanted everywhere.
      : trials_(std::min(paper_trials, 5 * std::min(setup.options.trials, paper_trials))),
        seed_(setup.options.seed) {
    for (const PcaSimulation& simulation : pca_simulations()) {
      rows_.push_back({simulation, {}, {}});
    }
  }

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      jobs.push_back({"simulation " + std::to_string(k + 1), [this, k](const auto&) {
                        rows_[k] = compare_pca(rows_[k].simulation, trials_, seed_of(k));
                      }});
    }
    return jobs;
  }

  std::vector<Job> timing_jobs() override {
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      jobs.push_back({"speed in simulation " + std::to_string(k + 1),
                      [this, k](const auto&) { time_pca(rows_[k], seed_of(k)); }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto simulations = nlohmann::ordered_json::array();
    for (const PcaComparison& row : rows_) {
      simulations.push_back({{"table", row.simulation.table},
                             {"separation", row.simulation.separation},
                             {"points", row.simulation.points},
                             {"noise", row.simulation.noise},
                             {"outliers", row.simulation.outliers},
                             {"pca", accuracy_json(row.pca)},
                             {"least_squares", accuracy_json(row.least_squares)}});
    }
    report["pca_paper"] = {{"trials", trials_}, {"simulations", std::move(simulations)}};
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "The numerical simulations of the PCA paper: points in equal steps along a straight line "
        "with noise across it, fitted by principal components and by least squares, " +
        std::to_string(trials_) +
        " times each. Our copy of the paper has no tables, so that its own figures cannot stand "
        "beside these. residual is the standard deviation of the points from the line, which the "
        "paper calls accuracy; direction and offset are errors against the true line.");
    for (const Variation& variation : variations) write_table(page, variation);
  }

  SummaryTable summary() const override {
    SummaryTable rows{{"pca over least_squares", "varied", "error of direction", "time"}};
    for (const Variation& variation : variations) {
      std::vector<double> errors, times;
      for (const PcaComparison& row : rows_) {
        if (row.simulation.table != variation.table) continue;
        errors.push_back(row.pca.angle_rmse / row.least_squares.angle_rmse);
        if (row.least_squares.seconds > 0.0) {
          times.push_back(row.pca.seconds / row.least_squares.seconds);
        }
      }
      rows.push_back({"Table " + std::to_string(variation.table) + ", median", variation.title,
                      fixed(median(errors), 3), times.empty() ? "-" : fixed(median(times), 2)});
    }
    return rows;
  }

 private:
  [[nodiscard]] std::uint64_t seed_of(std::size_t k) const {
    return derived_seed(seed_, "pca_paper/" + std::to_string(k));
  }

  void write_table(HtmlPage& page, const Variation& variation) const {
    page.heading(3, "Table " + std::to_string(variation.table) + ": " + variation.title);
    LineChart chart;
    chart.title = std::string("Error of the direction against ") + variation.title;
    chart.x = {variation.axis, true};
    chart.y = {"root mean squared error [deg]", true};
    HtmlTable table;
    table.groups = {{"", 4}, {"pca", 4}, {"least_squares", 4}};
    table.head = {"separation [mm]", "points", "noise [mm]", "outliers [%]"};
    for (int method = 0; method < 2; ++method) {
      for (const char* name : {"residual [mm]", "direction [deg]", "offset [mm]", "time [us]"}) {
        table.head.emplace_back(name);
      }
    }
    table.text_columns = 0;
    for (const PcaComparison& row : rows_) {
      const PcaSimulation& simulation = row.simulation;
      if (simulation.table != variation.table) continue;
      std::vector<std::string> cells{
          fixed(1e3 * simulation.separation, 0), std::to_string(simulation.points),
          fixed(1e3 * simulation.noise, 0), fixed(100.0 * simulation.outliers, 0)};
      const std::array accuracies{&row.pca, &row.least_squares};
      const std::array<std::string, 2> names{"pca", "least_squares"};
      for (std::size_t method = 0; method < accuracies.size(); ++method) {
        const LineAccuracy& accuracy = *accuracies.at(method);
        LineSeries& series = series_of(chart, names.at(method) + length_of(simulation));
        series.x.push_back(variation.factor * simulation.*variation.value);
        series.y.push_back(degrees * accuracy.angle_rmse);
        for (const std::string& cell :
             {fixed(1e3 * accuracy.residual, 2), fixed(degrees * accuracy.angle_rmse, 4),
              fixed(1e3 * accuracy.offset_rmse, 3), microseconds(accuracy)}) {
          cells.push_back(cell);
        }
      }
      table.rows.push_back(std::move(cells));
    }
    page.figure(plot_svg(chart), "Both methods fit the same points.");
    page.table(table);
  }

  std::size_t trials_;
  std::uint64_t seed_;
  std::vector<PcaComparison> rows_;
};

}  // namespace

std::unique_ptr<Section> make_pca_paper_section(const EvaluationSetup& setup) {
  return std::make_unique<PcaPaperSection>(setup);
}

}  // namespace quoin::deploy
