// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/log.hpp"

#include <memory>
#include <utility>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace quoin::runtime {

namespace {

thread_local std::string name_of_thread;

class ServiceName final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& line) override {
    const std::string_view name =
        name_of_thread.empty()
            ? std::string_view(message.logger_name.data(), message.logger_name.size())
            : std::string_view(name_of_thread);
    line.append(name.data(), name.data() + name.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<ServiceName>();
  }
};

}  // namespace

void start_log(const std::string& name) {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<ServiceName>('N').set_pattern("%H:%M:%S.%e [%N] %^%l%$ %v");
  spdlog::set_default_logger(spdlog::stderr_color_mt(name));
  spdlog::set_formatter(std::move(formatter));
}

LogName::LogName(std::string name) : before_(std::exchange(name_of_thread, std::move(name))) {}
LogName::~LogName() { name_of_thread = before_; }

}  // namespace quoin::runtime
