// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "services/deployment/deployment.hpp"
#include "services/keys/key_directory.hpp"
#include "services/keys/key_files.hpp"

namespace quoin::deploy {

namespace {

struct KeyOptions {
  std::string directory;
  std::vector<std::string> names;
  std::string file;  // of the deployment
  int days = 825;
  bool force = false;
};

std::string date(std::chrono::system_clock::time_point time) {
  return permissions_time(time).substr(0, 10);
}

int init(const KeyOptions& options) {
  make_key_directory(options.directory, options.days, options.force);
  std::cout << options.directory << ": made an authority, valid until "
            << date(valid_for_days(options.days).until) << "\nkeep "
            << authority_key(options.directory).string()
            << " away from the robot: who has it can make identities\nnext: quoin keys add "
            << options.directory << " --deployment FILE\n";
  return exit_ok;
}

int add(const KeyOptions& options) {
  const KeyPair authority = load_authority(options.directory);
  std::vector<std::string> names = options.names;
  if (!options.file.empty()) {
    // What is there already stays: so the command can be given again when a service was added.
    for (const std::string& name : identities_of(load_deployment(options.file))) {
      const bool there =
          std::filesystem::exists(identity_files(options.directory, name).private_key);
      if (options.force || !there) names.push_back(name);
    }
    if (names.empty()) std::cout << "all identities are there already\n";
  }
  const Validity validity = valid_for_days(options.days);
  for (const std::string& name : names) {
    add_identity(options.directory, authority, name, validity, options.force);
    std::cout << identity_folder(options.directory, name).string() << ": valid until "
              << date(validity.until) << '\n';
  }
  std::cout << "next: quoin keys permissions " << options.directory << ' '
            << (options.file.empty() ? "FILE" : options.file) << '\n';
  return exit_ok;
}

void tell_what_to_copy(const KeyOptions& options, const Deployment& deployment) {
  std::map<std::string, std::vector<std::string>> hosts;
  for (const ProcessConfig& process : processes_of(deployment)) {
    const ServiceConfig& first = *process.services.front();
    if (!first.host.empty() && !first.external()) hosts[first.host].push_back(process.name);
  }
  if (hosts.empty()) return;
  std::cout << "of " << options.directory << ", copy to\n";
  for (const auto& [host, labels] : hosts) {
    std::cout << "  " << host << ": trust";
    for (const std::string& name : labels) std::cout << " identities/" << name;
    std::cout << '\n';
  }
  std::cout << "and identities/" << operator_identity << " to where `quoin up`, swap and set run, "
            << "identities/" << observer_identity
            << " to where status, echo, draw, compare and doctor do\n";
}

int sign_permissions(const KeyOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  const KeyPair authority = load_authority(options.directory);
  const Validity validity = valid_for_days(options.days);
  write_governance(options.directory, authority);
  const std::vector<std::string> there = identities_in(options.directory);
  std::set<std::string> left(there.begin(), there.end());
  std::size_t signed_count = 0;
  bool complete = true;
  for (const std::string& name : identities_of(deployment)) {
    if (left.erase(name) == 0) {
      std::cerr << "there is no identity '" << name << "'; quoin keys add " << options.directory
                << ' ' << name << " makes it\n";
      complete = false;
      continue;
    }
    write_permissions(options.directory, authority, name, validity, {rule_of(deployment, name)});
    ++signed_count;
  }
  std::cout << "signed the permissions of " << signed_count << " identities in domain "
            << deployment.domain << ", valid until " << date(validity.until) << '\n';
  for (const std::string& name : left) {
    std::cout << "'" << name
              << "' is not in the deployment: what it was permitted before counts on; "
              << "quoin keys revoke " << options.directory << ' ' << name << " ends that\n";
  }
  tell_what_to_copy(options, deployment);
  return complete ? exit_ok : exit_failure;
}

int revoke_all(const KeyOptions& options) {
  const KeyPair authority = load_authority(options.directory);
  for (const std::string& name : options.names) revoke_identity(options.directory, authority, name);
  std::cout << "copy " << trust_files(options.directory, true).revoked.string()
            << " to every host and start the services there again; a new identity is made by quoin "
               "keys add --force\n";
  return exit_ok;
}

using Options = std::shared_ptr<KeyOptions>;

CLI::App* add_step(CLI::App& line, const std::string& name, const std::string& text,
                   const Options& options) {
  CLI::App* step = line.add_subcommand(name, text);
  step->add_option("directory", options->directory, "Folder of the keys")->required();
  return step;
}

void add_days(CLI::App& step, const Options& options, int days) {
  step.add_option_function<int>(
          "--days", [options](int value) { options->days = value; },
          "How long it is valid [days], " + std::to_string(days) + " by default")
      ->check(CLI::Range(1, 36500));
}

}  // namespace

Command add_keys(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "keys", "Make the keys, certificates and permissions that `security:` of a deployment needs");
  line->require_subcommand(1);
  const auto options = std::make_shared<KeyOptions>();
  CLI::App* const first = add_step(*line, "init", "Make a certificate authority", options);
  add_days(*first, options, 3650);
  first->add_flag("--force", options->force, "Replace an authority; its identities are void then");

  CLI::App* const second = add_step(*line, "add", "Make identities", options);
  CLI::Option* names = second->add_option("names", options->names,
                                          "Services by name (NAME@STRENGTH where there are "
                                          "instances), processes of several services by "
                                          "theirs, quoin-operator (up, swap, set), "
                                          "quoin-observer (status, echo, draw, compare, doctor)");
  second
      ->add_option("--deployment", options->file,
                   "Deployment file (YAML): all of its identities that are not there yet")
      ->excludes(names);
  add_days(*second, options, 825);
  second->add_flag("--force", options->force, "Replace identities, as before they expire");

  CLI::App* const third = add_step(
      *line, "permissions",
      "Sign what each identity of a deployment may write and read, and nothing else", options);
  third->add_option("file", options->file, "Deployment file (YAML)")->required();
  add_days(*third, options, 825);

  CLI::App* const fourth = add_step(
      *line, "revoke", "Put the certificates of identities on the list of revoked ones", options);
  fourth->add_option("names", options->names, "Identities")->required();

  return {line, [=] {
            if (first->parsed()) {
              if (first->count("--days") == 0) options->days = 3650;
              return init(*options);
            }
            if (second->parsed()) {
              if (options->names.empty() && options->file.empty()) {
                throw DeploymentError({"name the identities to make, or --deployment FILE"});
              }
              return add(*options);
            }
            return third->parsed() ? sign_permissions(*options) : revoke_all(*options);
          }};
}

}  // namespace quoin::deploy
