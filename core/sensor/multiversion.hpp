// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>  // brings __GLIBC__

/// Marks a function that loops over the points of a scan. It is compiled for several generations of
/// x86-64 and the best one for the machine is chosen when the program is loaded.
///
/// Not under the address and thread sanitizers: the choice is made by indirect functions, which run
/// before the sanitizers' runtime is ready.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define QUOIN_MULTIVERSION \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define QUOIN_MULTIVERSION
#endif
