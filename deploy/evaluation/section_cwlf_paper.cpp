// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "deploy/evaluation/cwlf_paper_figures.hpp"
#include "deploy/evaluation/figures.hpp"
#include "deploy/evaluation/paper_corners.hpp"
#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t compared_points = 100;  // the paper does not say which of 50 and 100

std::string name_of(const CwlfPaperCorner& corner) {
  return std::string(enum_name(corner.form)) + ", " + std::string(enum_name(corner.covariance)) +
         ", corner of " + fixed(degrees * corner.angle, 0) + " degrees, " +
         std::to_string(corner.points) + " points";
}

nlohmann::ordered_json corner_json(const CwlfPaperCorner& row) {
  nlohmann::ordered_json object{{"angle", row.angle},
                                {"points", row.points},
                                {"method", enum_name(row.form)},
                                {"covariance", enum_name(row.covariance)},
                                {"sigma_x", nullptr},
                                {"sigma_y", nullptr},
                                {"seconds", nullptr}};
  if (row.corner) {
    object["sigma_x"] = std::sqrt(row.corner->covariance(0, 0));
    object["sigma_y"] = std::sqrt(row.corner->covariance(1, 1));
  }
  if (row.times.all > 0.0) {
    object["seconds"] = {{"lines", row.times.lines},
                         {"line_covariances", row.times.line_covariances},
                         {"position", row.times.position},
                         {"covariance", row.times.covariance},
                         {"all", row.times.all}};
  }
  return object;
}

class CwlfPaperSection : public Section {
 public:
  explicit CwlfPaperSection(const EvaluationSetup& setup)
      : seed_(setup.options.seed),
        tables_(published_cwlf_tables()),
        environments_(tables_.size()),
        corners_(cwlf_paper_corners()) {}

  std::vector<Job> jobs() override {
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      jobs.push_back({tables_[k].environment, [this, k](const auto& stop) { measure(k, stop); }});
    }
    for (CwlfPaperCorner& corner : corners_) {
      jobs.push_back({name_of(corner), [this, &corner](const auto&) {
                        compute_corner(corner, noise_, seed_of(corner));
                      }});
    }
    return jobs;
  }

  std::vector<Job> timing_jobs() override {
    std::vector<Job> jobs;
    for (CwlfPaperCorner& corner : corners_) {
      jobs.push_back({"speed of " + name_of(corner), [this, &corner](const auto&) {
                        time_corner(corner, noise_, seed_of(corner));
                      }});
    }
    return jobs;
  }

  void write_json(nlohmann::ordered_json& report) const override {
    auto environments = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      const CwlfPaperEnvironment& result = environments_[k];
      auto methods = nlohmann::ordered_json::array();
      for (const PaperCorners& method : result.methods) methods.push_back(sigmas_json(method));
      environments.push_back({{"environment", result.world},
                              {"points", result.rays},
                              {"walls", result.walls},
                              {"corners", positions_json(result.truth)},
                              {"methods", std::move(methods)}});
      add_published_sigmas(report, tables_[k], corners_in(result.methods), {"mean", mean_of});
    }
    auto corners = nlohmann::ordered_json::array();
    for (const CwlfPaperCorner& corner : corners_) corners.push_back(corner_json(corner));
    report["cwlf_paper"] = {{"range_stddev", data_sheet_model().range_stddev},
                            {"bearing_stddev", data_sheet_model().bearing_stddev},
                            {"noise_range_stddev", noise_.range_stddev},
                            {"noise_bearing_stddev", noise_.bearing_stddev},
                            {"environments", std::move(environments)},
                            {"corners", std::move(corners)}};
    add_decreases(report, "Fig. 4", figure_4_angle, 30.0, 15.0);
    add_decreases(report, "Fig. 5", figure_5_angle, 78.0, 68.0);
    add_share(report, "line covariances, arras_siegwart_literal",
              CornerForm::arras_siegwart_literal, &CornerTimes::line_covariances, 70.0);
    add_share(report, "line covariances, arras_siegwart", CornerForm::arras_siegwart,
              &CornerTimes::line_covariances, 70.0);
    add_share(report, "lines, cwlf", CornerForm::cwlf, &CornerTimes::lines, 60.0);
  }

  void write_html(HtmlPage& page) const override {
    page.paragraph(
        "What section V of the CWLF paper shows, repeated on two simulated worlds with as many "
        "straight sections and corners in sight as it counts. The scans have noise of " +
        noise_text(noise_) +
        " and their points are assigned to the true walls; the covariances are computed, as in "
        "the paper, from the data sheet's figures taken for standard deviations (" +
        noise_text(data_sheet_model()) +
        "). as_published takes, for cwlf, the conditional variances for those of the residuals, "
        "which they never exceed, and leaves, for arras_siegwart, the bearing noise out. "
        "propagated sums the contributions of range and bearing noise of all points.");
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      write_environment(page, tables_[k], environments_[k]);
    }
    write_times(page, corners_);
    write_steps(page, corners_);
  }

  SummaryTable summary() const override {
    SummaryTable rows{
        {"mean sigma x, y", "fitter", "published [mm]", "as_published", "propagated"}};
    const auto pair = [](const std::vector<double>& x, const std::vector<double>& y,
                         double factor) {
      return fixed(factor * mean_of(x).value_or(0.0), 2) + ", " +
             fixed(factor * mean_of(y).value_or(0.0), 2);
    };
    for (std::size_t k = 0; k < tables_.size(); ++k) {
      for (const PublishedSigmas& published : tables_[k].methods) {
        std::vector<std::string> row{tables_[k].environment, published.method,
                                     pair(published.x, published.y, 1.0)};
        for (const CovarianceMode mode : paper_modes) {
          const CornerSigmas sigmas =
              sigmas_of(method_of(environments_[k].methods, published.method, mode));
          row.push_back(pair(sigmas.x, sigmas.y, 1e3));
        }
        rows.push_back(std::move(row));
      }
    }
    for (const CornerForm form : {CornerForm::arras_siegwart, CornerForm::arras_siegwart_literal}) {
      std::vector<std::string> row{"time over cwlf, " + std::to_string(compared_points) + " points",
                                   std::string(enum_name(form)), "-"};
      for (const CovarianceMode mode : paper_modes) {
        row.push_back(
            text(time_over_cwlf(corners_, figure_4_angle, compared_points, form, mode), 2));
      }
      rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  void measure(std::size_t k, const std::stop_token& stop) {
    const World world = built_in_world(tables_[k].environment).value();
    std::vector<NamedFitter> named;
    for (const CovarianceMode mode : paper_modes) {
      for (const PublishedSigmas& published : tables_[k].methods) {
        const std::string& fitter = published.method;
        named.push_back(
            {fitter, mode, stoppable(make_fitter(fitter, std::string(enum_name(mode))), stop)});
      }
    }
    environments_[k] =
        measure_cwlf_paper(world, named, noise_, derived_seed(seed_, "cwlf_paper/" + world.name));
  }

  /// The same for each method and mode.
  [[nodiscard]] std::uint64_t seed_of(const CwlfPaperCorner& corner) const {
    return derived_seed(seed_, "cwlf_paper/" + fixed(degrees * corner.angle, 0) + "/" +
                                   std::to_string(corner.points));
  }

  /// By how much the sigmas of cwlf lie below those of arras_siegwart.
  void add_decreases(nlohmann::ordered_json& report, const char* figure, double angle,
                     double published_x, double published_y) const {
    for (const CovarianceMode mode : paper_modes) {
      const auto corner_of = [&](CornerForm form) {
        return find_corner(corners_, angle, compared_points, form, mode);
      };
      const CwlfPaperCorner* cwlf = corner_of(CornerForm::cwlf);
      const CwlfPaperCorner* other = corner_of(CornerForm::arras_siegwart);
      for (const int axis : {0, 1}) {
        std::optional<double> measured;
        if (cwlf != nullptr && other != nullptr && cwlf->corner && other->corner) {
          measured = 100.0 * (1.0 - std::sqrt(cwlf->corner->covariance(axis, axis) /
                                              other->corner->covariance(axis, axis)));
        }
        add_published(report,
                      {tables_.front().paper, figure,
                       std::string("decrease of ") + (axis == 0 ? "sigma_x" : "sigma_y") +
                           " from arras_siegwart to cwlf, corner of " + fixed(degrees * angle, 0) +
                           " degrees, " + std::string(enum_name(mode)) + " here",
                       "%", axis == 0 ? published_x : published_y, measured});
      }
    }
  }

  /// Share of one step in the time of all four.
  void add_share(nlohmann::ordered_json& report, const std::string& step, CornerForm form,
                 double CornerTimes::*time, double published) const {
    std::optional<double> measured;
    const CwlfPaperCorner* corner =
        find_corner(corners_, figure_4_angle, compared_points, form, CovarianceMode::as_published);
    if (corner != nullptr && corner->times.all > 0.0) {
      const CornerTimes& times = corner->times;
      measured = 100.0 * times.*time /
                 (times.lines + times.line_covariances + times.position + times.covariance);
    }
    add_published(report, {tables_.front().paper, "Figs. 4 and 5", "share of time, " + step, "%",
                           published, measured});
  }

  std::uint64_t seed_;
  SensorModel noise_ = rplidar_noise(0.010);
  std::vector<PublishedTable> tables_;
  std::vector<CwlfPaperEnvironment> environments_;
  std::vector<CwlfPaperCorner> corners_;
};

}  // namespace

std::unique_ptr<Section> make_cwlf_paper_section(const EvaluationSetup& setup) {
  return std::make_unique<CwlfPaperSection>(setup);
}

}  // namespace quoin::deploy
