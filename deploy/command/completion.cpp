// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "deploy/command/commands.hpp"

namespace quoin::deploy {

namespace {

/// The commands and long options that may follow `line`, with a blank between them.
std::string words_after(const CLI::App& line) {
  std::string words;
  for (const CLI::App* command : line.get_subcommands({})) words += command->get_name() + " ";
  for (const CLI::Option* option : line.get_options({})) {
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
  }
  if (!words.empty()) words.pop_back();
  return words;
}

/// One case of the script for `line`, which is reached by these words, and for what is below it.
void print_cases(const CLI::App& line, const std::string& path) {
  std::cout << "    '" << path << "') words='" << words_after(line) << "' ;;\n";
  for (const CLI::App* command : line.get_subcommands({})) {
    print_cases(*command, path + (path.empty() ? "" : " ") + command->get_name());
  }
}

/// Files are completed wherever no option is begun. Works in zsh by its bashcompinit.
void print_script(const CLI::App& app, const std::string& shell) {
  if (shell == "zsh") std::cout << "#compdef quoin\nautoload -U +X bashcompinit && bashcompinit\n";
  std::cout << R"(_quoin() {
  local current=${COMP_WORDS[COMP_CWORD]} path='' words='' word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$word" in
      -*|*/*|*.*|*=*) ;;
      *) case " $(_quoin_commands "$path") " in *" $word "*) path="${path:+$path }$word" ;; esac ;;
    esac
  done
  words=$(_quoin_commands "$path")
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  if [[ $current != -* && -n $path ]]; then COMPREPLY+=($(compgen -f -- "$current")); fi
}
_quoin_commands() {
  local words=''
  case "$1" in
)";
  print_cases(app, "");
  std::cout << R"(  esac
  printf '%s' "$words"
}
complete -o filenames -F _quoin quoin
)";
}

}  // namespace

Command add_completion(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("completion", "Print the script that completes commands in a shell");
  const auto shell = std::make_shared<std::string>("bash");
  line->add_option("shell", *shell, "bash or zsh")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->capture_default_str();
  return {line, [&app, shell] {
            print_script(app, *shell);
            return std::cout.flush() ? exit_ok : exit_failure;
          }};
}

}  // namespace quoin::deploy
