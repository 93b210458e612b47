#include "sim/draw/png.h"

#include <fmt/core.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>

#include "kinemesh/error.h"

namespace kinemesh::draw {
namespace {

struct Release {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

[[noreturn]] void fail(GError* error) {
  const std::string what = error ? error->message : "for no known reason";
  g_clear_error(&error);
  throw InputError("cannot draw: " + what);
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw InputError(std::string("cannot draw: ") + cairo_status_to_string(status));
}

void check_bytes(std::size_t n) {
  if (n <= most_svg_bytes) return;
  throw InputError(
      fmt::format("a drawing of {} MB, at most {} become a PNG: a part of it with --zoom, or SVG",
                  n / 1'000'000, most_svg_bytes / 1'000'000));
}

void check_pixels(double width, double height) {
  if (width * height <= most_pixels) return;
  throw InputError(
      fmt::format("{:.0f} x {:.0f} pixels, at most {} million become a PNG: a smaller --width, or SVG", width,
                  height, most_pixels / 1'000'000));
}

cairo_status_t append(void* png, const unsigned char* bytes, unsigned n) {
  static_cast<std::string*>(png)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string png_of(std::string_view svg) {
  check_bytes(svg.size());
  GError* error = nullptr;
  // Without the limit that guards against foreign files: these drawings are ours.
  GInputStream* stream =
      g_memory_input_stream_new_from_data(svg.data(), static_cast<gssize>(svg.size()), nullptr);
  const Owned<RsvgHandle> handle(
      rsvg_handle_new_from_stream_sync(stream, nullptr, RSVG_HANDLE_FLAG_UNLIMITED, nullptr, &error));
  g_object_unref(stream);
  if (!handle) fail(error);
  double width = 0.0, height = 0.0;
  if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height))
    throw InputError("cannot draw: no size");
  check_pixels(width, height);
  const Owned<cairo_surface_t> surface(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height))));
  check(cairo_surface_status(surface.get()));
  const Owned<cairo_t> context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);  // where the drawing ends within the last row of pixels
  cairo_paint(context.get());
  const RsvgRectangle page{0.0, 0.0, width, height};
  if (!rsvg_handle_render_document(handle.get(), context.get(), &page, &error)) fail(error);
  std::string png;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &png));
  return png;
}

}  // namespace kinemesh::draw
