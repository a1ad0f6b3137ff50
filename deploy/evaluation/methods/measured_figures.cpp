// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/measured_figures.hpp"

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

namespace quoin::deploy {

namespace {

/// An object of the report, which knows where it is.
class Node {
 public:
  Node(const nlohmann::json& json, std::string place) : json_(json), place_(std::move(place)) {
    if (!json.is_object()) throw ReportError(place_ + " is not an object");
  }

  [[nodiscard]] std::string text(const char* name) const {
    return value(name, "a text", &nlohmann::json::is_string).get<std::string>();
  }
  [[nodiscard]] double number(const char* name) const {
    return value(name, "a number", &nlohmann::json::is_number).get<double>();
  }
  [[nodiscard]] std::uint64_t count(const char* name) const {
    return value(name, "a whole number", &nlohmann::json::is_number_unsigned).get<std::uint64_t>();
  }
  [[nodiscard]] std::optional<double> number_or_null(const char* name) const {
    if (member(name).is_null()) return std::nullopt;
    return number(name);
  }
  [[nodiscard]] SensorModel noise() const {
    SensorModel noise;
    noise.range_stddev = number("range_stddev");
    noise.bearing_stddev = number("bearing_stddev");
    return noise;
  }
  [[nodiscard]] std::vector<Node> objects(const char* name) const {
    std::vector<Node> nodes;
    for (const nlohmann::json& json : value(name, "an array", &nlohmann::json::is_array)) {
      nodes.emplace_back(json, place_ + ": " + name + "[" + std::to_string(nodes.size()) + "]");
    }
    return nodes;
  }

 private:
  [[nodiscard]] const nlohmann::json& member(const char* name) const {
    const auto found = json_.find(name);
    if (found == json_.end()) {
      throw ReportError(place_ + ": no '" + name + "'; quoin evaluate writes the report anew");
    }
    return *found;
  }

  [[nodiscard]] const nlohmann::json& value(const char* name, const char* type,
                                            bool (nlohmann::json::*is)() const noexcept) const {
    const nlohmann::json& json = member(name);
    if (!(json.*is)()) throw ReportError(place_ + ": '" + name + "' is not " + type);
    return json;
  }

  const nlohmann::json& json_;
  std::string place_;
};

}  // namespace

MeasuredFigures parse_figures(std::string_view text, const std::string& name) {
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw ReportError(name + ": not JSON from byte " + std::to_string(error.byte) + " on");
  } catch (const nlohmann::json::exception&) {
    throw ReportError(name + ": a number is too large");
  }
  const Node report(json, name);
  MeasuredFigures figures{
      report.text("version"), report.count("seed"), report.count("trials"), {}, {}, {}};
  for (const Node& entry : report.objects("fitters")) {
    figures.fitters.push_back({entry.text("name"), entry.text("covariance"),
                               entry.text("environment"), entry.noise(),
                               entry.number_or_null("nees"), entry.number_or_null("coverage95"),
                               entry.number_or_null("rmse_over_crb")});
  }
  for (const Node& entry : report.objects("segmenters")) {
    figures.segmenters.push_back({entry.text("name"), entry.noise(), entry.count("scans"),
                                  entry.number("true_positive_rate"),
                                  entry.number("false_positive_rate"),
                                  entry.number_or_null("scans_per_second")});
  }
  for (const Node& entry : report.objects("fit_times")) {
    figures.fit_times.push_back({entry.text("name"), entry.count("points"),
                                 entry.number_or_null("seconds"),
                                 entry.number_or_null("over_covariance")});
  }
  return figures;
}

MeasuredFigures read_figures(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream in;
  // Reading a folder is not refused before its first byte.
  if (!std::filesystem::is_directory(file, error)) in.open(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) throw ReportError(file.string() + ": cannot be read");
  return parse_figures(text, file.string());
}

}  // namespace quoin::deploy
