// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// Of every program of a service: the kinds that are linked into it have registered themselves.
#include "services/runtime/process/run_process.hpp"

int main(int argc, char** argv) {
  return quoin::runtime::run_process(argc, argv, quoin::runtime::registered_components());
}
