// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/hub.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace quoin::viewer {

namespace {

constexpr std::size_t most_keys = 4096;  // of a channel, such as parts of a map

}  // namespace

std::int64_t Hub::now() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

std::uint32_t Hub::add_channel(Channel channel) {
  const std::lock_guard lock(mutex_);
  channel.id = static_cast<std::uint32_t>(channels_.size() + 1);
  channels_.push_back(std::move(channel));
  newest_.emplace_back();
  for (const Connected& connected : clients_) {
    connected.client->advertise(channels_.back());
    connected.wake();
  }
  return channels_.back().id;
}

void Hub::add_service(std::string name, Service service) {
  const std::lock_guard lock(mutex_);
  service_names_.push_back(std::move(name));
  services_.push_back(std::move(service));
}

void Hub::limit(std::size_t most_clients, ClientLimits limits) {
  const std::lock_guard lock(mutex_);
  most_clients_ = most_clients;
  limits_ = limits;
}

void Hub::publish(std::uint32_t channel, Payload payload, std::uint64_t key) {
  const std::lock_guard lock(mutex_);
  if (channel == 0 || channel > channels_.size()) return;
  for (const Connected& connected : clients_) {
    if (connected.client->offer(channel, payload)) connected.wake();
  }
  auto& newest = newest_[channel - 1];
  if (newest.size() < most_keys || newest.contains(key)) newest[key] = std::move(payload);
}

bool Hub::wanted(std::uint32_t channel) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(
      clients_, [&](const Connected& connected) { return connected.client->wants(channel); });
}

std::shared_ptr<Client> Hub::connect(std::function<void()> wake) {
  const std::lock_guard lock(mutex_);
  if (clients_.size() >= most_clients_) return nullptr;
  std::vector<std::string> greeting{server_info(name_, session_), advertisement(channels_)};
  if (!service_names_.empty()) greeting.push_back(service_advertisement(service_names_));
  std::vector<std::string> topics;
  for (const Channel& channel : channels_) topics.push_back(channel.topic);
  auto client = std::make_shared<Client>(std::move(topics), service_names_, greeting, limits_);
  clients_.push_back({client, std::move(wake)});
  return client;
}

void Hub::disconnect(const Client& client) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(
      clients_, [&](const Connected& each) { return each.client.get() == &client; });
  if (found == clients_.end()) return;
  dropped_ += client.dropped();
  clients_.erase(found);
}

void Hub::receive_text(Client& client, std::string_view text) {
  client.receive_text(text, [&](std::uint32_t channel) {
    const std::lock_guard lock(mutex_);
    for (const auto& [key, newest] : newest_[channel - 1]) (void)client.offer(channel, newest);
  });
}

void Hub::receive_binary(Client& client, std::string_view bytes) {
  client.receive_binary(bytes, [&](std::string_view name, const std::string& request) {
    Service service;
    {
      const std::lock_guard lock(mutex_);
      const auto found = std::ranges::find(service_names_, name);
      if (found == service_names_.end()) throw std::invalid_argument("no such service");
      service = services_[static_cast<std::size_t>(found - service_names_.begin())];
    }
    return service(request);
  });
}

Hub::Figures Hub::figures() const {
  const std::lock_guard lock(mutex_);
  Figures figures{clients_.size(), dropped_};
  for (const Connected& connected : clients_) figures.dropped += connected.client->dropped();
  return figures;
}

}  // namespace quoin::viewer
