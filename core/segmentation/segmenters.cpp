// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segmenters.hpp"

namespace quoin {

template Segmenter Segmenters::make<Segmenter>(std::string_view, const ParameterSettings&);

}  // namespace quoin
