// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::HasSubstr;
using tests::Process;
using tests::TestDeployment;

// The second corner service is of the same lines: what it makes of them is the same.
constexpr const char* services = R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 50}}
  - {name: walls, kind: segmentation, input: front}
  - {name: utls, kind: line_fitting, input: walls, method: utls}
  - {name: first, kind: corner_estimation, input: utls}
  - {name: same, kind: corner_estimation, input: utls}
  - {name: elsewhere, kind: simulated}
  - {name: elsewhere_walls, kind: segmentation, input: elsewhere}
  - {name: elsewhere_lines, kind: line_fitting, input: elsewhere_walls}
  - {name: elsewhere_corners, kind: corner_estimation, input: elsewhere_lines}
)";

TEST(Compare, JoinsTheScansOfServicesOfOneSource) {
  const TestDeployment deployment(services);
  std::vector<Process> processes;
  for (const char* name : {"first", "same", "utls", "walls", "front"}) {
    processes.push_back(deployment.start(name));
  }
  runtime::Participant participant(deployment.participant("test"));
  tests::CornerRecorder recorder(participant, deployment, "same");
  ASSERT_TRUE(recorder.wait_for(1, 60s));
  Process compare = deployment.quoin({"compare", "FILE", "--scans", "20", "--json"});
  ASSERT_EQ(compare.wait(60s), 0) << compare.errors();
  EXPECT_THAT(compare.errors(), HasSubstr("'elsewhere_corners' takes its scans from 'elsewhere'"));
  const json result = json::parse(compare.output());
  EXPECT_EQ(result["scans"], 20);
  EXPECT_EQ(result["reference"], "first");
  EXPECT_EQ(result["services"].size(), 2U);
  const json& first = result["services"]["first"];
  EXPECT_EQ(first["scans_missing"], 0);
  EXPECT_GT(first["mean_corners"], 4.0);
  EXPECT_GT(first["latency_p50_us"], 0.0);
  const json& same = result["services"]["same"];
  EXPECT_EQ(same["methods"], "iepf/utls/adjacent");
  const json& against = same["against_reference"];
  // How many is the start's business: the two readers are not matched at the same moment.
  EXPECT_GT(against["scans"], 0);
  EXPECT_EQ(against["share_matched"], 1.0);
  EXPECT_LT(against["distance_p95_mm"], 0.001);

  Process wrong = deployment.quoin({"compare", "FILE", "--services", "first,elsewhere_corners"});
  EXPECT_EQ(wrong.wait(20s), 2);
  EXPECT_THAT(wrong.errors(), HasSubstr("compare services of one source"));
}

}  // namespace
}  // namespace quoin
