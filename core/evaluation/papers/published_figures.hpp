// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace quoin {

/// Standard deviations of corners by one method, as a paper prints them; one value per corner.
struct PublishedSigmas {
  std::string method;
  std::vector<double> x;  ///< [mm]
  std::vector<double> y;  ///< [mm]
};

/// A paper's table of corner uncertainties in one of its environments.
struct PublishedTable {
  std::string paper;
  std::string place;        ///< table of the paper
  std::string environment;  ///< the built-in world that stands for it
  std::vector<PublishedSigmas> methods;
};

/// Median over a scan's corners of the one-sigma ellipse area, over repeated scans.
struct PublishedArea {
  std::string paper;
  std::string place;  ///< figure of the paper; the numbers are in the text about it
  std::string environment;
  std::string method;
  double area = 0.0;    ///< [mm^2]
  double spread = 0.0;  ///< [mm^2] as printed behind the +-
};

/// WCTLS paper, Tables 1 and 2.
[[nodiscard]] std::vector<PublishedTable> published_wctls_tables();
/// WCTLS paper, Fig. 4.
[[nodiscard]] std::vector<PublishedArea> published_wctls_areas();
/// CWLF paper, Tables I and II.
[[nodiscard]] std::vector<PublishedTable> published_cwlf_tables();

}  // namespace quoin
