// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "core/parameters/parameter.hpp"

namespace quoin::runtime {

/// Turns one message into another; the header is the kit's business. Returns the number of parts
/// (segments) that gave no result. An exception counts the scan as lost in processing.
template <class In, class Out>
using Process = std::function<std::size_t(const In&, Out&)>;

/// Makes the process for a method and its parameters. Throws ParameterError.
template <class In, class Out>
using ProcessFactory =
    std::function<Process<In, Out>(const std::string& method, const ParameterSettings&)>;

/// The main function of a stage: command line, deployment file, participant, reader and writer,
/// accounting, heartbeat, control requests, orderly end. Instantiated for the stages of this
/// project. Returns the exit code: 0 stopped, 2 wrong configuration, 1 anything else.
template <class In, class Out>
int run_stage(int argc, char** argv, const std::string& kind, const ProcessFactory<In, Out>& make);

}  // namespace quoin::runtime
