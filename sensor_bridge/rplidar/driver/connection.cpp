// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/connection.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "sensor_bridge/rplidar/driver/client.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

/// S1; A series and old adapters; C1; S2 and S3.
constexpr unsigned usual_baud_rates[] = {256000, 115200, 460800, 1000000};

/// How much a finding says about the other end.
int weight(Finding finding) {
  switch (finding) {
    case Finding::unsupported_baud_rate:
      return 0;
    case Finding::no_bytes:
    case Finding::no_answer:
      return 1;
    case Finding::echo:
      return 2;
    case Finding::garbage:
      return 3;
    default:
      return 4;
  }
}

DeviceInfo ask_who(Client& client, bool quiet, TimeOuts::Time time_out) {
  if (quiet) {
    try {
      return client.info(time_out);
    } catch (const DeviceError&) {
      // The request may have been taken for the rest of a damaged one.
    }
  }
  return client.info(time_out);
}

Connection connect(const Opener& open, const std::string& name, unsigned baud_rate,
                   const Interruption& interruption, const TimeOuts& time_outs) {
  MotorGuard guard(open(baud_rate));
  Client client(guard.transport(), interruption, time_outs, name);
  guard.arm(true);
  // Told at once, a device may fall silent before a byte of it is seen.
  (void)client.read(std::chrono::steady_clock::now() + time_outs.quiet);
  const bool quiet = client.stop();
  const bool was_sending = client.received_bytes() > 0;
  // Where the word to stop was not understood, that about the motor will not be either.
  guard.arm(was_sending && quiet);
  const DeviceInfo info = ask_who(client, quiet, time_outs.probing);
  guard.arm(true);
  const ModelTraits traits = traits_of(info);
  if (!traits.may_have_board) guard.driven_by(traits.motor);
  return {
      .guard = std::move(guard), .baud_rate = baud_rate, .info = info, .was_sending = was_sending};
}

std::string list_of(std::span<const unsigned> baud_rates) {
  std::string list;
  for (const unsigned rate : baud_rates) list += (list.empty() ? "" : ", ") + std::to_string(rate);
  return list;
}

}  // namespace

Opener opener_of(const DriverSettings& settings) {
  return [endpoint = settings.endpoint, time_out = settings.time_outs.connection](
             unsigned baud_rate) { return open_transport(endpoint, baud_rate, time_out); };
}

std::vector<unsigned> baud_rates_for(const Endpoint& endpoint, unsigned first) {
  if (endpoint.kind != Endpoint::Kind::serial) return {0};
  std::vector<unsigned> rates(std::begin(usual_baud_rates), std::end(usual_baud_rates));
  if (first != 0) {
    std::erase(rates, first);
    rates.insert(rates.begin(), first);
  }
  return rates;
}

Connection find_device(const Opener& open, const std::string& name,
                       std::span<const unsigned> baud_rates, const Interruption& interruption,
                       const TimeOuts& time_outs) {
  std::optional<Diagnosis> best;
  const auto keep = [&best](const Diagnosis& diagnosis) {
    if (!best || weight(diagnosis.finding) > weight(best->finding)) best = diagnosis;
  };
  for (const unsigned baud_rate : baud_rates) {
    try {
      return connect(open, name, baud_rate, interruption, time_outs);
    } catch (const DeviceError& error) {
      keep(error.diagnosis());
    } catch (const TransportError& error) {
      if (error.kind() != TransportError::Kind::unsupported_baud_rate) throw;
      keep(diagnosis_of(error));
    }
  }
  Diagnosis diagnosis = best.value_or(Diagnosis{
      .finding = Finding::no_bytes, .text = name + ": no baud rate to try", .advice = {}});
  if (baud_rates.front() != 0) diagnosis.text += " (at " + list_of(baud_rates) + " baud)";
  throw DeviceError(diagnosis);
}

}  // namespace quoin::sensor_bridge::rplidar
