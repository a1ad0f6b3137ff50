// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/participant.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

#include "deploy/keys/key_check.hpp"
#include "services/runtime/participant_impl.hpp"
#include "services/runtime/security.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

constexpr const char* loopback = "127.0.0.1";
// Discovery asks the ports of this many participants on the host; the port formula of the RTPS
// standard has room for 119 in a domain.
constexpr std::uint32_t max_participants = 100;
// Holds several scans, so that a burst does not overflow the socket; the kernel may grant less.
constexpr std::uint32_t socket_buffer_bytes = 4U << 20U;

rtps::Locator_t loopback_locator() {
  rtps::Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  rtps::IPLocator::setIPv4(locator, loopback);
  locator.port = 0;  // filled in from domain and participant number
  return locator;
}

// Participants of one process talk through the transport like all others: the short cut inside a
// process never repeats a sample that a full lossless reader had to reject.
void disable_intraprocess_delivery() {
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
}

dds::DomainParticipantQos participant_qos(const ParticipantConfig& config) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name(config.name);
  if (config.security) add_security(*config.security, config.identity, qos);

  auto udp = std::make_shared<UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {loopback};
  udp->maxInitialPeersRange = max_participants;
  udp->sendBufferSize = socket_buffer_bytes;
  udp->receiveBufferSize = socket_buffer_bytes;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);

  auto& builtin = qos.wire_protocol().builtin;
  builtin.initialPeersList.push_back(loopback_locator());
  builtin.metatrafficUnicastLocatorList.push_back(loopback_locator());
  qos.wire_protocol().default_unicast_locator_list.push_back(loopback_locator());

  // A dead process is noticed after the lease; new ones are announced often at first, because one
  // lost announcement would otherwise delay the start by a whole period.
  auto& discovery = builtin.discovery_config;
  discovery.leaseDuration = eprosima::fastrtps::Duration_t(5, 0);
  discovery.leaseDuration_announcementperiod = eprosima::fastrtps::Duration_t(1, 0);
  discovery.initial_announcements.count = 10;
  discovery.initial_announcements.period = eprosima::fastrtps::Duration_t(0, 50'000'000);
  return qos;
}

}  // namespace

ParticipantConfig participant_config(const deploy::Deployment& deployment, const std::string& name,
                                     std::string_view identity) {
  const std::string keys = identity.empty() ? name : std::string(identity);
  deploy::require_keys(deployment, {keys});
  return {deployment.domain, deployment.name_space + "/" + name, deployment.network,
          deployment.security, keys};
}

Participant::Participant(const ParticipantConfig& config) : impl_(std::make_unique<Impl>()) {
  disable_intraprocess_delivery();
  if (config.security) impl_->listener = watch_security(*config.security, config.identity);
  auto* factory = dds::DomainParticipantFactory::get_instance();
  impl_->participant = factory->create_participant(static_cast<dds::DomainId_t>(config.domain),
                                                   participant_qos(config), impl_->listener.get(),
                                                   dds::StatusMask::none());
  if (impl_->participant == nullptr) {
    throw std::runtime_error("cannot join DDS domain " + std::to_string(config.domain) +
                             " on 127.0.0.1; is the loopback interface up, and are fewer than " +
                             std::to_string(max_participants) + " participants running in it?");
  }
  impl_->publisher = impl_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  impl_->subscriber = impl_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  if (impl_->publisher == nullptr || impl_->subscriber == nullptr) {
    throw std::runtime_error("cannot create DDS publisher and subscriber");
  }
}

Participant::~Participant() {
  if (impl_->participant == nullptr) return;
  impl_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(impl_->participant);
}

dds::Topic* Participant::Impl::topic(const std::string& name, const dds::TypeSupport& type) {
  if (auto* known = participant->lookup_topicdescription(name)) {
    return dynamic_cast<dds::Topic*>(known);
  }
  // With type propagation on, nested types crash Fast DDS 2.9's discovery server and Cyclone DDS
  // refuses to match.
  type->auto_fill_type_information(false);
  type->auto_fill_type_object(false);
  if (type.register_type(participant) != ReturnCode_t::RETCODE_OK) {
    throw std::runtime_error("cannot register DDS type " + type.get_type_name());
  }
  dds::Topic* made = participant->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  if (made == nullptr) throw std::runtime_error("cannot create DDS topic '" + name + "'");
  return made;
}

namespace {

// The policies that writers and readers must agree on.
std::string policy_name(dds::QosPolicyId_t policy) {
  switch (policy) {
    case dds::DURABILITY_QOS_POLICY_ID:
      return "durability";
    case dds::DEADLINE_QOS_POLICY_ID:
      return "deadline";
    case dds::LATENCYBUDGET_QOS_POLICY_ID:
      return "latency budget";
    case dds::OWNERSHIP_QOS_POLICY_ID:
      return "ownership";
    case dds::LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    case dds::RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case dds::DESTINATIONORDER_QOS_POLICY_ID:
      return "destination order";
    case dds::DATAREPRESENTATION_QOS_POLICY_ID:
      return "data representation";
    default:
      return "policy " + std::to_string(static_cast<int>(policy));
  }
}

}  // namespace

void MatchState::set_matched(int count) {
  const std::lock_guard lock(mutex_);
  matched_ = static_cast<std::size_t>(std::max(count, 0));
  changed_.notify_all();
}

void MatchState::add_incompatible(const std::string& topic, dds::QosPolicyId_t policy) {
  const std::lock_guard lock(mutex_);
  const std::string text = topic + ": " + policy_name(policy);
  if (std::find(incompatible_.begin(), incompatible_.end(), text) == incompatible_.end()) {
    incompatible_.push_back(text);
  }
}

std::size_t MatchState::matched() const {
  const std::lock_guard lock(mutex_);
  return matched_;
}

bool MatchState::wait(std::size_t count, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return matched_ >= count; });
}

std::vector<std::string> MatchState::incompatible() const {
  const std::lock_guard lock(mutex_);
  return incompatible_;
}

}  // namespace quoin::runtime
