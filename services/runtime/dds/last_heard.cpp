// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/last_heard.hpp"

#ifndef QUOIN_FAST_DDS_2

#include <algorithm>
#include <utility>
#include <vector>

#include <fastdds/rtps/transport/ChainingTransport.hpp>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.hpp>
#include <fastdds/rtps/transport/SenderResource.hpp>
#include <fastdds/rtps/transport/TransportReceiverInterface.hpp>

namespace quoin::runtime {

namespace rtps = fast_dds::rtps;

void LastHeard::begin() {
  const std::lock_guard lock(mutex_);
  begun_ = true;
}

void LastHeard::watch(const Prefix& participant) {
  const std::lock_guard lock(mutex_);
  if (begun_) times_[participant] = std::chrono::steady_clock::now();
}

void LastHeard::forget(const Prefix& participant) {
  const std::lock_guard lock(mutex_);
  times_.erase(participant);
}

void LastHeard::heard(const Prefix& participant) {
  const std::lock_guard lock(mutex_);
  const auto known = times_.find(participant);
  if (known != times_.end()) known->second = std::chrono::steady_clock::now();
}

std::optional<LastHeard::Time> LastHeard::of(const Prefix& participant) const {
  const std::lock_guard lock(mutex_);
  const auto known = times_.find(participant);
  if (known == times_.end()) return std::nullopt;
  return known->second;
}

namespace {

// [byte] Of an RTPS message before the prefix of who sent it: "RTPS", version, vendor.
constexpr std::uint32_t before_prefix = 8;

class Descriptor : public rtps::ChainingTransportDescriptor {
 public:
  Descriptor(std::shared_ptr<rtps::TransportDescriptorInterface> below,
             std::shared_ptr<LastHeard> heard)
      : rtps::ChainingTransportDescriptor(std::move(below)), last_heard(std::move(heard)) {}
  [[nodiscard]] rtps::TransportInterface* create_transport() const override;

  std::shared_ptr<LastHeard> last_heard;
};

class Transport : public rtps::ChainingTransport {
 public:
  explicit Transport(const Descriptor& descriptor)
      : rtps::ChainingTransport(descriptor), descriptor_(descriptor) {}

  [[nodiscard]] rtps::TransportDescriptorInterface* get_configuration() override {
    return &descriptor_;
  }
  bool send(rtps::SenderResource* below, const std::vector<rtps::NetworkBuffer>& buffers,
            std::uint32_t bytes, rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& timeout) override {
    return below->send(buffers, bytes, begin, end, timeout);
  }
  void receive(rtps::TransportReceiverInterface* next, const rtps::octet* message,
               std::uint32_t size, const rtps::Locator_t& local,
               const rtps::Locator_t& remote) override {
    LastHeard::Prefix prefix{};
    if (size >= before_prefix + prefix.size()) {
      std::copy_n(message + before_prefix, prefix.size(), prefix.begin());
      descriptor_.last_heard->heard(prefix);
    }
    next->OnDataReceived(message, size, local, remote);
  }

 private:
  Descriptor descriptor_;
};

rtps::TransportInterface* Descriptor::create_transport() const { return new Transport(*this); }

}  // namespace

std::shared_ptr<rtps::TransportDescriptorInterface> listened_to(
    std::shared_ptr<rtps::TransportDescriptorInterface> below,
    std::shared_ptr<LastHeard> last_heard) {
  last_heard->begin();
  return std::make_shared<Descriptor>(std::move(below), std::move(last_heard));
}

}  // namespace quoin::runtime

#endif
