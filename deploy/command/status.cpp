// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/text/printable.hpp"
#include "deploy/command/commands.hpp"
#include "deploy/command/network_options.hpp"
#include "deploy/observation/heartbeats.hpp"
#include "deploy/observation/summary.hpp"
#include "deploy/observation/table.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin::deploy {

namespace {

struct StatusOptions {
  std::string file;
  NetworkOptions network;
  double wait = 2.0;  // [s]
  bool json = false;
};

/// A line of the table, and the heartbeat it is from; none for a service that was not heard.
struct Row {
  ServiceFigures figures;
  std::string name_space;
  std::optional<msg::ServiceStatus> status;
};

Row row_of(const std::string& name_space, const msg::ServiceStatus& status) {
  Row row{
      {status.service(), status.kind(), status.method(), report_of(status), 0}, name_space, status};
  row.figures.host = status.host();
  row.figures.age = std::max(0.0, 1e-9 * static_cast<double>(runtime::now_ns() - status.stamp()));
  return row;
}

struct Heard {
  std::vector<Row> rows;
  std::vector<std::string> unreadable;  ///< HeartbeatListener::unreadable
};

/// The services of the deployment, then those of others; of all namespaces when there is no
/// deployment and `one_namespace` is false.
Heard collect(const Deployment& deployment, bool one_namespace, double wait) {
  HeartbeatListener listener(deployment, "quoin_status", !one_namespace);
  listener.listen(wait, [&] {
    const auto newest = listener.newest();
    for (const ServiceConfig& service : deployment.services) {
      if (!newest.contains({deployment.name_space, label(service)})) return false;
    }
    return !deployment.services.empty();
  });
  auto newest = listener.newest();
  std::vector<Row> rows;
  for (const ServiceConfig& service : deployment.services) {
    const auto heard = newest.find({deployment.name_space, label(service)});
    if (heard != newest.end()) {
      rows.push_back(row_of(deployment.name_space, heard->second.newest));
      newest.erase(heard);
    } else {
      Row silent{{label(service), service.kind, service.method, {}, 0}, deployment.name_space, {}};
      silent.figures.report.state = "silent";
      silent.figures.host = service.host;
      rows.push_back(std::move(silent));
    }
  }
  for (const auto& [key, heard] : newest) rows.push_back(row_of(key.first, heard.newest));
  // A name is enough where there is one namespace.
  for (Row& row : rows) {
    if (row.name_space == rows.front().name_space && row.name_space == rows.back().name_space) {
      continue;
    }
    row.figures.name = row.name_space + "/" + row.figures.name;
  }
  return {std::move(rows), listener.unreadable()};
}

std::vector<std::string> foreign_writers_of(const std::vector<Row>& rows) {
  std::vector<const msg::ServiceStatus*> statuses;
  for (const Row& row : rows) {
    if (row.status) statuses.push_back(&*row.status);
  }
  return foreign_writers(statuses);
}

std::vector<std::string> version_lines_of(const std::vector<Row>& rows) {
  std::vector<std::pair<std::string, const msg::ServiceStatus*>> services;
  for (const Row& row : rows) {
    if (row.status) services.emplace_back(row.figures.name, &*row.status);
  }
  return version_lines(services);
}

void print(const std::vector<Row>& rows) {
  std::vector<ServiceFigures> services;
  for (const Row& row : rows) services.push_back(row.figures);
  for (const std::string& text : status_lines(services)) std::cout << text << '\n';
  for (const std::string& text : version_lines_of(rows)) std::cout << text << '\n';
  for (const std::string& text : foreign_writers_of(rows)) std::cout << text << '\n';
  for (const Row& row : rows) {
    if (!row.status) continue;
    const std::string& name = row.figures.name;
    if (!row.status->detail().empty())
      std::cout << name << ": " << printable(row.status->detail()) << '\n';
    for (const msg::InputStatus& input : row.status->inputs()) {
      if (input.unjoined() == 0) continue;
      std::cout << name << ": " << input.unjoined() << " results without a message of port "
                << input.port() << '\n';
    }
    for (const std::string& complaint : input_complaints(*row.status)) {
      std::cout << name << ": " << complaint << '\n';
    }
    for (const std::string& mismatch : row.status->incompatible_qos()) {
      std::cout << name << ": incompatible QoS: " << printable(mismatch) << '\n';
    }
    for (const msg::Diagnostic& diagnostic : row.status->diagnostics()) {
      std::cout << name << ": " << diagnostic.name() << ": " << printable(diagnostic.value())
                << '\n';
    }
    const auto scatter = line_scatter_of(*row.status);
    const std::string complaint_of_it = scatter ? complaint(*scatter) : "";
    if (!complaint_of_it.empty()) {
      std::cout << name << ": " << complaint_of_it << "; " << scatter_advice << '\n';
    }
  }
}

nlohmann::ordered_json inputs_of(const msg::ServiceStatus& status,
                                 nlohmann::ordered_json& matched) {
  auto inputs = nlohmann::ordered_json::array();
  std::uint64_t writers = 0;
  for (const msg::InputStatus& input : status.inputs()) {
    writers += input.writers();
    auto refused = nlohmann::ordered_json::object();
    for (const msg::LossCount& count : input.refused()) refused[count.cause()] = count.count();
    inputs.push_back({{"port", input.port()},
                      {"topic", input.topic()},
                      {"writers", input.writers()},
                      {"received", input.received()},
                      {"lost", input.lost()},
                      {"upstream_lost", input.upstream_lost()},
                      {"duplicates", input.duplicates()},
                      {"unjoined", input.unjoined()},
                      {"refused", std::move(refused)}});
  }
  matched = writers;
  return inputs;
}

nlohmann::ordered_json outputs_of(const msg::ServiceStatus& status,
                                  nlohmann::ordered_json& matched) {
  auto outputs = nlohmann::ordered_json::array();
  std::uint64_t readers = 0;
  for (const msg::OutputStatus& output : status.outputs()) {
    readers += output.readers();
    outputs.push_back({{"topic", output.topic()},
                       {"readers", output.readers()},
                       {"published", output.published()},
                       {"lost", output.lost()}});
  }
  matched = readers;
  return outputs;
}

void print_json(const Heard& heard) {
  const std::vector<Row>& rows = heard.rows;
  nlohmann::ordered_json services = nlohmann::ordered_json::object();
  for (const Row& row : rows) {
    auto object = service_summary(row.figures);
    object.erase("restarts");  // known to the supervisor only
    object["namespace"] = row.name_space;
    if (row.status) {
      const msg::ServiceStatus& status = *row.status;
      object["detail"] = status.detail();
      object["rate_hz"] = status.rate();
      object["host"] = status.host();
      object["version"] = status.version();
      object["dds"] = status.dds();
      object["pid"] = status.pid();
      object["incarnation"] = status.incarnation();
      object["stamp"] = status.stamp();
      object["age_s"] = row.figures.age;
      object["matched_inputs"] = 0;
      object["matched_outputs"] = 0;
      object["inputs"] = inputs_of(status, object["matched_inputs"]);
      object["outputs"] = outputs_of(status, object["matched_outputs"]);
      object["control_dropped"] = status.control_dropped();
      object["incompatible_qos"] = status.incompatible_qos();
      auto diagnostics = nlohmann::ordered_json::object();
      for (const msg::Diagnostic& diagnostic : status.diagnostics()) {
        diagnostics[diagnostic.name()] = diagnostic.value();
      }
      object["diagnostics"] = diagnostics;
      if (const auto scatter = line_scatter_of(status)) {
        const Interval& reduced = scatter->reduced_chi_square;
        const Interval& inside = scatter->split_inside95;
        object["line_scatter"] = {{"lines", scatter->lines},
                                  {"reduced_chi_square", reduced.value},
                                  {"reduced_chi_square_interval", {reduced.low, reduced.high}},
                                  {"odd_even_lines", scatter->split_lines},
                                  {"odd_even_inside95", inside.value},
                                  {"odd_even_inside95_interval", {inside.low, inside.high}},
                                  {"complaint", complaint(*scatter)}};
      }
    }
    services[row.figures.name] = object;
  }
  const nlohmann::ordered_json object{{"services", services},
                                      {"foreign_writers", foreign_writers_of(rows)},
                                      {"unreadable", heard.unreadable}};
  std::cout << object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

int run(const StatusOptions& options, bool one_namespace) {
  const Deployment deployment = deployment_to_reach(options.network, options.file);
  const Heard all = collect(deployment, one_namespace, options.wait);
  const std::vector<Row>& rows = all.rows;
  if (options.json) {
    print_json(all);
  } else {
    if (!rows.empty()) print(rows);
    for (const std::string& text : all.unreadable) {
      std::cout << "heartbeats are not read: " << printable(text) << '\n';
    }
  }
  bool healthy = true;
  bool heard = false;
  for (const Row& row : rows) {
    const std::string& state = row.figures.report.state;
    heard = heard || row.status.has_value();
    healthy = healthy && state != "silent" && state != "failed";
  }
  if (!heard) {
    std::cerr << "no service"
              << (one_namespace ? " of namespace '" + deployment.name_space + "'" : "")
              << " reports in domain " << deployment.domain << "; is it running?\n";
  }
  return heard && healthy ? exit_ok : exit_failure;
}

}  // namespace

Command add_status(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "status",
      "Show what the running services report, on this host and on others; fails when one is silent "
      "or failed");
  const auto options = std::make_shared<StatusOptions>();
  CLI::Option* file = line->add_option("file", options->file, "Deployment file (YAML)");
  add_network_options(*line, options->network, file);
  const CLI::Option* name_space = line->get_option("--namespace");
  line->add_option("--wait", options->wait, "How long to listen [s]")
      ->capture_default_str()
      ->transform(a_time());
  line->add_flag("--json", options->json, "As a JSON object");
  return {line, [=] { return run(*options, file->count() + name_space->count() > 0); }};
}

}  // namespace quoin::deploy
