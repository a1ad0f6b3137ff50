// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/log.hpp"

#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <unistd.h>
#include <utility>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "services/runtime/process/log_limit.hpp"

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

/// What goes to the log may be of strangers, and more than a disk holds.
class LimitedSink final : public spdlog::sinks::ansicolor_stderr_sink_mt {
 public:
  void log(const spdlog::details::log_msg& message) override {
    std::optional<std::string> line;
    {
      const std::lock_guard lock(limit_mutex_);
      line = limit_.line({message.payload.data(), message.payload.size()});
    }
    if (!line) return;
    spdlog::details::log_msg shown = message;
    shown.payload = *line;
    spdlog::sinks::ansicolor_stderr_sink_mt::log(shown);
  }

 private:
  std::mutex limit_mutex_;
  LogLimit limit_;
};

}  // namespace

void start_log(const std::string& name) {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<ServiceName>('N').set_pattern("%H:%M:%S.%e [%N] %^%l%$ %v");
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>(name, std::make_shared<LimitedSink>()));
  spdlog::set_formatter(std::move(formatter));
}

void report_uncaught_exceptions() {
  std::set_terminate([] {
    // Without allocating: there may be nothing left.
    const auto say = [](const char* text) {
      [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
    };
    try {
      if (const auto error = std::current_exception()) std::rethrow_exception(error);
      say("quoin: ended by an error in a library\n");
    } catch (const std::bad_alloc&) {
      say("quoin: out of memory\n");
    } catch (const std::exception& error) {
      say("quoin: ");
      say(error.what());
      say("\n");
    } catch (...) {
      say("quoin: ended by an error in a library\n");
    }
    std::_Exit(1);
  });
}

LogName::LogName(std::string name) : before_(std::exchange(name_of_thread, std::move(name))) {}
LogName::~LogName() { name_of_thread = before_; }

}  // namespace quoin::runtime
