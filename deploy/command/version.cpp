// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"

namespace quoin::deploy {

std::string version_text() {
  return "quoin " QUOIN_VERSION " (" QUOIN_COMPILER ", " QUOIN_BUILD_TYPE ")";
}

Command add_version(CLI::App& app) {
  CLI::App* line = app.add_subcommand("version", "Tell the version and how this program was built");
  const auto json = std::make_shared<bool>(false);
  line->add_flag("--json", *json, "As a JSON object");
  return {line, [json] {
            if (*json) {
              const nlohmann::ordered_json object{{"version", QUOIN_VERSION},
                                                  {"compiler", QUOIN_COMPILER},
                                                  {"build_type", QUOIN_BUILD_TYPE}};
              std::cout << object.dump(2) << '\n';
            } else {
              std::cout << version_text() << '\n';
            }
            return static_cast<int>(exit_ok);
          }};
}

}  // namespace quoin::deploy
