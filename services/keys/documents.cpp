// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/documents.hpp"

#include <algorithm>
#include <ctime>
#include <set>

#include "services/deployment/graph.hpp"
#include "services/keys/key_files.hpp"

namespace quoin {

std::string governance_text(bool encrypt) {
  const std::string kind = encrypt ? "ENCRYPT" : "SIGN";
  // Content is encrypted (or signed) and each submessage signed with keys that only the readers and
  // writers of the topic get. Whole messages are not signed on top of that: Fast DDS 2.9 then fills
  // them until there is no room for the signature, and ends the process when many are sent again.
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>232</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>)" +
         kind + R"(</discovery_protection_kind>
      <liveliness_protection_kind>)" +
         kind + R"(</liveliness_protection_kind>
      <rtps_protection_kind>NONE</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>SIGN</metadata_protection_kind>
          <data_protection_kind>)" +
         kind + R"(</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";
}

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
  const std::vector<ProcessConfig> processes = processes_of(deployment);
  const auto process = std::ranges::find(processes, identity, &ProcessConfig::name);
  if (process == processes.end()) {
    throw std::out_of_range(deployment.file.string() + ": no process '" + identity + "'");
  }
  std::set<std::string> reads;
  const Graph graph(deployment);
  for (const ServiceConfig* service : process->services) {
    if (service->info != nullptr && service->info->observer) reads.insert(status);
    for (const OutputConfig& output : service->outputs) rule.writes.push_back(output.topic);
    for (const Connection& input : graph.inputs_of(*service)) reads.insert(input.output.topic);
  }
  rule.writes.insert(rule.writes.end(), {status, reply});
  rule.reads.assign(reads.begin(), reads.end());
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

std::string sign_document(const std::string& text, const KeyPair& authority) {
  // Signed while it is written, hence PKCS7_STREAM.
  constexpr int flags = PKCS7_DETACHED | PKCS7_TEXT | PKCS7_STREAM;
  const OpensslBio content = memory_bio(text);
  const OpensslBio document = memory_bio();
  const OpensslSigned signature(
      PKCS7_sign(authority.certificate.get(), authority.key.get(), nullptr, content.get(), flags));
  require(signature != nullptr &&
              SMIME_write_PKCS7(document.get(), signature.get(), content.get(), flags) == 1,
          "sign a document");
  return text_of(document.get());
}

std::string verify_document(const std::string& document, X509* authority) {
  const OpensslBio input = memory_bio(document);
  BIO* detached = nullptr;
  const OpensslSigned signature(SMIME_read_PKCS7(input.get(), &detached));
  const OpensslBio content(detached);
  require(signature != nullptr, "read it as a signed document");
  const std::unique_ptr<X509_STORE, OpensslDeleter<X509_STORE_free>> store(X509_STORE_new());
  require(store != nullptr && X509_STORE_add_cert(store.get(), authority) == 1,
          "check a signed document");
  const OpensslBio output = memory_bio();
  require(PKCS7_verify(signature.get(), nullptr, store.get(), content.get(), output.get(),
                       PKCS7_TEXT) == 1,
          "verify a signed document");
  std::string text = text_of(output.get());
  std::erase(text, '\r');
  return text;
}

}  // namespace quoin
