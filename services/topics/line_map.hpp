// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <idl/LineMap.h>
#include <map>
#include <span>
#include <vector>

#include "core/mapping/line_map.hpp"

namespace quoin::topics {

/// Walls of one message, by their ids, and the most parts that a map may have: as many instances
/// as a topic with the preset `state` keeps.
inline constexpr std::uint64_t walls_of_a_part = 128;
inline constexpr std::size_t most_parts = 512;
inline constexpr std::uint64_t most_walls = walls_of_a_part * most_parts;

[[nodiscard]] msg::MapLine map_line_message(const MapLine& line);
[[nodiscard]] MapLine map_line(const msg::MapLine& message);

/// A map as it is published: which of its parts differ from what was published before.
class PublishedLineMap {
 public:
  /// `begun` [ns since the Unix epoch]: when the map was.
  explicit PublishedLineMap(std::uint64_t begun) : begun_(begun) {}

  /// The map as it is now. Walls that moved by less than 5 mm or 1 mrad, and became not much better
  /// known, count as published. Returns how many walls have ids beyond `most_walls`: these stay
  /// unpublished.
  std::size_t update(std::span<const MapLine> lines);

  /// Fills in a part that differs, which counts as published from now on, but for the header. False
  /// when there is none.
  bool next(msg::LineMap& out);

  [[nodiscard]] std::uint64_t version() const { return version_; }
  [[nodiscard]] std::size_t parts() const { return parts_.size(); }

 private:
  struct Part {
    std::vector<MapLine> lines;  // as published
    bool differs = true;
  };
  std::uint64_t begun_;
  std::uint64_t version_ = 0;
  std::vector<Part> parts_;
  std::vector<std::vector<MapLine>> sorted_;  // of the present map, by part
};

/// A map as it comes by its topic.
class ReceivedLineMap {
 public:
  /// Takes a part; false when the message, which anybody may have sent, is none, or is older than
  /// what is here.
  bool take(const msg::LineMap& message);

  /// Whether all parts are here.
  [[nodiscard]] bool complete() const { return !parts_.empty() && parts_.size() == wanted_; }
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// All walls that are here, in the order of their ids.
  [[nodiscard]] std::vector<MapLine> lines() const;

 private:
  struct Part {
    std::uint64_t version = 0;
    std::vector<MapLine> lines;
  };
  std::uint64_t begun_ = 0;
  std::uint64_t version_ = 0;
  std::size_t wanted_ = 0;
  std::map<std::uint32_t, Part> parts_;
};

}  // namespace quoin::topics
