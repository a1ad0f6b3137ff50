// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/probe.hpp"

#include <string>

#include "sensor_bridge/rplidar/driver/reply_reading.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

std::string identity(const DeviceFacts& facts) {
  return facts.endpoint + ": " + model_text(facts.info) + ", firmware " +
         firmware_text(facts.info) + ", serial number " + serial_number_text(facts.info) +
         (facts.baud_rate == 0 ? "" : ", " + std::to_string(facts.baud_rate) + " baud");
}

Diagnosis diagnose(const DeviceFacts& facts, unsigned wanted_baud_rate) {
  const std::string health = health_text(facts.health);
  if (facts.health.status == Health::error) {
    return {.finding = Finding::protection_stop,
            .text = identity(facts) + ": in protection stop, " + health,
            .advice =
                "see that it can turn freely, then switch it off and on; a running driver "
                "resets it by itself"};
  }
  if (wanted_baud_rate != 0 && facts.baud_rate != 0 && facts.baud_rate != wanted_baud_rate) {
    return {
        .finding = Finding::other_baud_rate,
        .text = identity(facts) + ", not " + std::to_string(wanted_baud_rate),
        .advice = "set the baud rate to " + std::to_string(facts.baud_rate) + " or leave it out"};
  }
  if (facts.health.status == Health::warning) {
    return {.finding = Finding::health_warning,
            .text = identity(facts) + ": warns of its health, " + health,
            .advice = "it measures all the same; clean it and see that it can turn freely"};
  }
  if (!facts.traits.known) {
    return {.finding = Finding::unknown_model,
            .text = identity(facts),
            .advice = "it may work all the same: try it"};
  }
  return {.finding = Finding::fine, .text = identity(facts), .advice = {}};
}

}  // namespace

ProbeReport probe(const DriverSettings& settings, const Interruption& interruption, Opener open) {
  if (!open) open = opener_of(settings);
  ProbeReport report;
  const std::string name = to_text(settings.endpoint);
  try {
    const Connection connection =
        find_device(open, name, baud_rates_for(settings.endpoint, settings.baud_rate), interruption,
                    settings.time_outs);
    report.was_sending = connection.was_sending;
    Client client(connection.guard.transport(), interruption, settings.time_outs, name);
    const DeviceHealth health = client.health();
    report.facts = ask_facts(client, name, connection.baud_rate, connection.info);
    report.facts->health = health;
    report.diagnosis = diagnose(*report.facts, settings.baud_rate);
  } catch (const DeviceError& error) {
    report.diagnosis = error.diagnosis();
  } catch (const TransportError& error) {
    report.diagnosis = diagnosis_of(error);
  }
  return report;
}

}  // namespace quoin::sensor_bridge::rplidar
