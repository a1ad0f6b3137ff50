// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "services/files/atomic_file.hpp"

namespace quoin::deploy {

namespace {

/// Text as it stands, for man(7): no character of it is a request or an escape.
std::string roff(const std::string& text) {
  std::string result;
  bool line_begins = true;
  for (const char character : text) {
    if (line_begins && (character == '.' || character == '\'')) result += "\\&";
    if (character == '\\') {
      result += "\\e";
    } else if (character == '-') {
      result += "\\-";
    } else {
      result += character;
    }
    line_begins = character == '\n';
  }
  return result;
}

std::string head(const std::string& page, const std::string& description) {
  std::string title;
  for (const char character : page) {
    title += static_cast<char>(std::toupper(static_cast<unsigned char>(character)));
  }
  return ".TH " + roff(title) + " 1 \"\" \"quoin " QUOIN_VERSION "\" Quoin\n.SH NAME\n" +
         roff(page) + " \\- " + roff(description) + "\n";
}

/// What may follow the words of a command, in the order of the help.
std::string synopsis(const CLI::App& line, const std::string& words) {
  std::string text = ".B " + roff(words) + "\n";
  text += "[\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : line.get_options({})) {
    if (!option->get_positional()) continue;
    const std::string name = "\\fI" + roff(option->get_name(true)) + "\\fR" +
                             (option->get_items_expected_max() > 1 ? "..." : "");
    text += option->get_required() ? " " + name : " [" + name + "]";
  }
  if (!line.get_subcommands({}).empty()) text += " \\fICOMMAND\\fR";
  return text + "\n";
}

std::string option_list(const CLI::App& line) {
  std::string text;
  for (const CLI::Option* option : line.get_options({})) {
    text += ".TP\n\\fB" + roff(option->get_name(option->get_positional(), true)) + "\\fR";
    if (option->get_items_expected_max() > 0) {
      text += " \\fI" + roff(option->get_type_name()) + "\\fR";
    }
    text += "\n" + roff(option->get_description());
    if (!option->get_default_str().empty()) {
      text += " (default " + roff(option->get_default_str()) + ")";
    }
    text += "\n";
  }
  return text;
}

/// The commands below `line`, each with its own options.
std::string sections_below(const CLI::App& line, const std::string& words) {
  std::string text;
  for (const CLI::App* command : line.get_subcommands({})) {
    const std::string own = words + " " + command->get_name();
    text += ".SS " + roff(own) + "\n" + roff(command->get_description()) + ".\n.PP\n" +
            synopsis(*command, own) + option_list(*command) + sections_below(*command, own);
  }
  return text;
}

std::string exit_codes(const CLI::App& app) {
  return ".SH \"EXIT STATUS\"\n" + roff(app.get_footer()) + "\n";
}

std::string page_of_command(const CLI::App& app, const CLI::App& line) {
  const std::string words = "quoin " + line.get_name();
  std::string text = head("quoin-" + line.get_name(), line.get_description());
  text += ".SH SYNOPSIS\n" + synopsis(line, words) + ".SH OPTIONS\n" + option_list(line);
  if (!line.get_subcommands({}).empty()) text += ".SH COMMANDS\n" + sections_below(line, words);
  return text + exit_codes(app) + ".SH \"SEE ALSO\"\n.BR quoin (1)\n";
}

std::string page_of_all(const CLI::App& app) {
  std::string text = head("quoin", app.get_description());
  text += ".SH SYNOPSIS\n.B quoin\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
  for (const CLI::App* line : app.get_subcommands({})) {
    text += ".TP\n.BR quoin\\-" + roff(line->get_name()) + " (1)\n" +
            roff(line->get_description()) + "\n";
  }
  return text + ".SH OPTIONS\n" + option_list(app) + exit_codes(app);
}

std::string page_of_program(const std::string& program, const std::string& description) {
  return head(program, description) + ".SH SYNOPSIS\n.B " + roff(program) +
         "\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\nStarted by\n.BR quoin\\-up (1)\nor by the units "
         "of\n"
         ".BR quoin\\-export (1).\nIts options are told by\n.BR \\-\\-help .\n"
         ".SH \"SEE ALSO\"\n.BR quoin\\-methods (1)\n";
}

void write_page(const std::filesystem::path& folder, const std::string& name,
                const std::string& text) {
  const std::filesystem::path file = folder / (name + ".1");
  if (const int error = write_atomically(file, text, 0644); error != 0) {
    throw std::runtime_error("cannot write " + file.string() + ": " + std::strerror(error));
  }
}

void write_pages(const CLI::App& app, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_page(folder, "quoin", page_of_all(app));
  for (const CLI::App* line : app.get_subcommands({})) {
    write_page(folder, "quoin-" + line->get_name(), page_of_command(app, *line));
  }
  write_page(folder, process_program(),
             page_of_program(process_program(), "services of a Quoin deployment in one process"));
  write_page(folder, "quoin-rplidar-emulator",
             page_of_program("quoin-rplidar-emulator",
                             "emulated RPLIDAR on a pseudo-terminal or the network"));
  std::set<std::string> programs;
  for (const KindInfo* kind : kinds().kinds) {
    if (kind->program.empty() || !programs.insert(kind->program).second) continue;
    write_page(folder, kind->program,
               page_of_program(kind->program, "service of Quoin: " + kind->description));
  }
}

}  // namespace

Command add_man(CLI::App& app) {
  CLI::App* line = app.add_subcommand("man", "Write manual pages of all commands and programs");
  const auto folder = std::make_shared<std::string>();
  line->add_option("-o,--output", *folder, "Folder for the pages, section 1")->required();
  return {line, [&app, folder] {
            write_pages(app, *folder);
            return static_cast<int>(exit_ok);
          }};
}

}  // namespace quoin::deploy
