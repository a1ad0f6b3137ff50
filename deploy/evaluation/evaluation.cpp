// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/evaluation.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "deploy/evaluation/sections.hpp"
#include "deploy/observation/table.hpp"
#include "services/files/atomic_file.hpp"

namespace quoin::deploy {

namespace {

struct Part {
  const SectionKind* kind;
  std::unique_ptr<Section> section;
};

bool wanted(const SectionKind& kind, const EvaluationSetup& setup) {
  const std::vector<std::string>& only = setup.options.only;
  if (kind.name == scan_files_section && setup.scan_files.empty()) return false;
  return only.empty() || std::find(only.begin(), only.end(), kind.name) != only.end();
}

/// Jobs and the part that each belongs to.
struct Work {
  std::vector<Job> jobs;
  std::vector<std::size_t> parts;

  void add(std::vector<Job> more, std::size_t part) {
    for (Job& job : more) {
      jobs.push_back(std::move(job));
      parts.push_back(part);
    }
  }
};

/// Reports two rounds of jobs as one.
class Progress {
 public:
  Progress(const std::vector<Part>& parts,
           const std::function<bool(const EvaluationProgress&)>& proceed)
      : parts_(parts), proceed_(proceed), left_(parts.size(), 0) {}

  void expect(const Work& work) {
    for (const std::size_t part : work.parts) ++left_[part];
    progress_.total += work.jobs.size();
  }

  void run(const Work& work, std::size_t threads) {
    const std::size_t before = progress_.done;
    std::vector<bool> known(work.jobs.size(), false);
    const auto update = [&](const JobProgress& jobs) {
      progress_.done = before;
      for (std::size_t i = 0; i < known.size(); ++i) {
        progress_.done += jobs.done[i] ? 1 : 0;
        if (jobs.name == work.jobs[i].name) progress_.section = parts_[work.parts[i]].kind->name;
        if (!jobs.done[i] || known[i]) continue;
        known[i] = true;
        if (--left_[work.parts[i]] == 0) {
          progress_.finished.push_back(parts_[work.parts[i]].kind->name);
        }
      }
      progress_.job = jobs.name;
      return proceed_(progress_);
    };
    run_jobs(work.jobs, threads, update);
  }

 private:
  const std::vector<Part>& parts_;
  const std::function<bool(const EvaluationProgress&)>& proceed_;
  std::vector<std::size_t> left_;  // jobs of each part
  EvaluationProgress progress_;
};

/// Nothing that does not change the numbers: threads are left out.
nlohmann::ordered_json options_json(const EvaluationSetup& setup) {
  const EvaluationOptions& options = setup.options;
  return {{"segmenters", setup.segmenters},
          {"fitters", setup.fitters},
          {"worlds", options.worlds},
          {"scans", options.scans},
          {"scan_noise",
           {{"range_stddev", options.scan_noise.range_stddev},
            {"range_stddev_per_metre", options.scan_noise.range_stddev_per_metre},
            {"bearing_stddev", options.scan_noise.bearing_stddev},
            {"flatness_stddev", options.scan_noise.flatness_stddev}}},
          {"only", options.only},
          {"trials", options.trials},
          {"scans_per_world", options.scans_per_world},
          {"timing", options.timing}};
}

std::string html_report(const EvaluationSetup& setup, const std::vector<Part>& parts) {
  HtmlPage page("Evaluation of Quoin", "Version " + setup.options.version + ", seed " +
                                           std::to_string(setup.options.seed) +
                                           ". Figures are in "
                                           "report.json, too.");
  for (const Part& part : parts) {
    page.heading(2, part.kind->title);
    part.section->write_html(page);
  }
  return page.finish();
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  const int error = write_atomically(file, text, 0644);
  if (error != 0) {
    throw std::runtime_error(file.string() +
                             ": cannot be written: " + std::generic_category().message(error));
  }
}

}  // namespace

EvaluationReport evaluate(const EvaluationSetup& setup,
                          const std::function<bool(const EvaluationProgress&)>& proceed) {
  std::vector<Part> parts;
  for (const SectionKind& kind : section_kinds()) {
    if (wanted(kind, setup)) parts.push_back({&kind, kind.make(setup)});
  }
  Work computing, timing;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    computing.add(parts[k].section->jobs(), k);
    if (setup.options.timing) timing.add(parts[k].section->timing_jobs(), k);
  }
  Progress progress(parts, proceed);
  progress.expect(computing);
  progress.expect(timing);
  progress.run(computing, setup.options.threads);
  progress.run(timing, 1);

  EvaluationReport report;
  nlohmann::ordered_json json{{"version", setup.options.version},
                              {"seed", setup.options.seed},
                              {"trials", setup.options.trials},
                              {"options", options_json(setup)},
                              {"fitters", nlohmann::ordered_json::array()},
                              {"fit_times", nlohmann::ordered_json::array()},
                              {"segmenters", nlohmann::ordered_json::array()},
                              {"published", nlohmann::ordered_json::array()}};
  for (const Part& part : parts) {
    part.section->write_json(json);
    const SummaryTable table = part.section->summary();
    if (table.size() < 2) continue;
    if (!report.summary.empty()) report.summary.emplace_back();
    report.summary.push_back(part.kind->title);
    append_table(table, 2, std::string::npos, report.summary);
  }
  report.json = json.dump(2) + "\n";
  report.html = html_report(setup, parts);
  return report;
}

void write_report(const EvaluationReport& report, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": cannot be made: " + error.message());
  write_file(folder / "report.json", report.json);
  write_file(folder / "report.html", report.html);
}

}  // namespace quoin::deploy
