// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/export/visibility.hpp"

#include <string_view>

namespace quoin::deploy {

namespace {

using std::filesystem::path;
using std::filesystem::perms;

bool is_below(const path& file, std::string_view folder) {
  return file.string().starts_with(std::string(folder) + "/");
}

bool others_may(const path& file, perms what) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  return !error && (status.permissions() & what) == what;
}

}  // namespace

std::string obstacle_to_others(const path& file, bool executable) {
  std::error_code error;
  const path real = std::filesystem::canonical(file, error);
  if (error) return file.string() + " is not there: " + error.message();
  for (const char* hidden : {"/home", "/root", "/run/user", "/tmp", "/var/tmp"}) {
    if (is_below(real, hidden)) {
      return real.string() + " is below " + hidden + ", which the units do not see";
    }
  }
  for (path folder = real.parent_path(); folder != folder.root_path();
       folder = folder.parent_path()) {
    if (!others_may(folder, perms::others_exec)) {
      return folder.string() + " is closed to other users (chmod o+x)";
    }
  }
  const perms wanted = executable ? perms::others_exec | perms::others_read : perms::others_read;
  if (others_may(real, wanted)) return "";
  return real.string() + " is closed to other users (chmod o+" + (executable ? "rx" : "r") + ")";
}

}  // namespace quoin::deploy
