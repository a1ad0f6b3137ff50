// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/log.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "core/text/printable.hpp"

namespace quoin::runtime {

namespace {

constexpr std::uint64_t first_ones = 10;
constexpr std::chrono::seconds shortest_pause{10};  // doubles with each line, up to
constexpr std::chrono::hours longest_pause{1};
constexpr std::chrono::minutes forgotten_after{10};

constexpr double burst = 200.0;         // [line]
constexpr double lines_a_second = 0.1;  // 8640 a day

constexpr std::size_t most_kinds = 256;
constexpr std::size_t longest_line = 1000;  // [byte]

std::string without_numbers(std::string_view message) {
  std::string kind(message.substr(0, longest_line));
  std::erase_if(kind, [](char c) { return c >= '0' && c <= '9'; });
  return kind;
}

}  // namespace

LogLimit::Kind& LogLimit::kind_of(std::string_view message, Clock::time_point now) {
  std::string text = without_numbers(message);
  if (!kinds_.contains(text) && kinds_.size() >= most_kinds) {
    kinds_.erase(
        std::ranges::min_element(kinds_, {}, [](const auto& entry) { return entry.second.last; }));
  }
  Kind& kind = kinds_[std::move(text)];
  if (now - kind.last > forgotten_after && now >= kind.next) kind = {};
  kind.last = now;
  return kind;
}

bool LogLimit::may_write(Clock::time_point now) {
  if (!allowance_)
    allowance_ = burst;
  else {
    const std::chrono::duration<double> elapsed = now - allowed_at_;
    allowance_ = std::min(burst, *allowance_ + lines_a_second * elapsed.count());
  }
  allowed_at_ = now;
  if (*allowance_ < 1.0) return false;
  *allowance_ -= 1.0;
  return true;
}

std::optional<std::string> LogLimit::line(std::string_view message) {
  const Clock::time_point now = now_();
  Kind& kind = kind_of(message, now);
  if (kind.written >= first_ones && now < kind.next) {
    ++kind.left_out;
    return std::nullopt;
  }
  if (!may_write(now)) {
    ++left_out_;
    return std::nullopt;
  }
  std::string line = printable(message, Lines::one, longest_line);
  if (kind.left_out > 0) line += " (and " + std::to_string(kind.left_out) + " like it before)";
  if (left_out_ > 0) line += " (" + std::to_string(left_out_) + " others were too many)";
  left_out_ = 0;
  kind.left_out = 0;
  ++kind.written;
  if (kind.written >= first_ones) {
    const auto doublings = std::min<std::uint64_t>(kind.written - first_ones, 20);
    kind.next = now + std::min<Clock::duration>(shortest_pause * (std::int64_t{1} << doublings),
                                                longest_pause);
  }
  return line;
}

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

std::string failure_text(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return "out of memory";
  // What starts a thread reports it like that.
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  const bool nothing_left =
      system != nullptr && (system->code() == std::errc::resource_unavailable_try_again ||
                            system->code() == std::errc::not_enough_memory);
  return nothing_left ? "out of memory or of threads; see ulimit -a" : error.what();
}

LogName::LogName(std::string name) : before_(std::exchange(name_of_thread, std::move(name))) {}
LogName::~LogName() { name_of_thread = before_; }

}  // namespace quoin::runtime
