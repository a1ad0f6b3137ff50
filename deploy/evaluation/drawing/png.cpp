// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/png.hpp"

#include <cmath>
#include <librsvg/rsvg.h>
#include <memory>
#include <stdexcept>

namespace quoin::deploy {

namespace {

constexpr double most_pixels = 20000.0;  // of a side

struct Release {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

[[noreturn]] void fail(GError* error) {
  const std::string what = error != nullptr ? error->message : "unknown";
  if (error != nullptr) g_error_free(error);
  throw std::runtime_error("the picture cannot be drawn: " + what);
}

}  // namespace

std::string png_of(const std::string& svg, double scale) {
  GError* error = nullptr;
  const Owned<RsvgHandle> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (!handle) fail(error);
  double width = 0.0;
  double height = 0.0;
  if (rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height) == 0) fail(nullptr);
  width = std::ceil(width * scale);
  height = std::ceil(height * scale);
  if (!(width >= 1.0 && height >= 1.0 && width <= most_pixels && height <= most_pixels)) {
    throw std::runtime_error("a picture of that size cannot be drawn");
  }
  const Owned<cairo_surface_t> surface(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)));
  const Owned<cairo_t> context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  const RsvgRectangle viewport{0.0, 0.0, width, height};
  if (rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error) == 0) fail(error);
  std::string file;
  const auto append = [](void* to, const unsigned char* bytes, unsigned count) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
  };
  if (cairo_surface_write_to_png_stream(surface.get(), append, &file) != CAIRO_STATUS_SUCCESS) {
    fail(nullptr);
  }
  return file;
}

}  // namespace quoin::deploy
