// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "services/runtime/dds/entities.hpp"
#include "services/runtime/dds/fast_dds.hpp"
#include "services/runtime/dds/interfaces.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;
namespace rtps = fast_dds::rtps;
using Duration_t = fast_dds::Duration;

namespace {

// Of the RTPS standard.
constexpr const char* multicast_group = "239.255.0.1";
constexpr std::uint32_t multicast_port = 7400;
constexpr std::uint32_t ports_of_a_domain = 250;

/// Port 0 is filled in from domain and participant number.
rtps::Locator_t locator(const std::string& address, std::uint32_t port = 0) {
  rtps::Locator_t made;
  made.kind = LOCATOR_KIND_UDPv4;
  rtps::IPLocator::setIPv4(made, address);
  made.port = port;
  return made;
}

// [byte] Of UDP payload that goes through links and tunnels of an MTU of 1400 bytes in one piece.
constexpr std::uint32_t one_packet = 1372;

std::shared_ptr<fast_dds::UdpTransport> udp_transport(const ParticipantConfig& config,
                                                      const std::vector<std::string>& addresses) {
  auto udp = std::make_shared<fast_dds::UdpTransport>();
  // What is larger DDS divides, and repeats a part that was lost. IP would have to repeat all, and
  // on links that lose the kernel's memory for incomplete datagrams is soon full, which lets none
  // arrive for half a minute. With security handshakes are too large, and are not divided. Nor
  // where programs of others write, such as ROS 2: Fast DDS receives no larger messages than it
  // sends, and theirs are.
  if (!config.network.interfaces.empty() && !config.security && !config.strangers) {
    udp->maxMessageSize = one_packet;
  }
  udp->interfaceWhiteList = addresses;
  udp->maxInitialPeersRange = max_participants;
  udp->sendBufferSize = socket_buffer_bytes;
  udp->receiveBufferSize = socket_buffer_bytes;
  return udp;
}

/// Participants of Fast DDS 2 must know a server by this before they have met it, so it follows
/// from where the server is; those of 3 know by it which participant is a server, see
/// KnownEndpoints.
rtps::GuidPrefix_t server_prefix(const ServerAddress& server, int domain) {
  const rtps::Locator_t place = locator(server.address, server.port);
  rtps::GuidPrefix_t prefix;
  prefix.value[0] = 'Q';
  prefix.value[1] = 'n';
  prefix.value[2] = static_cast<rtps::octet>(domain);
  prefix.value[3] = 1;  // not all zero behind the address
  std::copy_n(rtps::IPLocator::getIPv4(place), 4, prefix.value + 4);
  prefix.value[8] = static_cast<rtps::octet>(server.port >> 8U);
  prefix.value[9] = static_cast<rtps::octet>(server.port & 0xffU);
  return prefix;
}

/// The servers of the network but for the one that this participant is itself.
void add_servers(rtps::BuiltinAttributes& builtin, const ParticipantConfig& config) {
  for (std::size_t i = 0; i < config.network.servers.size(); ++i) {
    if (config.server == i) continue;
    const ServerAddress& server = config.network.servers[i];
#ifdef QUOIN_FAST_DDS_2
    eprosima::fastdds::rtps::RemoteServerAttributes remote;
    remote.guidPrefix = server_prefix(server, config.domain);
    remote.metatrafficUnicastLocatorList.push_back(locator(server.address, server.port));
    builtin.discovery_config.m_DiscoveryServers.push_back(remote);
#else
    builtin.discovery_config.m_DiscoveryServers.push_back(locator(server.address, server.port));
#endif
  }
}

void become_server(dds::WireProtocolConfigQos& wire, const ParticipantConfig& config,
                   const std::vector<std::string>& addresses) {
  const ServerAddress& server = config.network.servers.at(*config.server);
  if (std::find(addresses.begin(), addresses.end(), server.address) == addresses.end()) {
    throw DeploymentError({"the discovery server " + server.address +
                           " is at no address of this host's interfaces in 'network'"});
  }
  wire.prefix = server_prefix(server, config.domain);
  wire.builtin.metatrafficUnicastLocatorList.clear();
  wire.builtin.metatrafficUnicastLocatorList.push_back(locator(server.address, server.port));
  wire.builtin.discovery_config.discoveryProtocol = fast_dds::DiscoveryProtocol::SERVER;
}

void set_discovery(rtps::BuiltinAttributes& builtin, const ParticipantConfig& config,
                   const std::vector<std::string>& addresses) {
  switch (config.network.discovery) {
    case Discovery::multicast:
      builtin.metatrafficMulticastLocatorList.push_back(
          locator(multicast_group,
                  multicast_port + ports_of_a_domain * static_cast<std::uint32_t>(config.domain)));
      builtin.initialPeersList = builtin.metatrafficMulticastLocatorList;
      break;
    case Discovery::peers:
      // The others on this host are peers, too.
      for (const std::string& address : addresses) {
        builtin.initialPeersList.push_back(locator(address));
      }
      for (const std::string& peer : config.network.peers) {
        if (std::find(addresses.begin(), addresses.end(), peer) != addresses.end()) continue;
        builtin.initialPeersList.push_back(locator(peer));
      }
      break;
    case Discovery::server:
      builtin.discovery_config.discoveryProtocol = fast_dds::DiscoveryProtocol::CLIENT;
      add_servers(builtin, config);
      break;
  }
}

Duration_t duration(double seconds) {
  const double whole = std::floor(seconds);
  return Duration_t(static_cast<std::int32_t>(whole),
                    static_cast<std::uint32_t>((seconds - whole) * 1e9));
}

void set_announcements(rtps::DiscoverySettings& discovery, const NetworkConfig& network) {
  // To peers they go to every port that a participant may have, which is much for a radio link.
  const bool costly = network.discovery == Discovery::peers && !network.interfaces.empty();
  discovery.leaseDuration = duration(network.lease);
  discovery.leaseDuration_announcementperiod =
      duration(costly ? network.lease / 5.0 : std::min(1.0, network.lease / 4.0));
  // New participants are announced often at first, because one lost announcement would otherwise
  // delay the start by a whole period.
  discovery.initial_announcements.count = costly ? 4 : 10;
  discovery.initial_announcements.period = Duration_t(0, costly ? 100'000'000 : 50'000'000);
}

}  // namespace

dds::DomainParticipantQos network_qos(const ParticipantConfig& config,
                                      const std::vector<std::string>& addresses) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp_transport(config, addresses));

  auto& builtin = qos.wire_protocol().builtin;
  for (const std::string& address : addresses) {
    builtin.metatrafficUnicastLocatorList.push_back(locator(address));
    qos.wire_protocol().default_unicast_locator_list.push_back(locator(address));
  }
  set_discovery(builtin, config, addresses);
  if (config.server) become_server(qos.wire_protocol(), config, addresses);

  set_announcements(builtin.discovery_config, config.network);
  return qos;
}

}  // namespace quoin::runtime
