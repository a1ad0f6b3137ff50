// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/parameters/parameter.hpp"
#include "deploy/command/commands.hpp"
#include "deploy/export/output_file.hpp"
#include "deploy/orchestration/signals.hpp"
#include "deploy/recordings/contents.hpp"
#include "deploy/recordings/copy.hpp"
#include "deploy/recordings/message_table.hpp"
#include "sensor_bridge/message_files/mcap_reader.hpp"
#include "sensor_bridge/message_files/mcap_writer.hpp"
#include "services/topics/cdr_json.hpp"

namespace quoin::deploy {

namespace {

namespace mcap = sensor_bridge::mcap;
using Json = nlohmann::ordered_json;

struct RecordingOptions {
  std::vector<std::string> files;
  CopyRequest copy;
  std::string output;
  std::string topic;
  std::string format = "csv";
  bool json = false;
};

class RecordingProgress {
 public:
  explicit RecordingProgress(bool quiet) : terminal_(!quiet && ::isatty(STDERR_FILENO) == 1) {}
  ~RecordingProgress() {
    if (terminal_) std::cerr << "\r\x1b[K" << std::flush;
  }
  RecordingProgress(const RecordingProgress&) = delete;
  RecordingProgress& operator=(const RecordingProgress&) = delete;

  void show(std::uint64_t messages) const {
    if (terminal_) std::cerr << '\r' << messages << " messages\x1b[K" << std::flush;
  }

 private:
  bool terminal_;
};

int show_contents(const RecordingOptions& options, bool thorough) {
  Contents contents;
  {
    const RecordingProgress progress(options.json);
    contents = read_contents(options.files.front(), thorough,
                             [&](std::uint64_t messages) { progress.show(messages); });
  }
  if (options.json) {
    std::cout << contents_json(contents).dump(2, ' ', false, Json::error_handler_t::replace)
              << '\n';
  } else {
    for (const std::string& line : contents_lines(contents)) std::cout << line << '\n';
    if (thorough && contents.damage.empty()) std::cout << "whole\n";
  }
  if (contents.damage.empty()) return exit_ok;
  std::cerr << contents.damage << '\n';
  return exit_input;
}

int copy(const RecordingOptions& options) {
  CopyRequest request = options.copy;
  request.inputs.assign(options.files.begin(), options.files.end());
  request.output = options.output;
  Signals signals;
  CopyOutcome outcome;
  {
    const RecordingProgress progress(options.json);
    outcome = copy_messages(request, [&](std::uint64_t messages) {
      progress.show(messages);
      return signals.take() == 0;
    });
  }
  for (const std::string& damage : outcome.damages) std::cerr << damage << '\n';
  if (outcome.interrupted) {
    std::cerr << "interrupted; nothing has been written\n";
    return exit_failure;
  }
  if (options.json) {
    std::cout << Json{{"file", options.output},
                      {"messages", outcome.messages},
                      {"damages", outcome.damages}}
                     .dump(2, ' ', false, Json::error_handler_t::replace)
              << '\n';
  } else {
    std::cout << options.output << ": " << outcome.messages << " messages\n";
  }
  return exit_ok;
}

/// The topics of a file whose messages have an IDL. Throws std::out_of_range unless one is meant.
std::string topic_to_export(const std::string& file, const std::string& asked) {
  std::vector<std::string> names;
  for (const auto& [name, topic] : sensor_bridge::open_message_file(file)->topics()) {
    if (topic.encoding != "cdr") continue;
    if (name == asked || name.ends_with("/" + asked)) return name;
    names.push_back(name);
  }
  throw std::out_of_range("--topic: " + file + " has no topic '" + asked + "' of CDR messages" +
                          suggestion(asked, names));
}

int export_messages(const RecordingOptions& options) {
  const std::string& file = options.files.front();
  mcap::Reader reader(file);
  const std::string topic = topic_to_export(file, options.topic);
  MessageTable table;
  std::string text;
  const auto put = [&](const std::string& line) {
    if (options.output.empty()) {
      std::cout << line << '\n';
    } else {
      text += line + '\n';
    }
  };
  int code = exit_ok;
  try {
    mcap::RecordedMessage message;
    topics::IdlTypes types;
    while (reader.next(message)) {
      if (message.channel->topic != topic || message.schema == nullptr) continue;
      if (types.types.empty()) types = topics::parse_idl(message.schema->data);
      const auto* bytes = reinterpret_cast<const std::byte*>(message.data.data());
      const Json fields =
          topics::cdr_to_json(types, message.schema->name, {bytes, message.data.size()});
      if (options.format == "jsonl") {
        put(fields.dump(-1, ' ', false, Json::error_handler_t::replace));
      } else {
        for (const std::string& row : table.rows(fields)) put(row);
      }
      if (!std::cout) return exit_failure;  // nobody reads any more
    }
  } catch (const std::exception& error) {
    // What was good before it is given.
    std::cerr << error.what() << '\n';
    code = exit_input;
  }
  if (!options.output.empty()) {
    write_whole(options.output, text);
    std::cout << options.output << '\n';
  }
  return code;
}

/// A subcommand of `recording`, and what it does.
struct Action {
  CLI::App* line;
  std::function<int()> run;
};

int run(const std::vector<Action>& actions) {
  try {
    for (const Action& action : actions) {
      if (action.line->parsed()) return action.run();
    }
  } catch (const sensor_bridge::ScanFileError& error) {
    std::cerr << error.what() << '\n';
    return exit_input;
  } catch (const mcap::WriteError& error) {
    std::cerr << error.what() << '\n';
  }
  return exit_failure;
}

CLI::App* add_action(CLI::App& line, RecordingOptions& options, const char* name,
                     const char* description, int most_files) {
  CLI::App* action = line.add_subcommand(name, description);
  action->add_option("file", options.files, most_files == 1 ? "Recording" : "Recordings")
      ->required()
      ->expected(1, most_files);
  action->add_flag("--json", options.json, "The result as one JSON object");
  return action;
}

}  // namespace

Command add_recording(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "recording", "Look into recordings, check, repair, cut, join and export them");
  line->require_subcommand(1);
  const auto options = std::make_shared<RecordingOptions>();
  const auto actions = std::make_shared<std::vector<Action>>();
  const auto add = [&](const char* name, const char* description, int most_files,
                       std::function<int()> does) {
    CLI::App* action = add_action(*line, *options, name, description, most_files);
    actions->push_back({action, std::move(does)});
    return action;
  };
  const auto add_output = [&](CLI::App* action) {
    action->add_option("-o,--output", options->output, "File to write (.mcap)")->required();
  };

  add("info", "What is in a recording (MCAP, ROS 1 bag, ROS 2 bag)", 1,
      [options] { return show_contents(*options, false); });
  add("check", "Read all of it; compare checksums, index and statistics (exit code 3: damaged)", 1,
      [options] { return show_contents(*options, true); });
  add_output(add("recover", "Make a whole file of one that was cut off or is damaged (MCAP)", 1,
                 [options] {
                   options->copy.recover = true;
                   return copy(*options);
                 }));
  CLI::App* cut =
      add("cut", "Keep a range of time (MCAP)", 1, [options] { return copy(*options); });
  add_output(cut);
  cut->add_option("--from", options->copy.from, "Seconds after the first message")
      ->check(CLI::NonNegativeNumber);
  cut->add_option("--to", options->copy.to, "Seconds after the first message")
      ->check(CLI::NonNegativeNumber);
  add_output(add("merge", "Join recordings into one, in the order of time (MCAP)", 1000,
                 [options] { return copy(*options); }));
  CLI::App* table = add("export", "Corners, lines, poses ... of a recording of ours as text (MCAP)",
                        1, [options] { return export_messages(*options); });
  table->add_option("--topic", options->topic, "Topic, or its end: corners, wctls/lines")
      ->required();
  table
      ->add_option("--format", options->format,
                   "csv: a row for each corner, line ...; jsonl: a message a line")
      ->check(CLI::IsMember({"csv", "jsonl"}))
      ->capture_default_str();
  table->add_option("-o,--output", options->output, "File to write; else standard output");
  return {line, [actions] { return run(*actions); }};
}

}  // namespace quoin::deploy
