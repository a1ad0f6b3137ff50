// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/localization/kind.hpp"
#include "services/localization/localizer_method.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(localizer_component(localization_kind(), make_localizer));

}  // namespace
