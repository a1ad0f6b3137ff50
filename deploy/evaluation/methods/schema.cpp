// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/schema.hpp"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/sensor/sensor_fields.hpp"

namespace quoin::deploy {

namespace {

using Json = nlohmann::ordered_json;

Json described(Json schema, const std::string& description) {
  if (!description.empty()) schema["description"] = description;
  return schema;
}

Json text(const std::string& description = "") {
  return described({{"type", "string"}}, description);
}

/// One of these words, or what a variable of the environment stands for.
Json choice(const std::vector<std::string>& words, const std::string& description = "") {
  return described({{"anyOf", {{{"enum", words}}, {{"type", "string"}, {"pattern", "\\$\\{"}}}}},
                   description);
}

Json object(Json properties, const std::string& description = "") {
  return described(
      {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}},
      description);
}

Json list_of(Json items, const std::string& description = "") {
  return described({{"type", "array"}, {"items", std::move(items)}}, description);
}

/// "[m], 0 to 1, else 0.05: what it does"
std::string description_of(const ParameterInfo& info) {
  std::string head;
  const auto add = [&](const std::string& part) { head += (head.empty() ? "" : ", ") + part; };
  const auto number = [](double value) { return Json(value).dump(); };
  if (!info.unit.empty()) add("[" + info.unit + "]");
  if (std::isfinite(info.minimum) && std::isfinite(info.maximum)) {
    add(number(info.minimum) + " to " + number(info.maximum));
  } else if (std::isfinite(info.minimum)) {
    add("at least " + number(info.minimum));
  } else if (std::isfinite(info.maximum)) {
    add("at most " + number(info.maximum));
  }
  if (!info.default_value.empty()) add("else " + info.default_value);
  return head.empty() ? info.description : head + ": " + info.description;
}

Json parameter(const ParameterInfo& info) {
  const std::string description = description_of(info);
  switch (info.type) {
    case ParameterType::boolean:
      return described({{"type", {"boolean", "string"}}}, description);
    case ParameterType::integer:
      return described({{"type", {"integer", "string"}}}, description);
    case ParameterType::real:  // a text may have a unit
      return described({{"type", {"number", "string"}}}, description);
    case ParameterType::choice:
      return choice(info.choices, description);
    case ParameterType::text:
      break;
  }
  return described({{"type", {"string", "number", "boolean"}}}, description);
}

Json parameters(const std::vector<ParameterInfo>& infos) {
  Json properties = Json::object();
  for (const ParameterInfo& info : infos) properties[info.name] = parameter(info);
  return object(std::move(properties));
}

/// What follows from the kind, and from the method, of a service.
Json conditions_of(const KindInfo& kind) {
  Json then = {{"properties", Json::object()}};
  Json all = Json::array();
  if (kind.methods.empty()) {
    then["properties"]["method"] = false;
    then["properties"]["parameters"] = parameters(kind.parameters);
  } else {
    std::vector<std::string> names;
    for (const MethodInfo& method : kind.methods) {
      names.push_back(method.name);
      Json with = {{"properties", {{"parameters", parameters(method.parameters)}}}};
      all.push_back(
          {{"if",
            {{"properties", {{"method", {{"const", method.name}}}}}, {"required", {"method"}}}},
           {"then", std::move(with)}});
    }
    then["properties"]["method"] = choice(names);
    then["allOf"] = std::move(all);
  }
  if (!kind.is_source()) then["properties"]["sensor"] = false;
  return {{"if", {{"properties", {{"kind", {{"const", kind.name}}}}}, {"required", {"kind"}}}},
          {"then", std::move(then)}};
}

Json service(const KindList& kinds) {
  Json names = Json::array();
  for (const KindInfo* kind : kinds.kinds) {
    names.push_back({{"const", kind->name}, {"description", kind->description}});
  }
  names.push_back({{"type", "string"}, {"pattern", "\\$\\{"}});
  const Json time = {{"type", {"number", "string"}}};
  Json schema =
      object({{"name", text("by which others name it, and part of its topics")},
              {"kind", {{"anyOf", std::move(names)}}},
              {"input", text("the service whose output is read")},
              {"inputs",
               {{"anyOf",
                 {{{"const", "all"}},
                  list_of(text()),
                  {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}}},
                {"description", "port: service; or all or a list of services, for observers"}}},
              {"method", text()},
              {"parameters", {{"type", "object"}}},
              {"sensor", described(parameters(sensor_parameters()), "what is known of the sensor")},
              {"qos", text("preset of the output: sensor, feature, state, lossless")},
              {"topic", text("of kind external: as DDS has it")},
              {"type", text("of kind external: of its messages")},
              {"program", {{"anyOf", {text(), list_of({{"type", {"string", "number"}}})}}}},
              {"restart", choice({"always", "never"})},
              {"host", text("where it runs, in a deployment over several hosts")},
              {"strength", {{"type", {"integer", "string"}}}},
              {"lease", time}});
  schema["required"] = {"name", "kind"};
  Json conditions = Json::array();
  for (const KindInfo* kind : kinds.kinds) conditions.push_back(conditions_of(*kind));
  schema["allOf"] = std::move(conditions);
  return schema;
}

}  // namespace

Json deployment_schema(const KindList& kinds) {
  const Json words = {{"anyOf", {text(), list_of(text())}}};
  Json schema = object(
      {{"version", {{"anyOf", {{{"const", 1}}, {{"const", "1"}}}}}},
       {"namespace", text("prefix of all topics")},
       {"domain", {{"type", {"integer", "string"}}, {"description", "DDS domain, 0 to 232"}}},
       {"qos", text("preset of all outputs that name none: sensor, feature, state, lossless")},
       {"network", object({{"interfaces", words},
                           {"discovery", choice({"multicast", "server", "peers"})},
                           {"peers", words},
                           {"servers", words},
                           {"lease", {{"type", {"number", "string"}}}}},
                          "without it everything stays on 127.0.0.1")},
       {"security", object({{"keys", text("folder of the keys")},
                            {"encrypt", {{"type", {"boolean", "string"}}}}})},
       {"ros", object({{"distro", choice({"humble", "iron", "jazzy", "rolling"})}},
                      "the services are nodes to ros2 node list of that distribution")},
       {"processes",
        {{"type", "object"},
         {"additionalProperties", words},
         {"description", "name: services that run in one process"}}},
       {"services", list_of(service(kinds))}});
  schema["required"] = {"version", "services"};
  Json titled = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "Deployment file of Quoin"}};
  titled.update(schema);
  return titled;
}

}  // namespace quoin::deploy
