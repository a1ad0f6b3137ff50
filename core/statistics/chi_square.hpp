// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace quoin {

/// Quantile of the chi-square distribution with two degrees of freedom at 95 %, -2 ln(0.05).
inline constexpr double chi_square_2_95 = 5.991464547107979;

/// The same with three degrees of freedom.
inline constexpr double chi_square_3_95 = 7.814727903251178;

/// Quantile of the standard normal distribution at 97.5 %.
inline constexpr double normal_97_5 = 1.959963984540054;

/// Quantile of chi-square over its degrees of freedom, by that of the standard normal distribution:
/// its cube root is about normal (Wilson and Hilferty 1931).
[[nodiscard]] inline double reduced_chi_square(double freedom, double normal_quantile) {
  const double spread = 2.0 / (9.0 * freedom);
  const double root = 1.0 - spread + normal_quantile * std::sqrt(spread);
  return root * root * root;
}

/// Median of chi-square with so many degrees of freedom.
[[nodiscard]] inline double median_chi_square(double freedom) {
  return freedom * reduced_chi_square(freedom, 0.0);
}

/// Factor of the covariance of what was fitted with such residuals: the reduced chi-square where it
/// is larger than noise gives once in 1000 times, else 1.
[[nodiscard]] inline double residual_scale(double chi_square, double freedom) {
  constexpr double once_in_1000 = 3.090232306167813;  // of the standard normal distribution
  if (!(freedom >= 1.0)) return 1.0;
  const double reduced = chi_square / freedom;
  return reduced > reduced_chi_square(freedom, once_in_1000) ? reduced : 1.0;
}

}  // namespace quoin
