// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes at the border of any topic type: the first byte chooses the type. What is let in is a
// message of the type, and keeps what its IDL promises, found out in another way.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "services/topics/cdr_json.hpp"
#include "services/topics/message_check.hpp"
#include "services/topics/topic_types.hpp"
#include "tests/fuzz/require.hpp"

namespace {

using namespace quoin::topics;
using quoin::fuzz::require;
using Json = nlohmann::ordered_json;

std::vector<std::string> checked_types() {
  std::vector<std::string> types{"quoin::msg::ServiceStatus", "quoin::msg::Header"};
  for (const TopicType& row : topic_types()) types.emplace_back(row.dds_type);
  return types;
}

void check_ranges(const Json& ranges, std::size_t points) {
  std::uint64_t free_from = 0;
  for (const Json& range : ranges) {
    require(range.at("begin") >= free_from, "index ranges are ascending");
    require(range.at("end") >= range.at("begin"), "index ranges are not turned round");
    free_from = range.at("end").get<std::uint64_t>();
  }
  require(free_from <= points, "index ranges are inside the points");
}

void check_covariance(const Json& xx, const Json& xy, const Json& yy) {
  require(xx.is_number() && xy.is_number() && yy.is_number(), "covariances are finite");
  const double a = xx.get<double>();
  const double c = yy.get<double>();
  const double correlation = xy.get<double>() / std::sqrt(a) / std::sqrt(c);
  require(a > 0.0 && c > 0.0, "variances are positive");
  require(std::abs(correlation) <= 1.0 + 1e-6, "correlations are no more than one");
}

void check(const std::string& type, const Json& message) {
  if (type == "quoin::msg::Scan") {
    require(message.at("ranges").size() == message.at("bearings").size(), "a range a bearing");
  } else if (type == "quoin::msg::Segments") {
    check_ranges(message.at("segments"), message.at("ranges").size());
    check_ranges(message.at("arcs"), message.at("ranges").size());
  } else if (type == "quoin::msg::Lines") {
    for (const Json& line : message.at("lines")) {
      check_covariance(line.at("covariance_direction"), line.at("covariance_direction_offset"),
                       line.at("covariance_offset"));
      check_covariance(line.at("covariance_alpha"), line.at("covariance_alpha_r"),
                       line.at("covariance_r"));
    }
  } else if (type == "quoin::msg::Corners") {
    for (const Json& corner : message.at("corners")) {
      check_covariance(corner.at("covariance_xx"), corner.at("covariance_xy"),
                       corner.at("covariance_yy"));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const std::vector<std::string> types = checked_types();
  const std::string& type = types[data[0] % types.size()];
  const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  if (const Refusal refusal = message_check(type)->refusal(bytes)) {
    require(!refusal->empty() && refusal->size() < 200, "a refusal has a short reason");
    return 0;
  }
  check(type, cdr_to_json(type, bytes));  // a CdrError is a finding
  return 0;
}
