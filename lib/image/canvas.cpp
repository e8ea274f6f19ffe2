#include "image/canvas.h"

#include <cairo-ft.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <numbers>

#include "core/error.h"
#include "core/text/utf8.h"

namespace phos::inline image {

namespace {

constexpr const char* kFont = "DejaVu Sans";
/// Half the height of figures, of the size of the font.
constexpr double kHalfFigure = 0.365;

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  PHOS_CHECK(status == CAIRO_STATUS_SUCCESS, cairo_status_to_string(status));
}

struct Freed {
  void operator()(FcPattern* p) const { FcPatternDestroy(p); }
  void operator()(cairo_font_options_t* o) const { cairo_font_options_destroy(o); }
};

/// The file of the font, and nothing that the settings of fontconfig say of how it is drawn.
std::unique_ptr<FcPattern, Freed> font_file() {
  std::unique_ptr<FcPattern, Freed> asked(
      FcNameParse(reinterpret_cast<const FcChar8*>("DejaVu Sans:style=Book")));
  std::unique_ptr<FcPattern, Freed> bare(FcPatternCreate());
  if (!asked || !bare) throw std::bad_alloc();
  FcDefaultSubstitute(asked.get());
  FcResult result = FcResultNoMatch;
  const std::unique_ptr<FcPattern, Freed> found(FcFontMatch(nullptr, asked.get(), &result));
  FcChar8 *family = nullptr, *file = nullptr;
  int index = 0;
  if (!found || FcPatternGetString(found.get(), FC_FAMILY, 0, &family) != FcResultMatch ||
      std::strcmp(reinterpret_cast<const char*>(family), kFont) != 0 ||
      FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch ||
      FcPatternGetInteger(found.get(), FC_INDEX, 0, &index) != FcResultMatch)
    throw Error(ExitCode::bad_input, "words of a picture",
                text("the font ", kFont, " is not installed; install it (Debian: fonts-dejavu-core)"));
  FcPatternAddString(bare.get(), FC_FILE, file);
  FcPatternAddInteger(bare.get(), FC_INDEX, index);
  return bare;
}

cairo_font_face_t* font() {
  static cairo_font_face_t* const face = cairo_ft_font_face_create_for_pattern(font_file().get());
  check(cairo_font_face_status(face));
  return face;
}

/// What Cairo accepts: UTF-8 without control characters.
std::string clean(std::string_view words) {
  std::string out;
  for (std::size_t i = 0; i < words.size();) {
    const auto c = static_cast<unsigned char>(words[i]);
    const std::size_t n = utf8_length(words, i);
    if (n == 0)
      out += static_cast<char>(0xc0 | c >> 6), out += static_cast<char>(0x80 | (c & 0x3f));
    else if (c < 0x20 || c == 0x7f)
      out += ' ';
    else
      out.append(words, i, n);
    i += n == 0 ? 1 : n;
  }
  return out;
}

/// Cairo numbers the surfaces of a process in their ids, to which nothing refers.
std::string without_numbers_of_surfaces(std::string svg) {
  constexpr std::string_view kId = " id=\"surface";
  for (std::size_t at = svg.find(kId); at != std::string::npos; at = svg.find(kId, at)) {
    const std::size_t end = svg.find('"', at + kId.size());
    if (end == std::string::npos) break;
    svg.erase(at, end + 1 - at);
  }
  return svg;
}

}  // namespace

struct Canvas::Surface {
  Surface() = default;
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  ~Surface() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
  void begin() {
    check(cairo_surface_status(surface));
    context = cairo_create(surface);
    const std::unique_ptr<cairo_font_options_t, Freed> options(cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context, options.get());
    cairo_set_antialias(context, CAIRO_ANTIALIAS_GRAY);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    check(cairo_status(context));
  }
  void colour(const Colour8& c) { cairo_set_source_rgb(context, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0); }
  void letters(double size) {
    cairo_set_font_face(context, font());
    cairo_set_font_size(context, size);
  }
  double advance(const std::string& words, double size) {
    letters(size);
    cairo_text_extents_t extents;
    cairo_text_extents(context, words.c_str(), &extents);
    check(cairo_status(context));
    return extents.x_advance;
  }

  std::string svg;  ///< the text that the surface writes to
  cairo_surface_t* surface = nullptr;
  cairo_t* context = nullptr;
};

Canvas::Canvas(std::unique_ptr<Surface> surface) : surface_(std::move(surface)) {}
Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

Canvas Canvas::pixels(int width, int height, const Colour8& paper, int scale) {
  PHOS_CHECK(width > 0 && height > 0 && scale > 0 && std::max(width, height) <= kMostCanvasPixels / scale,
             width, " x ", height, " x ", scale);
  auto s = std::make_unique<Surface>();
  s->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width * scale, height * scale);
  s->begin();
  cairo_scale(s->context, scale, scale);
  Canvas canvas(std::move(s));
  canvas.fill(0, 0, width, height, paper);
  return canvas;
}

Canvas Canvas::over(const Picture& picture) {
  Canvas canvas = pixels(picture.width, picture.height, {});
  cairo_surface_t* surface = canvas.surface_->surface;
  cairo_surface_flush(surface);
  unsigned char* to = cairo_image_surface_get_data(surface);
  const std::uint8_t* from = picture.rgb.data();
  for (int y = 0; y < picture.height; ++y, to += cairo_image_surface_get_stride(surface))
    for (int x = 0; x < picture.width; ++x, from += 3) {
      const std::uint32_t pixel = std::uint32_t{from[0]} << 16 | std::uint32_t{from[1]} << 8 | from[2];
      std::memcpy(to + 4 * x, &pixel, sizeof pixel);
    }
  cairo_surface_mark_dirty(surface);
  return canvas;
}

Canvas Canvas::svg(int width, int height, const Colour8& paper) {
  PHOS_CHECK(width > 0 && height > 0, width, " x ", height);
  auto s = std::make_unique<Surface>();
  const auto write = [](void* to, const unsigned char* bytes, unsigned size) {
    try {
      static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), size);
      return CAIRO_STATUS_SUCCESS;
    } catch (const std::bad_alloc&) {
      return CAIRO_STATUS_NO_MEMORY;
    }
  };
  s->surface = cairo_svg_surface_create_for_stream(write, &s->svg, width, height);
  check(cairo_surface_status(s->surface));
  cairo_svg_surface_set_document_unit(s->surface, CAIRO_SVG_UNIT_PX);
  s->begin();
  Canvas canvas(std::move(s));
  canvas.fill(0, 0, width, height, paper);
  return canvas;
}

void Canvas::stroke(const std::vector<PlotPoint>& path, const Colour8& colour, double width, bool dashes) {
  if (path.size() < 2) return;
  cairo_t* const c = surface_->context;
  surface_->colour(colour);
  cairo_set_line_width(c, width);
  constexpr double kDashes[] = {6, 4};
  cairo_set_dash(c, kDashes, dashes ? 2 : 0, 0);
  cairo_set_line_cap(c, dashes ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  cairo_move_to(c, path[0].x, path[0].y);
  for (std::size_t i = 1; i < path.size(); ++i) cairo_line_to(c, path[i].x, path[i].y);
  const bool closed = path.size() > 2 && path[0].x == path.back().x && path[0].y == path.back().y;
  if (closed) cairo_close_path(c);
  cairo_stroke(c);
  check(cairo_status(c));
}

void Canvas::dot(const PlotPoint& centre, double radius, const Colour8& colour) {
  cairo_t* const c = surface_->context;
  surface_->colour(colour);
  cairo_new_path(c);
  cairo_arc(c, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(c);
  check(cairo_status(c));
}

void Canvas::fill(double x, double y, double width, double height, const Colour8& colour) {
  cairo_t* const c = surface_->context;
  surface_->colour(colour);
  cairo_rectangle(c, x, y, width, height);
  cairo_fill(c);
  check(cairo_status(c));
}

void Canvas::write(const PlotPoint& at, std::string_view words, const Lettering& l) {
  cairo_t* const c = surface_->context;
  const std::string shown = clean(words);
  const double width = surface_->advance(shown, l.size);
  const double back = l.align == Align::left ? 0 : l.align == Align::middle ? width / 2 : width;
  cairo_save(c);
  cairo_translate(c, at.x, at.y);
  if (l.upwards) cairo_rotate(c, -std::numbers::pi / 2);
  cairo_move_to(c, -back, kHalfFigure * l.size);
  if (l.halo) {
    cairo_text_path(c, shown.c_str());
    surface_->colour(*l.halo);
    cairo_set_line_width(c, l.size / 3);
    cairo_set_dash(c, nullptr, 0, 0);
    cairo_stroke(c);
    cairo_move_to(c, -back, kHalfFigure * l.size);
  }
  surface_->colour(l.colour);
  cairo_show_text(c, shown.c_str());
  cairo_new_path(c);
  cairo_restore(c);
  check(cairo_status(c));
}

double Canvas::width_of(std::string_view words, double size) const {
  return surface_->advance(clean(words), size);
}

std::string Canvas::fitting(std::string_view words, double width, double size) const {
  std::string shown = clean(words);
  if (surface_->advance(shown, size) <= width) return shown;
  while (!shown.empty() && surface_->advance(shown + "...", size) > width) {
    while (!shown.empty() && (shown.back() & 0xc0) == 0x80) shown.pop_back();
    if (!shown.empty()) shown.pop_back();
  }
  return shown + "...";
}

Picture Canvas::finish_picture() {
  cairo_surface_t* const surface = surface_->surface;
  cairo_surface_flush(surface);
  PHOS_CHECK(cairo_surface_get_type(surface) == CAIRO_SURFACE_TYPE_IMAGE, "not of pixels");
  Picture out =
      make_picture(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {});
  const unsigned char* from = cairo_image_surface_get_data(surface);
  std::uint8_t* to = out.rgb.data();
  for (int y = 0; y < out.height; ++y, from += cairo_image_surface_get_stride(surface))
    for (int x = 0; x < out.width; ++x, to += 3) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, from + 4 * x, sizeof pixel);
      to[0] = static_cast<std::uint8_t>(pixel >> 16), to[1] = static_cast<std::uint8_t>(pixel >> 8),
      to[2] = static_cast<std::uint8_t>(pixel);
    }
  surface_.reset();
  return out;
}

std::string Canvas::finish_svg() {
  cairo_surface_finish(surface_->surface);
  check(cairo_surface_status(surface_->surface));
  PHOS_CHECK(!surface_->svg.empty(), "no SVG");
  std::string out = without_numbers_of_surfaces(std::move(surface_->svg));
  surface_.reset();
  return out;
}

}  // namespace phos::inline image
