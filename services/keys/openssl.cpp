// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/openssl.hpp"

#include <openssl/err.h>

namespace quoin {

std::runtime_error openssl_error(const std::string& what) {
  std::string text = "cannot " + what;
  if (const unsigned long code = ERR_peek_last_error(); code != 0) {
    const char* reason = ERR_reason_error_string(code);
    if (reason != nullptr) text += std::string(": ") + reason;
  }
  ERR_clear_error();
  return std::runtime_error(text);
}

OpensslBio memory_bio(const std::string& text) {
  OpensslBio bio(BIO_new(BIO_s_mem()));
  require(bio != nullptr, "allocate memory");
  const int size = static_cast<int>(text.size());
  require(size == 0 || BIO_write(bio.get(), text.data(), size) == size, "allocate memory");
  return bio;
}

std::string text_of(BIO* bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio, &data);
  return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string();
}

}  // namespace quoin
