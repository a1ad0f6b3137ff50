// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/schemas.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <set>
#include <span>
#include <stdexcept>

namespace quoin::topics {

/// Made by embed_descriptions.cmake: a FileDescriptorSet of all .proto files of idl/.
std::span<const unsigned char> embedded_descriptions();

namespace {

namespace pb = google::protobuf;

// Apart from the pool of generated classes: a program may have others of the same names.
const pb::DescriptorPool& pool() {
  static const pb::DescriptorPool* const own = [] {
    pb::FileDescriptorSet set;
    const std::span<const unsigned char> bytes = embedded_descriptions();
    if (!set.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
      throw std::logic_error("the embedded descriptions of Protobuf messages are damaged");
    }
    auto* made = new pb::DescriptorPool();
    for (const pb::FileDescriptorProto& file : set.file()) {
      if (made->BuildFile(file) == nullptr) throw std::logic_error(file.name() + " is not valid");
    }
    return made;
  }();
  return *own;
}

void add(const pb::FileDescriptor& file, std::set<std::string>& added, pb::FileDescriptorSet& set) {
  if (!added.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) add(*file.dependency(i), added, set);
  file.CopyTo(set.add_file());
}

}  // namespace

const pb::Descriptor& protobuf_message(std::string_view name) {
  const pb::Descriptor* found = pool().FindMessageTypeByName(std::string(name));
  if (found == nullptr) {
    throw std::out_of_range("no .proto file of idl/ declares " + std::string(name));
  }
  return *found;
}

std::string protobuf_descriptor_set(std::string_view name) {
  pb::FileDescriptorSet set;
  std::set<std::string> added;
  add(*protobuf_message(name).file(), added, set);
  return set.SerializeAsString();
}

std::string protobuf_name(std::string_view dds_type) {
  std::string name(dds_type);
  for (std::size_t at = name.find("::"); at != std::string::npos; at = name.find("::")) {
    name.replace(at, 2, ".");
  }
  return name;
}

}  // namespace quoin::topics
