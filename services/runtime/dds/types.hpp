// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/TypeSupport.hpp>

namespace quoin::runtime {

/// DDS type support of one of the idl types; specialised in types.cpp.
template <class T>
[[nodiscard]] eprosima::fastdds::dds::TypeSupport type_support();

}  // namespace quoin::runtime
