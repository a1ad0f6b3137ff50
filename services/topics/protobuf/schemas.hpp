// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace google::protobuf {
class Descriptor;
}

namespace quoin::topics {

/// The message of one of the .proto files of idl/, such as quoin.msg.Scan or foxglove.LaserScan.
/// Throws std::out_of_range when none declares it.
[[nodiscard]] const google::protobuf::Descriptor& protobuf_message(std::string_view name);

/// A serialized google.protobuf.FileDescriptorSet: the file that declares the message and those
/// that it imports, imports first. What MCAP and Foxglove's WebSocket protocol call the schema of
/// encoding "protobuf". Throws std::out_of_range.
[[nodiscard]] std::string protobuf_descriptor_set(std::string_view name);

/// The Protobuf message that repeats this structure of the IDL: quoin::msg::Scan is quoin.msg.Scan.
[[nodiscard]] std::string protobuf_name(std::string_view dds_type);

}  // namespace quoin::topics
