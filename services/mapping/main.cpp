// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/localization/localizer_method.hpp"
#include "services/mapping/kind.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(localizer_component(mapping_kind(), make_mapper));

}  // namespace
