// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quoin::deploy {

/// Takes secrets out of texts that are given to others: the values of environment variables whose
/// names say that they are secret, the values behind such names in YAML, JSON and NAME=VALUE lines,
/// passwords in URLs, and private keys.
class Redaction {
 public:
  /// `environment` holds "NAME=value".
  explicit Redaction(const std::vector<std::string>& environment);

  [[nodiscard]] std::string operator()(std::string text) const;

 private:
  std::vector<std::string> values_;
};

/// Whether what has this name is secret: it has token, password, secret, credential or the like in
/// it.
[[nodiscard]] bool is_secret_name(std::string_view name);

}  // namespace quoin::deploy
