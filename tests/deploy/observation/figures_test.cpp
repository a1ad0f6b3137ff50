// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/figures.hpp"

#include <gmock/gmock.h>

namespace quoin::deploy {
namespace {

using testing::Pair;
using testing::UnorderedElementsAre;

ServiceReport report(std::uint64_t received, std::uint64_t published, std::uint64_t lost) {
  ServiceReport result;
  result.state = "active";
  result.received = received;
  result.published = published;
  result.lost = lost;
  if (lost > 0) result.losses = {{"link", lost}};
  return result;
}

TEST(Incarnations, WithoutAnyReportAreEmpty) {
  const ServiceReport total = Incarnations().total();
  EXPECT_EQ(total.state, "");
  EXPECT_EQ(total.published, 0U);
  EXPECT_TRUE(Incarnations().processes().empty());
}

TEST(Incarnations, KeepTheNewestReportOfAProcess) {
  Incarnations incarnations;
  incarnations.update(10, report(5, 4, 1));
  incarnations.update(10, report(9, 8, 1));
  EXPECT_EQ(incarnations.total().received, 9U);
  EXPECT_EQ(incarnations.total().published, 8U);
  EXPECT_EQ(incarnations.total().lost, 1U);
}

TEST(Incarnations, SumCountersOverProcessesInAnyOrder) {
  Incarnations incarnations;
  ServiceReport newest = report(100, 90, 10);
  newest.state = "stopped";
  newest.latency_p50 = 0.002;
  newest.failures = 3;
  incarnations.update(20, newest);
  ServiceReport oldest = report(7, 5, 2);
  oldest.losses = {{"processing", 2}};
  oldest.failures = 1;
  oldest.upstream_lost = 4;
  oldest.latency_p50 = 9.0;
  incarnations.update(10, oldest);
  const ServiceReport total = incarnations.total();
  EXPECT_EQ(total.received, 107U);
  EXPECT_EQ(total.published, 95U);
  EXPECT_EQ(total.lost, 12U);
  EXPECT_EQ(total.failures, 4U);
  EXPECT_EQ(total.upstream_lost, 4U);
  EXPECT_THAT(total.losses, UnorderedElementsAre(Pair("link", 10), Pair("processing", 2)));
  EXPECT_EQ(total.state, "stopped");
  EXPECT_DOUBLE_EQ(total.latency_p50, 0.002);
}

TEST(Incarnations, CountWhatOthersSawOfAKilledProcess) {
  Incarnations incarnations;
  incarnations.set_topic("ns/front/scan");
  incarnations.update(10, report(0, 5, 0));
  incarnations.published_at_least(10, "ns/front/scan", 8);
  incarnations.published_at_least(10, "ns/front/scan", 7);
  incarnations.update(20, report(0, 3, 0));
  EXPECT_EQ(incarnations.total().published, 11U);
  EXPECT_EQ(incarnations.processes().at(10).published, 8U);
  EXPECT_EQ(incarnations.processes().at(20).published, 3U);
  incarnations.published_at_least(30, "ns/front/scan", 2);  // died before its first heartbeat
  EXPECT_EQ(incarnations.total().published, 13U);
  EXPECT_EQ(incarnations.processes().at(30).published, 2U);
}

TEST(Incarnations, CountEachTopicByItself) {
  Incarnations incarnations;
  incarnations.set_topic("ns/front/scan");
  incarnations.update(10, report(0, 5, 0));
  incarnations.published_at_least(10, "ns/front/odometry", 40);
  EXPECT_EQ(incarnations.total().published, 5U);
  EXPECT_EQ(incarnations.processes().at(10).published, 5U);
  EXPECT_EQ(incarnations.processes().at(10).outputs.at("ns/front/odometry").published, 40U);
}

}  // namespace
}  // namespace quoin::deploy
