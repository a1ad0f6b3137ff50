// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/line_map.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::topics {
namespace {

MapLine wall(std::uint64_t id, double x = 0.0) {
  MapLine line;
  line.id = id;
  line.start = {x, 0.0};
  line.end = {x + 1.0, 0.0};
  line.observations = 2;
  return line;
}

std::vector<msg::LineMap> published(PublishedLineMap& map) {
  std::vector<msg::LineMap> messages;
  msg::LineMap message;
  while (map.next(message)) messages.push_back(message);
  return messages;
}

MATCHER_P2(IsPart, part, walls, "") {
  return arg.part() == std::uint32_t(part) && arg.lines().size() == std::size_t(walls);
}
using testing::ElementsAre;
using testing::IsEmpty;

TEST(PublishedLineMap, GivesAllPartsAndThenThoseThatChange) {
  std::vector<MapLine> lines{wall(0), wall(130), wall(127)};
  PublishedLineMap map(1);
  EXPECT_EQ(map.update(lines), 0U);
  EXPECT_THAT(published(map), ElementsAre(IsPart(0, 2), IsPart(1, 1)));

  lines[0].start.x() += 0.001;
  ++lines[0].observations;
  map.update(lines);
  EXPECT_THAT(published(map), IsEmpty()) << "nothing to speak of";

  lines[1].start.x() += 0.01;
  map.update(lines);
  EXPECT_THAT(published(map), ElementsAre(IsPart(1, 1)));
  EXPECT_EQ(map.version(), 2U);

  lines.erase(lines.begin());
  map.update(lines);
  EXPECT_THAT(published(map), ElementsAre(IsPart(0, 1))) << "walls go as well";

  lines.push_back(wall(300));
  map.update(lines);
  EXPECT_THAT(published(map), ElementsAre(IsPart(0, 1), IsPart(1, 1), IsPart(2, 1)))
      << "each says how many there are";
}

TEST(PublishedLineMap, AddsUpSmallChanges) {
  std::vector<MapLine> lines{wall(0)};
  PublishedLineMap map(1);
  map.update(lines);
  published(map);
  std::size_t messages = 0;
  for (int i = 0; i < 100; ++i) {
    lines[0].end.x() += 0.001;
    map.update(lines);
    messages += published(map).size();
  }
  EXPECT_THAT(messages, testing::AllOf(testing::Ge(16U), testing::Le(20U))) << "each 5 mm";
}

TEST(PublishedLineMap, LeavesOutWhatATopicCannotKeep) {
  PublishedLineMap map(1);
  EXPECT_EQ(map.update(std::vector<MapLine>{wall(0), wall(most_walls), wall(~std::uint64_t{0})}),
            2U);
  EXPECT_THAT(published(map), ElementsAre(IsPart(0, 1)));
}

TEST(ReceivedLineMap, IsWhatWasPublishedWhateverWasMissed) {
  std::vector<MapLine> lines{wall(0), wall(130)};
  PublishedLineMap map(1);
  map.update(lines);
  auto messages = published(map);
  ReceivedLineMap late;
  EXPECT_TRUE(late.take(messages[1]));
  EXPECT_FALSE(late.complete());
  lines[0].end.x() += 1.0;
  map.update(lines);
  EXPECT_TRUE(late.take(published(map).at(0)));
  ASSERT_TRUE(late.complete());
  EXPECT_EQ(late.version(), 2U);
  EXPECT_FALSE(late.take(messages[0])) << "older than what is here";
  ASSERT_EQ(late.lines().size(), 2U);
  EXPECT_EQ(late.lines()[0].end.x(), 2.0);
  EXPECT_EQ(late.lines()[1].id, 130U);
}

TEST(ReceivedLineMap, BeginsAnewWithALaterMap) {
  PublishedLineMap first(1), second(2);
  first.update(std::vector<MapLine>{wall(0), wall(130)});
  second.update(std::vector<MapLine>{wall(5)});
  ReceivedLineMap received;
  const auto old = published(first);
  for (const msg::LineMap& message : old) received.take(message);
  EXPECT_TRUE(received.take(published(second).at(0)));
  EXPECT_TRUE(received.complete());
  EXPECT_EQ(received.lines().size(), 1U);
  EXPECT_FALSE(received.take(old[1])) << "of the map before";
}

TEST(ReceivedLineMap, RefusesWhatIsNoPart) {
  msg::LineMap message;
  message.parts(1);
  message.begun(1);
  message.lines().push_back(map_line_message(wall(0)));
  ReceivedLineMap received;
  EXPECT_TRUE(received.take(message));
  message.lines()[0].id(walls_of_a_part);
  EXPECT_FALSE(received.take(message)) << "a wall of another part";
  message.lines()[0].id(0);
  message.lines()[0].end().x(std::nan(""));
  EXPECT_FALSE(received.take(message));
  message.lines()[0].end().x(1.0);
  message.part(1);
  EXPECT_FALSE(received.take(message));
  message.parts(most_parts + 1);
  EXPECT_FALSE(received.take(message));
  message.part(0);
  message.parts(1);
  message.lines().resize(walls_of_a_part + 1, message.lines()[0]);
  EXPECT_FALSE(received.take(message));
}

}  // namespace
}  // namespace quoin::topics
