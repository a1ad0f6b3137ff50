// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <sys/utsname.h>
#include <unistd.h>
#include <vector>

#include "deploy/bundle/archive.hpp"
#include "deploy/bundle/captured_run.hpp"
#include "deploy/bundle/redaction.hpp"
#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/launch.hpp"
#include "services/deployment/deployment.hpp"
#include "services/deployment/graph.hpp"
#include "services/files/atomic_file.hpp"
#include "services/files/regular_file.hpp"

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;

constexpr std::size_t longest_log = 1 << 20;  // bytes, from the end
constexpr milliseconds longest_step{15000};

struct BundleOptions {
  std::string file;
  std::string output;
  std::vector<std::string> logs;
};

/// Collects files, each without secrets and with a line that says what it is.
class Bundle {
 public:
  void add(const std::string& name, const std::string& what, const std::string& text) {
    files_.push_back({"quoin-bundle/" + name, redaction_(text)});
    contents_ +=
        name + ": " + what + ", " + std::to_string(files_.back().content.size()) + " bytes\n";
  }
  [[nodiscard]] const std::string& contents() const { return contents_; }
  [[nodiscard]] std::string archive() const {
    std::vector<ArchivedFile> files = files_;
    files.insert(files.begin(), {"quoin-bundle/contents.txt", contents_});
    return tar_gz(files);
  }

 private:
  static std::vector<std::string> environment() {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable)
      variables.emplace_back(*variable);
    return variables;
  }

  Redaction redaction_{environment()};
  std::vector<ArchivedFile> files_;
  std::string contents_;
};

std::string text_of(const std::filesystem::path& file) {
  std::string text;
  const std::string problem = read_regular(file, std::size_t{64} << 20, text);
  if (!problem.empty()) return "(" + file.string() + ": " + problem + ")\n";
  return text;
}

std::string system_text() {
  utsname names{};
  ::uname(&names);
  std::string text = std::string(names.sysname) + " " + names.release + " " + names.machine + ", " +
                     std::to_string(::sysconf(_SC_NPROCESSORS_ONLN)) + " processors\n";
  return text + text_of("/etc/os-release");
}

/// What this program's other commands say, as a user would see it.
std::string own(std::vector<std::string> words) {
  words.insert(words.begin(), std::filesystem::read_symlink("/proc/self/exe").string());
  return captured_run(words, longest_step);
}

void add_scans(const Deployment& deployment, Bundle& bundle) {
  for (const ServiceConfig& service : deployment.services) {
    if (!service.inputs.empty() || service.outputs.empty()) continue;
    bundle.add("scan-" + service.name + ".json", "one scan of the source " + service.name,
               own({"echo", deployment.file.string(), service.name, "--count", "1", "--json"}));
  }
}

void add_deployment(const std::string& file, Bundle& bundle) {
  bundle.add("deployment.yaml", file, text_of(file));
  bundle.add("check.txt", "quoin check", own({"check", file}));
  bundle.add("status.json", "quoin status", own({"status", file, "--json"}));
  bundle.add("doctor.txt", "quoin doctor", own({"doctor", file}));
  try {
    const Deployment deployment = load_deployment(file);
    add_scans(deployment, bundle);
    bundle.add("journal.txt", "the last lines of the services in the journal of systemd",
               captured_run({"journalctl", "--no-pager", "--lines", "2000", "--unit",
                             "quoin-" + deployment.name_space + "*", "--unit", "quoin@*"},
                            longest_step));
  } catch (const DeploymentError&) {
    // check.txt says what is wrong with it.
  }
}

int run(const BundleOptions& options) {
  Bundle bundle;
  bundle.add("version.json", "quoin version", own({"version", "--json"}));
  bundle.add("system.txt", "kernel and distribution", system_text());
  if (options.file.empty()) {
    bundle.add("doctor.txt", "quoin doctor", own({"doctor"}));
  } else {
    add_deployment(options.file, bundle);
  }
  for (std::size_t i = 0; i < options.logs.size(); ++i) {
    std::string text = text_of(options.logs[i]);
    if (text.size() > longest_log) text.erase(0, text.size() - longest_log);
    bundle.add("log-" + std::to_string(i + 1) + ".txt", "the end of " + options.logs[i], text);
  }
  if (const int error = write_atomically(options.output, bundle.archive(), 0600); error != 0) {
    throw std::runtime_error(options.output + " cannot be written: " + std::strerror(error));
  }
  std::cout
      << options.output << " holds:\n"
      << bundle.contents()
      << "Values of what is called token, password, secret or key are hidden, and so is what "
         "environment variables of such names hold. Look through it before you give it away.\n";
  return exit_ok;
}

}  // namespace

Command add_bundle(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("bundle", "Collect what a bug report needs, without secrets, in one file");
  const auto options = std::make_shared<BundleOptions>();
  line->add_option("file", options->file, "Deployment file (YAML); it should be running");
  line->add_option("-o,--output", options->output, "File to write (.tar.gz)")->required();
  line->add_option("--log", options->logs, "A log whose end goes with it; may be repeated");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
