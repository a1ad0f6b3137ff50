// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// One link of the bare chain: takes bytes from one topic and writes as many as it is told to
// another. Without topics it is an idle participant.
//   bare_forwarder DOMAIN INPUT OUTPUT OUTPUT_BYTES keep_last|lossless
//   bare_forwarder DOMAIN

#include <csignal>
#include <cstdlib>
#include <unistd.h>

#include "tests/benchmarks/bare_endpoint.hpp"

using namespace quoin::benchmarks;

namespace {
volatile std::sig_atomic_t stopping = 0;
void stop(int) { stopping = 1; }
}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 6) return 2;
  std::signal(SIGTERM, stop);
  BareParticipant participant(std::atoi(argv[1]));
  if (argc == 2) {
    while (stopping == 0) pause();
    return 0;
  }
  const bool lossless = std::string(argv[5]) == "lossless";
  const auto size = static_cast<std::size_t>(std::atol(argv[4]));
  fast_dds::DataWriter* writer = participant.writer(argv[3], lossless);
  fast_dds::DataReader* reader = participant.reader(argv[2], lossless);
  fast_dds::WaitSet wait_set;
  wait_set.attach_condition(reader->get_statuscondition());
  Bytes bytes;
  while (stopping == 0) {
    if (!take_bare(reader, wait_set, bytes, 200)) continue;
    bytes.resize(size);
    while (!quoin::runtime::fast_dds::write(*writer, &bytes) && lossless && stopping == 0) {
    }
  }
  return 0;
}
