// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Scan.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin::runtime {
namespace {

TopicQos owned_by(const std::string& owner) {
  TopicQos qos = QosPreset::feature;
  qos.owner = owner;
  return qos;
}

TEST(OwnedEndpoints, WhoWatchesLearnsOfEachThatIsMadeAndEnds) {
  Participant participant({tests::test_domain(), tests::test_namespace() + "/owner"});
  std::vector<OwnedEndpoint> known{{}};
  participant.watch_endpoints([&](const auto& endpoints) { known = endpoints; });
  EXPECT_TRUE(known.empty());

  const Writer<msg::Scan> nobodys(participant, "a", QosPreset::feature);
  EXPECT_TRUE(known.empty());
  {
    const Writer<msg::Scan> writer(participant, "b", owned_by("front"));
    const Reader<msg::Scan> reader(participant, "b", owned_by("walls"));
    ASSERT_EQ(known.size(), 2U);
    EXPECT_EQ(known[0].owner, "front");
    EXPECT_TRUE(known[0].writes);
    EXPECT_EQ(known[1].owner, "walls");
    EXPECT_FALSE(known[1].writes);
    // Of the same participant, another entity.
    const auto prefix = [](const Guid& guid) { return std::vector(guid.begin(), guid.end() - 4); };
    EXPECT_EQ(prefix(known[0].guid), prefix(participant.guid()));
    EXPECT_EQ(prefix(known[1].guid), prefix(participant.guid()));
    EXPECT_NE(known[0].guid, known[1].guid);
    EXPECT_NE(known[0].guid, participant.guid());
  }
  EXPECT_TRUE(known.empty());

  participant.watch_endpoints(nullptr);
  const Writer<msg::Scan> unwatched(participant, "c", owned_by("front"));
  EXPECT_TRUE(known.empty());
}

}  // namespace
}  // namespace quoin::runtime
