// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/papers/published_figures.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace quoin {
namespace {

// clang-format off
// WCTLS paper: sigma x, sigma y [mm] of UTLS, WTLS, WCTLS; a row per corner.
constexpr std::array<std::array<double, 6>, 18> wctls_table_1{{
    {42.02, 35.08, 42.98, 37.28, 13.43, 10.43},
    {38.75, 46.31, 38.38, 45.70, 8.86, 7.18},
    {37.45, 35.28, 37.48, 35.27, 11.04, 12.96},
    {38.74, 35.15, 38.77, 35.14, 11.76, 12.56},
    {44.09, 29.29, 43.97, 29.36, 13.89, 10.21},
    {42.52, 29.67, 42.41, 29.71, 13.59, 11.50},
    {40.39, 33.50, 40.35, 33.48, 14.14, 12.12},
    {108.08, 102.57, 110.27, 104.08, 41.75, 37.57},
    {27.27, 35.27, 27.33, 35.31, 10.51, 13.83},
    {37.83, 43.36, 37.67, 43.40, 21.46, 26.95},
    {187.04, 97.18, 187.14, 97.10, 84.10, 40.56},
    {38.77, 74.93, 39.51, 75.36, 25.53, 32.23},
    {42.22, 85.81, 42.97, 85.75, 13.33, 14.08},
    {56.23, 51.97, 56.20, 51.97, 33.67, 29.03},
    {37.57, 95.53, 37.59, 95.84, 17.56, 40.37},
    {78.55, 58.15, 78.11, 57.53, 29.05, 25.87},
    {86.91, 62.53, 86.53, 61.90, 35.16, 34.73},
    {156.12, 174.29, 156.13, 174.26, 59.12, 66.36}}};

constexpr std::array<std::array<double, 6>, 23> wctls_table_2{{
    {46.59, 57.20, 46.63, 57.21, 37.36, 51.30},
    {88.80, 36.59, 88.79, 36.59, 65.74, 30.47},
    {232.04, 124.88, 231.13, 124.58, 127.36, 61.92},
    {36.28, 58.61, 36.41, 58.66, 18.95, 42.12},
    {40.86, 68.15, 41.03, 68.23, 16.55, 22.29},
    {54.22, 67.46, 54.26, 67.50, 43.38, 51.52},
    {54.52, 66.33, 54.56, 66.35, 37.89, 41.68},
    {49.08, 54.08, 49.08, 53.82, 53.34, 32.23},
    {53.57, 142.46, 53.57, 142.51, 35.97, 69.75},
    {171.83, 42.70, 171.66, 42.66, 136.69, 37.41},
    {136.30, 89.89, 136.22, 89.89, 87.59, 69.42},
    {41.29, 123.92, 41.00, 123.30, 47.36, 100.55},
    {34.07, 38.74, 34.03, 38.77, 28.50, 24.47},
    {97.49, 100.88, 97.28, 100.36, 45.03, 27.95},
    {100.19, 104.79, 100.12, 104.35, 45.32, 28.25},
    {62.86, 63.33, 62.90, 63.46, 48.09, 42.58},
    {36.76, 89.71, 36.76, 89.69, 33.58, 82.10},
    {112.84, 131.71, 112.86, 131.72, 50.22, 82.49},
    {90.89, 41.36, 90.90, 41.36, 69.83, 31.80},
    {73.03, 36.45, 73.15, 36.47, 47.24, 26.80},
    {55.88, 67.45, 55.67, 67.33, 42.24, 46.54},
    {56.72, 69.15, 56.57, 69.13, 43.90, 54.87},
    {31.48, 43.63, 31.48, 43.63, 32.11, 36.14}}};

// CWLF paper: sigma x, sigma y [mm] of CWLF, Arras-Siegwart; a row per corner.
constexpr std::array<std::array<double, 4>, 23> cwlf_table_1{{
    {28.43, 60.37, 40.62, 19.58},
    {24.76, 19.09, 40.50, 45.38},
    {19.53, 17.45, 26.63, 41.83},
    {19.61, 15.64, 27.59, 32.48},
    {20.34, 14.49, 26.45, 26.83},
    {30.90, 16.63, 31.82, 25.50},
    {29.44, 22.99, 30.17, 24.58},
    {21.54, 24.51, 21.98, 27.98},
    {38.43, 45.73, 41.23, 46.38},
    {11.69, 16.38, 13.61, 32.08},
    {24.60, 20.88, 31.00, 35.83},
    {22.34, 14.61, 27.53, 36.39},
    {24.32, 15.41, 32.70, 39.15},
    {32.97, 59.41, 41.46, 84.39},
    {28.45, 2.69, 56.06, 20.21},
    {54.07, 8.38, 80.85, 15.20},
    {1.54, 9.18, 9.64, 10.43},
    {9.14, 2.34, 6.88, 10.56},
    {11.78, 5.19, 16.11, 10.78},
    {12.50, 7.01, 16.40, 9.30},
    {13.32, 4.54, 40.39, 9.14},
    {13.81, 6.80, 44.38, 16.32},
    {35.90, 10.56, 70.67, 23.19}}};

constexpr std::array<std::array<double, 4>, 15> cwlf_table_2{{
    {3.31, 10.44, 17.77, 35.68},
    {6.10, 11.94, 31.48, 42.12},
    {2.68, 13.26, 10.53, 80.83},
    {1.19, 2.25, 6.33, 5.87},
    {1.38, 3.69, 5.34, 12.81},
    {138.32, 23.32, 6.03, 21.87},
    {12.10, 11.43, 21.15, 23.25},
    {10.19, 12.66, 17.03, 21.80},
    {26.95, 13.09, 31.52, 20.58},
    {27.97, 23.94, 37.93, 36.71},
    {15.84, 23.50, 30.88, 35.21},
    {12.18, 17.15, 22.07, 22.12},
    {66.22, 14.37, 68.68, 16.78},
    {61.49, 16.91, 61.98, 17.72},
    {1.90, 10.91, 11.01, 13.38}}};
// clang-format on

template <std::size_t Columns, std::size_t Rows>
PublishedTable table(std::string paper, std::string place, std::string environment,
                     const std::vector<std::string>& methods,
                     const std::array<std::array<double, Columns>, Rows>& values) {
  PublishedTable result{std::move(paper), std::move(place), std::move(environment), {}};
  for (std::size_t k = 0; k < methods.size(); ++k) {
    PublishedSigmas sigmas{methods[k], {}, {}};
    for (const auto& row : values) {
      sigmas.x.push_back(row[2 * k]);
      sigmas.y.push_back(row[2 * k + 1]);
    }
    result.methods.push_back(std::move(sigmas));
  }
  return result;
}

const std::string wctls_paper = "WCTLS (Prieto-Fernandez et al. 2026)";
const std::string cwlf_paper = "CWLF (Prieto-Fernandez et al. 2024)";

}  // namespace

std::vector<PublishedTable> published_wctls_tables() {
  const std::vector<std::string> methods{"utls", "wtls", "wctls"};
  return {table(wctls_paper, "Table 1", "environment_a", methods, wctls_table_1),
          table(wctls_paper, "Table 2", "environment_b", methods, wctls_table_2)};
}

std::vector<PublishedArea> published_wctls_areas() {
  return {{wctls_paper, "Fig. 4 a", "environment_a", "utls", 4498.5, 330.3},
          {wctls_paper, "Fig. 4 a", "environment_a", "wtls", 4594.7, 355.0},
          {wctls_paper, "Fig. 4 a", "environment_a", "wctls", 626.2, 178.7},
          {wctls_paper, "Fig. 4 b", "environment_b", "utls", 8125.3, 914.1},
          {wctls_paper, "Fig. 4 b", "environment_b", "wtls", 8123.6, 911.1},
          {wctls_paper, "Fig. 4 b", "environment_b", "wctls", 3468.5, 640.9}};
}

std::vector<PublishedTable> published_cwlf_tables() {
  const std::vector<std::string> methods{"cwlf", "arras_siegwart"};
  return {table(cwlf_paper, "Table I", "cwlf_environment_a", methods, cwlf_table_1),
          table(cwlf_paper, "Table II", "cwlf_environment_b", methods, cwlf_table_2)};
}

}  // namespace quoin
