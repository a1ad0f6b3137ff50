// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// The three services against a bare chain of three Fast DDS processes that forward as many bytes at
// each link, both fed and read by this process on the same machine in the same run. Prints one JSON
// object.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <idl/Control.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/node/clock.hpp"
#include "tests/benchmarks/bare_endpoint.hpp"
#include "tests/benchmarks/figures.hpp"
#include "tests/benchmarks/process_usage.hpp"
#include "tests/benchmarks/room_scans.hpp"
#include "tests/integration/harness/process.hpp"
#include "tests/temporary_folder.hpp"

using namespace quoin;
using namespace quoin::benchmarks;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

namespace {

/// What one chain did.
struct ChainResult {
  std::vector<double> latencies;  // [s]
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  double seconds = 0.0;  // for all of them
  [[nodiscard]] double rate() const { return static_cast<double>(received) / seconds; }
};

/// The services, started from a deployment whose source this process plays.
class ServiceChain {
 public:
  ServiceChain(int domain, bool lossless, const tests::TemporaryFolder& directory)
      : name_space_("bench_" + std::to_string(getpid()) + (lossless ? "_lossless" : "")),
        scans_(make_scans()),
        participant_({domain, "benchmark"}),
        writer_(participant_, name_space_ + "/front/scan",
                lossless ? runtime::QosPreset::lossless : runtime::QosPreset::sensor),
        reader_(participant_, name_space_ + "/corners/corners",
                lossless ? runtime::QosPreset::lossless : runtime::QosPreset::feature) {
    wait_set_.add(reader_);
    const auto file = directory.write(
        name_space_ + ".yaml",
        "version: 1\nnamespace: " + name_space_ + "\ndomain: " + std::to_string(domain) +
            (lossless ? "\nqos: lossless" : "") +
            "\nservices:\n"
            "  - {name: front, kind: simulated}\n"
            "  - {name: walls, kind: segmentation, input: front, method: iepf}\n"
            "  - {name: wctls, kind: line_fitting, input: walls, method: wctls}\n"
            "  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}\n");
    const auto start = [&](const std::string& program, const std::string& service,
                           const std::string& observers) {
      processes_.emplace_back(program,
                              std::vector<std::string>{"--deployment", file.string(), "--service",
                                                       service, "--observers", observers},
                              directory.path());
    };
    start("quoin-corner-estimation", "corners", "1");
    start("quoin-line-fitting", "wctls", "0");
    start("quoin-segmentation", "walls", "0");
    if (!writer_.wait_for_readers(1, 20s)) throw std::runtime_error("the services did not start");
  }

  void send() {
    msg::Scan& scan = scans_[next_ % scans_.size()];
    number(scan, next_++);
    while (!writer_.write(scan)) {
    }
  }

  /// Latency of the next result [s], or nothing within `timeout`.
  std::optional<double> receive(std::chrono::milliseconds timeout) {
    if (!reader_.take(corners_)) {
      wait_set_.wait(timeout);
      if (!reader_.take(corners_)) return std::nullopt;
    }
    return static_cast<double>(runtime::now_ns() - corners_.header().trace()[0].published()) * 1e-9;
  }

  [[nodiscard]] const std::vector<tests::Process>& processes() const { return processes_; }
  [[nodiscard]] const msg::Corners& last() const { return corners_; }
  [[nodiscard]] const msg::Scan& scan() const { return scans_.front(); }
  [[nodiscard]] const std::string& name_space() const { return name_space_; }

 private:
  std::string name_space_;
  std::vector<msg::Scan> scans_;
  runtime::Participant participant_;
  runtime::Writer<msg::Scan> writer_;
  runtime::Reader<msg::Corners> reader_;
  runtime::WaitSet wait_set_;
  std::vector<tests::Process> processes_;
  msg::Corners corners_;
  std::uint64_t next_ = 0;
};

/// Serialized size of each message of the chain for one scan, learned from the running services.
struct Sizes {
  std::size_t scan = 0, segments = 0, lines = 0, corners = 0;
};

class BareChain {
 public:
  BareChain(int domain, bool lossless, const Sizes& sizes, const tests::TemporaryFolder& directory)
      : participant_(domain), size_(sizes.scan) {
    const std::string mode = lossless ? "lossless" : "keep_last";
    const std::string prefix = "bare_" + std::to_string(getpid()) + mode + "_";
    const auto start = [&](int link, std::size_t size) {
      processes_.emplace_back(
          "bare_forwarder",
          std::vector<std::string>{std::to_string(domain), prefix + std::to_string(link),
                                   prefix + std::to_string(link + 1), std::to_string(size), mode},
          directory.path());
    };
    start(0, sizes.segments);
    start(1, sizes.lines);
    start(2, sizes.corners);
    writer_ = participant_.writer(prefix + "0", lossless);
    reader_ = participant_.reader(prefix + "3", lossless);
    wait_set_.attach_condition(reader_->get_statuscondition());
    // Matched when a message comes through.
    const auto deadline = steady_clock::now() + 20s;
    do {
      if (steady_clock::now() > deadline) throw std::runtime_error("the bare chain did not start");
      send();
    } while (!receive(200ms));
    while (receive(500ms)) {
    }
  }

  void send() {
    bytes_.resize(size_);
    const std::int64_t now = runtime::now_ns();
    std::memcpy(bytes_.data(), &now, sizeof now);
    while (!runtime::fast_dds::write(*writer_, &bytes_)) {
    }
  }

  std::optional<double> receive(std::chrono::milliseconds timeout) {
    if (!take_bare(reader_, wait_set_, received_, static_cast<std::uint32_t>(timeout.count())))
      return std::nullopt;
    std::int64_t sent = 0;
    std::memcpy(&sent, received_.data(), sizeof sent);
    return static_cast<double>(runtime::now_ns() - sent) * 1e-9;
  }

 private:
  BareParticipant participant_;
  std::size_t size_;
  std::vector<tests::Process> processes_;
  fast_dds::DataWriter* writer_ = nullptr;
  fast_dds::DataReader* reader_ = nullptr;
  fast_dds::WaitSet wait_set_;
  Bytes bytes_;
  Bytes received_;
};

/// One message through a chain that is otherwise at rest.
template <class Chain>
void one_message(Chain& chain, ChainResult& result) {
  chain.send();
  ++result.sent;
  if (const auto latency = chain.receive(2000ms)) {
    ++result.received;
    result.latencies.push_back(*latency);
  }
}

/// Messages as fast as the chain takes them without losing any.
template <class Chain>
ChainResult flood(Chain& chain, std::uint64_t count) {
  ChainResult result;
  const auto start = steady_clock::now();
  std::thread sender([&] {
    for (std::uint64_t i = 0; i < count; ++i) chain.send();
  });
  while (result.received < count && chain.receive(5000ms)) ++result.received;
  sender.join();
  result.sent = count;
  result.seconds = std::chrono::duration<double>(steady_clock::now() - start).count();
  return result;
}

/// Takes one message of each topic off the running chain to learn how large they are.
Sizes measure_sizes(ServiceChain& chain, int domain) {
  runtime::Participant participant({domain, "sizes"});
  runtime::Reader<msg::Segments> segments(participant, chain.name_space() + "/walls/segments",
                                          runtime::QosPreset::feature);
  runtime::Reader<msg::Lines> lines(participant, chain.name_space() + "/wctls/lines",
                                    runtime::QosPreset::feature);
  if (!segments.wait_for_writers(1, 10s) || !lines.wait_for_writers(1, 10s)) {
    throw std::runtime_error("the services do not write their topics");
  }
  msg::Segments a_segments;
  msg::Lines a_lines;
  bool has_segments = false;
  bool has_lines = false;
  for (int i = 0; i < 100 && !(has_segments && has_lines); ++i) {
    chain.send();
    (void)chain.receive(2000ms);
    tests::eventually(
        [&] {
          has_segments = has_segments || segments.take(a_segments);
          has_lines = has_lines || lines.take(a_lines);
          return has_segments && has_lines;
        },
        200ms);
  }
  if (!has_segments || !has_lines) throw std::runtime_error("could not read the services' topics");
  return {msg::Scan::getCdrSerializedSize(chain.scan()),
          msg::Segments::getCdrSerializedSize(a_segments),
          msg::Lines::getCdrSerializedSize(a_lines),
          msg::Corners::getCdrSerializedSize(chain.last())};
}

void measure_latency(ServiceChain& services, BareChain& bare, int messages,
                     nlohmann::ordered_json& figures) {
  ChainResult ours;
  ChainResult theirs;
  auto next = steady_clock::now();
  for (int i = 0; i < messages; ++i) {  // interleaved: each chain at 10 Hz, half a period apart
    one_message(services, ours);
    std::this_thread::sleep_until(next += 50ms);
    one_message(bare, theirs);
    std::this_thread::sleep_until(next += 50ms);
  }
  const auto add = [&](const std::string& name, const ChainResult& result) {
    figures[name + "_p50_us"] = quantile(result.latencies, 0.5) * 1e6;
    figures[name + "_p99_us"] = quantile(result.latencies, 0.99) * 1e6;
    figures[name + "_lost"] = result.sent - result.received;
  };
  add("chain", ours);
  add("bare", theirs);
  figures["chain_p50_over_bare"] = quantile(ours.latencies, 0.5) / quantile(theirs.latencies, 0.5);
  figures["chain_p99_over_bare"] =
      quantile(ours.latencies, 0.99) / quantile(theirs.latencies, 0.99);
}

/// A script that runs wild: while it is on, a thousand bad control requests a second to the fitter.
class RequestFlood {
 public:
  RequestFlood(int domain, const std::string& name_space)
      : participant_({domain, "flood"}),
        writer_(participant_, control_request_topic(name_space), runtime::QosPreset::control) {
    if (!writer_.wait_for_readers(3, 20s)) throw std::runtime_error("no service takes requests");
    thread_ = std::thread([this] { run(); });
  }
  ~RequestFlood() {
    ending_ = true;
    thread_.join();
  }
  RequestFlood(const RequestFlood&) = delete;
  RequestFlood& operator=(const RequestFlood&) = delete;

  void turn(bool on) { on_ = on; }

 private:
  void run() {
    msg::ControlRequest request;
    request.service("wctls");
    request.requester("flood");
    request.action(msg::ControlAction::CONTROL_SWAP_METHOD);
    request.method("no_such_method");
    auto next = steady_clock::now();
    while (!ending_) {
      request.request(request.request() + 1);
      if (on_) writer_.write(request);
      next = std::max(next + 1ms, steady_clock::now() - 100ms);
      std::this_thread::sleep_until(next);
    }
  }

  runtime::Participant participant_;
  runtime::Writer<msg::ControlRequest> writer_;
  std::atomic<bool> on_{false};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// Scans at 10 Hz; the flood of requests comes and goes every second.
void measure_requests(ServiceChain& services, int domain, int messages,
                      nlohmann::ordered_json& figures) {
  RequestFlood flood(domain, services.name_space());
  ChainResult quiet;
  ChainResult flooded;
  auto next = steady_clock::now();
  for (int i = 0; i < messages; ++i) {
    const bool on = i / 10 % 2 == 1;
    flood.turn(on);
    std::this_thread::sleep_until(next += 100ms);
    one_message(services, on ? flooded : quiet);
  }
  figures["chain_p50_flooded_over_quiet"] =
      quantile(flooded.latencies, 0.5) / quantile(quiet.latencies, 0.5);
  figures["chain_flooded_lost"] = flooded.sent - flooded.received;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind("model name", 0) == 0) {
      return line.substr(line.find(':') + 2) + ", " +
             std::to_string(std::thread::hardware_concurrency()) + " cores";
    }
  }
  return "unknown";
}

/// Median times of the two passes of extraction_benchmark, and their ratio.
void add_extraction(const std::string& path, nlohmann::ordered_json& figures) {
  std::ifstream file(path);
  const auto report = nlohmann::json::parse(file);
  double extraction = 0.0;
  double conversion = 0.0;
  for (const auto& run : report.at("benchmarks")) {
    const std::string name = run.at("name");
    if (name == "extraction/to_corners_median") extraction = run.at("cpu_time");
    if (name == "plain_conversion_median") conversion = run.at("cpu_time");
  }
  if (extraction <= 0.0 || conversion <= 0.0) throw std::runtime_error(path + " holds no medians");
  figures["extraction_us"] = extraction * 1e-3;
  figures["conversion_us"] = conversion * 1e-3;
  figures["extraction_over_conversion"] = extraction / conversion;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Latency, rate and memory of the three services over a bare Fast DDS chain; prints JSON"};
  int domain = 17;
  int messages = 300;
  std::uint64_t flood_messages = 20000;
  app.add_option("--domain", domain, "DDS domain");
  app.add_option("--messages", messages, "Messages for the latency, at 10 Hz through each chain");
  std::string extraction_file;
  std::string format = "json";
  app.add_option("--extraction", extraction_file,
                 "JSON file written by extraction_benchmark, merged into the figures");
  app.add_option("--format", format, "json or table")->check(CLI::IsMember({"json", "table"}));
  app.add_option("--flood", flood_messages, "Messages for the rate");
  CLI11_PARSE(app, argc, argv);
  try {
    const tests::TemporaryFolder directory;
    nlohmann::ordered_json figures;
    figures["processor"] = processor();
    if (!extraction_file.empty()) add_extraction(extraction_file, figures);
    tests::Process idle("bare_forwarder", {std::to_string(domain)}, directory.path());
    Sizes sizes;
    {
      ServiceChain services(domain, false, directory);
      sizes = measure_sizes(services, domain);
      BareChain bare(domain, false, sizes, directory);
      std::cerr << "latency: " << messages << " messages through each chain at 10 Hz\n";
      measure_latency(services, bare, messages, figures);
      std::cerr << "control requests: " << messages << " messages, a flood every other second\n";
      measure_requests(services, domain, messages, figures);
      double worst = 0.0;
      for (const tests::Process& process : services.processes())
        worst = std::max(worst, resident_mib(process.pid()));
      figures["service_rss_mib"] = worst;
      figures["idle_participant_rss_mib"] = resident_mib(idle.pid());
      figures["service_rss_over_idle_mib"] = worst - resident_mib(idle.pid());
    }
    {
      ServiceChain services(domain, true, directory);
      BareChain bare(domain, true, sizes, directory);
      std::cerr << "rate: " << flood_messages << " messages through each chain, three rounds\n";
      std::vector<double> ours;
      std::vector<double> theirs;
      std::uint64_t lost = 0;
      for (int round = 0; round < 3; ++round) {
        const ChainResult a = flood(services, flood_messages);
        const ChainResult b = flood(bare, flood_messages);
        ours.push_back(a.rate());
        theirs.push_back(b.rate());
        lost += a.sent - a.received + b.sent - b.received;
      }
      figures["chain_rate_hz"] = quantile(ours, 0.5);
      figures["bare_rate_hz"] = quantile(theirs, 0.5);
      figures["rate_lost"] = lost;
      figures["chain_rate_over_bare"] = quantile(ours, 0.5) / quantile(theirs, 0.5);
    }
    figures["message_bytes"] = {{"scan", sizes.scan},
                                {"segments", sizes.segments},
                                {"lines", sizes.lines},
                                {"corners", sizes.corners}};
    print(figures, format == "json");
  } catch (const std::exception& error) {
    std::cerr << "chain_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
