// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include <spdlog/spdlog.h>

#include "services/runtime/process/run_node.hpp"
#include "services/runtime/process/service.hpp"
#include "services/viewer/feed.hpp"
#include "services/viewer/kind.hpp"
#include "services/viewer/playback_remote.hpp"

using namespace quoin;

namespace {

runtime::Component::Body open(const Deployment& deployment, const ServiceConfig& config) {
  const auto view = std::make_shared<viewer::LiveView>(
      deployment, make_parameters<viewer::ViewerParameters>(config.parameters),
      deployment.file.parent_path(), [](const std::string& text) { spdlog::warn("{}", text); });
  const auto handle = [view](runtime::Work& work) {
    const auto& message = work.input<runtime::ObservedMessage>();
    view->publish(message.topic, message.type, work.message().data, message.raw, message.header);
  };
  const auto node = std::make_shared<runtime::Component>(runtime::node_component(
      viewer_kind(), runtime::port_types(runtime::Reads<>(), runtime::Writes<>()),
      [handle](const std::string&, const ParameterSettings&) {
        return runtime::Method{.handle = handle};
      }));
  return
      [view, node, body = node->open(deployment, config), deployment](runtime::Service& service) {
        spdlog::info("page at {}", view->url());
        const viewer::PlaybackAnswers answers(*view, service.process.participant, deployment);
        const viewer::Feed heartbeats(
            service.process.participant, *view, deployment.name_space, {}, [&] {
              const viewer::Hub::Figures figures = view->hub().figures();
              service.record.set_diagnostic("Clients", std::to_string(figures.clients));
              service.record.set_diagnostic("Dropped For Clients", std::to_string(figures.dropped));
            });
        return body(service);
      };
}

const runtime::Registration registration({&viewer_kind(), open});

}  // namespace
