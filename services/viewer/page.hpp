// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace quoin::viewer {

/// A file of the page, as it was when this program was built.
struct PageFile {
  std::string_view path;  ///< "/", "/view.js"
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::string_view text;
};

[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace quoin::viewer
