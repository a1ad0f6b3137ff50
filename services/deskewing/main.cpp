// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "services/deskewing/kind.hpp"
#include "services/deskewing/scan_motion.hpp"
#include "services/runtime/process/run_node.hpp"

using namespace quoin;

namespace {

runtime::Method make(const std::string&, const ParameterSettings& settings) {
  const auto parameters = make_parameters<DeskewingParameters>(settings);
  auto motion = std::make_shared<ScanMotion>(parameters);
  auto left = std::make_shared<std::size_t>(0);
  const auto last = [parameters](const runtime::Message& message) {
    const auto* scan = message.as<msg::Scan>();
    return scan == nullptr || parameters.deskew == DeskewBy::off
               ? message.header->stamp()
               : last_ray(*scan, parameters.sweep);
  };
  const auto handle = [parameters, motion, left, last](runtime::Work& work) {
    msg::Scan& out = work.output<msg::Scan>();
    out = work.input<msg::Scan>();
    if (parameters.deskew == DeskewBy::off) return;
    const std::int64_t until = last(work.message());
    const bool done =
        parameters.deskew == DeskewBy::odometry
            ? motion->remove<msg::Odometry>(work.through<msg::Odometry>("odometry", until), out)
            : motion->remove<msg::Pose>(work.through<msg::Pose>("pose", until), out);
    if (done) return;
    work.set_diagnostic("Skewed Scans", std::to_string(++*left) + " are as they came: the " +
                                            std::string(enum_name(parameters.deskew)) +
                                            " does not reach over them");
  };
  return {.handle = handle, .last_stamp = last};
}

const runtime::Registration registration(runtime::node_component(
    deskewing_kind(),
    runtime::port_types(runtime::Reads<msg::Scan, msg::Odometry, msg::Pose>(),
                        runtime::Writes<msg::Scan>()),
    make));

}  // namespace
