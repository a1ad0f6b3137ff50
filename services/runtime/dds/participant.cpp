// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/participant.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "services/keys/key_files.hpp"
#include "services/runtime/dds/entities.hpp"
#include "services/runtime/dds/fast_dds.hpp"
#include "services/runtime/dds/interfaces.hpp"
#include "services/runtime/dds/last_heard.hpp"
#include "services/runtime/dds/security.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;

namespace {

// Participants of one process talk through the transport like all others: the short cut inside a
// process never repeats a sample that a full lossless reader had to reject.
void disable_intraprocess_delivery() {
#ifdef QUOIN_FAST_DDS_2
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
#else
  eprosima::fastdds::LibrarySettings settings;
  settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
  // Fails where participants exist, of which the first has set them.
  (void)dds::DomainParticipantFactory::get_instance()->set_library_settings(settings);
#endif
}

dds::DomainParticipantQos participant_qos(const ParticipantConfig& config,
                                          const std::vector<std::string>& addresses,
                                          const KnownEndpoints& endpoints) {
  dds::DomainParticipantQos qos = network_qos(config, addresses);
#ifndef QUOIN_FAST_DDS_2
  qos.properties().properties().emplace_back("fastdds.type_propagation", "disabled");
  // Where DDS itself does not drop participants that are silent.
  if (config.network.discovery == Discovery::server) {
    auto& transport = qos.transport().user_transports.front();
    transport = listened_to(transport, endpoints.last_heard());
  }
#else
  (void)endpoints;
#endif
  qos.name(config.name);
  qos.user_data().setValue(participant_announcement(config.user_data, config.observes, 0));
  if (config.security) add_security(*config.security, config.identity, qos);
  return qos;
}

// Of 50 new processes on loopback the last knew an observer 24 ms after its participant was
// created, 55 ms beside two busy loops. A discovery server is asked every 450 ms: 468 ms.
constexpr auto complete_after = std::chrono::milliseconds(120);
constexpr auto complete_after_with_server = std::chrono::milliseconds(1000);
// A machine that is slow to discover the others discovers them one after the other.
constexpr auto complete_after_the_newest = std::chrono::milliseconds(60);

// A new participant announces itself a few milliseconds before it can receive, and Fast DDS 2.9
// answers the first announcement alone: it would learn of this one only with the next periodic
// announcement. Twice, because a busy machine may take longer to start it.
constexpr std::array answers_after = {std::chrono::milliseconds(20), std::chrono::milliseconds(80)};

void answer_new_participants(const std::stop_token& stop, const KnownEndpoints& endpoints,
                             dds::DomainParticipant& participant, const std::string& user_data,
                             const std::vector<std::string>& observes) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::uint32_t number = 0;
  std::uint64_t seen = 0;
  while (true) {
    seen = endpoints.wait_for_new_participant(seen, stop);
    for (const auto delay : answers_after) {
      std::unique_lock lock(mutex);
      never.wait_for(lock, stop, delay, [] { return false; });
      if (stop.stop_requested()) return;
      dds::DomainParticipantQos qos = participant.get_qos();
      qos.user_data().setValue(participant_announcement(user_data, observes, ++number));
      participant.set_qos(qos);
    }
  }
}

}  // namespace

namespace {

/// Sources that read topics of other programs.
bool is_of_strangers(const ServiceConfig& service) {
  return service.kind == "external" || service.kind == "ros2_scan" ||
         service.kind == "ros2_odometry";
}

}  // namespace

ParticipantConfig participant_config(const Deployment& deployment, const std::string& name,
                                     std::string_view identity) {
  const std::string keys = identity.empty() ? name : std::string(identity);
  require_keys(deployment, {keys});
  return {.domain = deployment.domain,
          .name = deployment.name_space + "/" + name,
          .network = deployment.network,
          .strangers = std::ranges::any_of(deployment.services, is_of_strangers),
          .security = deployment.security,
          .identity = keys};
}

Participant::Participant(const ParticipantConfig& config)
    : impl_(std::make_unique<Impl>(
          config.security ? watch_security(*config.security, config.identity, config.name)
                          : std::make_unique<KnownEndpoints>(config.name))) {
  disable_intraprocess_delivery();
  const auto addresses = resolve_interfaces(config.network.interfaces, host_addresses());
  auto* factory = dds::DomainParticipantFactory::get_instance();
  impl_->participant =
      factory->create_participant(static_cast<dds::DomainId_t>(config.domain),
                                  participant_qos(config, addresses, *impl_->endpoints),
                                  impl_->endpoints.get(), dds::StatusMask::none());
  if (impl_->participant == nullptr && config.server) {
    const ServerAddress& server = config.network.servers.at(*config.server);
    throw std::runtime_error("cannot be the discovery server at " + server.address + ":" +
                             std::to_string(server.port) + "; does another process use that port?");
  }
  if (impl_->participant == nullptr) {
    throw std::runtime_error("cannot join DDS domain " + std::to_string(config.domain) + " on " +
                             addresses.front() + "; is that interface up, and are fewer than " +
                             std::to_string(max_participants) + " participants running in it?");
  }
  impl_->publisher = impl_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  impl_->subscriber = impl_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  if (impl_->publisher == nullptr || impl_->subscriber == nullptr) {
    throw std::runtime_error("cannot create DDS publisher and subscriber");
  }
  impl_->discovery = config.network.discovery;
  impl_->created = std::chrono::steady_clock::now();
  if (!config.observes.empty() && config.network.discovery != Discovery::server) {
    impl_->answering = std::jthread(
        [&endpoints = *impl_->endpoints, &participant = *impl_->participant,
         user_data = config.user_data, observes = config.observes](const std::stop_token& stop) {
          answer_new_participants(stop, endpoints, participant, user_data, observes);
        });
  }
}

Participant::~Participant() {
  if (impl_->participant == nullptr) return;
  impl_->answering = {};
  impl_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(impl_->participant);
}

std::string_view dds_version() { return fast_dds::version; }

std::vector<std::string> Participant::written_topics() const {
  return impl_->endpoints->written_topics();
}

Guid Participant::guid() const { return guid_of(impl_->participant->guid()); }

void Participant::watch_endpoints(OwnedEndpoints::Watcher watcher) {
  impl_->owned.watch(std::move(watcher));
}

void OwnedEndpoints::add(OwnedEndpoint endpoint) {
  const std::lock_guard lock(mutex_);
  endpoints_.push_back(std::move(endpoint));
  changed();
}

void OwnedEndpoints::remove(const Guid& guid) {
  const std::lock_guard lock(mutex_);
  if (std::erase_if(endpoints_, [&](const auto& each) { return each.guid == guid; }) > 0) changed();
}

void OwnedEndpoints::watch(Watcher watcher) {
  const std::lock_guard lock(mutex_);
  watcher_ = std::move(watcher);
  changed();
}

void OwnedEndpoints::changed() const {
  if (watcher_) watcher_(endpoints_);
}

std::vector<WrittenTopic> Participant::written() const { return impl_->endpoints->written(); }

bool Participant::discovery_complete() const {
  const auto now = std::chrono::steady_clock::now();
  const auto age = now - impl_->created;
  if (impl_->discovery != Discovery::server) {
    return age >= complete_after &&
           now - impl_->endpoints->newest_participant() >= complete_after_the_newest;
  }
  return age >= complete_after_with_server && impl_->endpoints->knows_server();
}

dds::Topic* Participant::Impl::topic(const std::string& name, const std::string& type_name,
                                     const topics::CdrCodec* codec) {
  const bool keyed = codec != nullptr && codec->keyed;
  const dds::TypeSupport registered = participant->find_type(type_name);
  if (registered.empty()) {
    if (!fast_dds::succeeded(type_support(type_name, codec).register_type(participant))) {
      throw std::runtime_error("cannot register DDS type " + type_name);
    }
  } else if (dynamic_cast<const CdrType&>(*registered).keyed() != keyed) {
    throw std::runtime_error("DDS type " + type_name +
                             " is in use both with and without its key; " +
                             "topics::keyed_codec has no row for it");
  }
  if (auto* known = participant->lookup_topicdescription(name)) {
    if (known->get_type_name() != type_name) {
      throw std::runtime_error("DDS topic '" + name + "' has the type " + known->get_type_name() +
                               " in this participant, not " + type_name);
    }
    return dynamic_cast<dds::Topic*>(known);
  }
  dds::Topic* made = participant->create_topic(name, type_name, dds::TOPIC_QOS_DEFAULT);
  if (made == nullptr) throw std::runtime_error("cannot create DDS topic '" + name + "'");
  return made;
}

void MatchState::set_matched(int count) {
  const std::lock_guard lock(mutex_);
  matched_ = static_cast<std::size_t>(std::max(count, 0));
  changed_.notify_all();
}

std::size_t MatchState::matched() const {
  const std::lock_guard lock(mutex_);
  return matched_;
}

bool MatchState::wait(std::size_t count, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return matched_ >= count; });
}

}  // namespace quoin::runtime
