// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/temporary_folder.hpp"

namespace quoin::tests {

/// Writes a gzip file into the folder and returns its path.
inline std::filesystem::path write_compressed(const TemporaryFolder& folder,
                                              const std::string& name, const std::string& content) {
  const std::filesystem::path file = folder.path() / name;
  gzFile stream = gzopen(file.c_str(), "wb");
  EXPECT_EQ(gzwrite(stream, content.data(), static_cast<unsigned>(content.size())),
            static_cast<int>(content.size()));
  EXPECT_EQ(gzclose(stream), Z_OK);
  return file;
}

}  // namespace quoin::tests
