// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/permissions.hpp"

#include <ctime>
#include <set>

#include "services/deployment/graph.hpp"
#include "services/keys/key_files.hpp"

namespace quoin {

namespace {

std::string topics_text(const std::string& verb, const std::vector<std::string>& topics) {
  if (topics.empty()) return "";
  std::string text = "        <" + verb + ">\n          <topics>\n";
  // Names of deployments need no escaping: they are letters, digits, _, / and @.
  for (const std::string& topic : topics) text += "            <topic>" + topic + "</topic>\n";
  return text + "          </topics>\n        </" + verb + ">\n";
}

/// All outputs of the deployment. One pattern for each type keeps the permissions, which travel in
/// one datagram, small however many services there are.
std::vector<std::string> all_outputs(const Deployment& deployment) {
  std::set<std::string> patterns;
  for (const ServiceConfig& service : deployment.services) {
    for (const OutputConfig& output : service.outputs) {
      patterns.insert(service.external() ? output.topic
                                         : output_topic(deployment.name_space, "*", output.type));
    }
  }
  return {patterns.begin(), patterns.end()};
}

}  // namespace

TopicRule rule_of(const Deployment& deployment, const std::string& identity) {
  const std::string status = status_topic(deployment.name_space);
  const std::string request = control_request_topic(deployment.name_space);
  const std::string reply = control_reply_topic(deployment.name_space);
  TopicRule rule{deployment.domain, {}, {}};
  if (identity == operator_identity || identity == observer_identity) {
    rule.reads = all_outputs(deployment);
    rule.reads.push_back(status);
    if (identity == observer_identity) return rule;
    // quoin up asks services, and is asked itself.
    rule.reads.insert(rule.reads.end(), {request, reply});
    rule.writes = {request, reply};
    return rule;
  }
  const ServiceConfig& service = deployment.service(identity);
  for (const OutputConfig& output : service.outputs) rule.writes.push_back(output.topic);
  rule.writes.insert(rule.writes.end(), {status, reply});
  for (const Connection& input : Graph(deployment).inputs_of(service)) {
    rule.reads.push_back(input.output.topic);
  }
  rule.reads.push_back(request);
  return rule;
}

std::string permissions_time(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc)};
}

std::string permissions_text(const std::string& identity, const Validity& validity,
                             const std::vector<TopicRule>& rules) {
  std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <permissions>
    <grant name=")" + identity +
                     "\">\n      <subject_name>CN=" + identity +
                     "</subject_name>\n      <validity>\n        <not_before>" +
                     permissions_time(validity.from) + "</not_before>\n        <not_after>" +
                     permissions_time(validity.until) + "</not_after>\n      </validity>\n";
  for (const TopicRule& rule : rules) {
    text += "      <allow_rule>\n        <domains><id>" + std::to_string(rule.domain) +
            "</id></domains>\n" + topics_text("publish", rule.writes) +
            topics_text("subscribe", rule.reads) + "      </allow_rule>\n";
  }
  return text + R"(      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)";
}

}  // namespace quoin
