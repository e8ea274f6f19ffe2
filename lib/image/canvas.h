// Lines, dots, rectangles and words, drawn by Cairo as pixels or as SVG.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/colour8.h"

namespace phos::inline image {

/// x to the right, y downwards, in units of a canvas: pixels of its `width` and `height`, before `scale`.
struct PlotPoint {
  double x = 0, y = 0;
};

enum class Align { left, middle, right };

inline constexpr int kLetter = 14;  ///< size of words on plots, units of a canvas

/// How words look. The font is DejaVu Sans.
struct Lettering {
  Colour8 colour{40, 40, 40};
  double size = kLetter;  ///< of the font, units of the canvas
  Align align = Align::left;
  bool upwards = false;           ///< turned by 90 degrees, counter-clockwise
  std::optional<Colour8> halo{};  ///< colour of an edge about the letters, a sixth of `size` wide
};

/// The longest side of a canvas of pixels, after `scale`.
inline constexpr int kMostCanvasPixels = 32767;

/// The same calls give the same bytes on one machine, whatever its settings of fonts: greys smooth the edges,
/// letters are not fitted to pixels. Parts outside of the canvas are not drawn.
class Canvas {
 public:
  /// `scale` pixels for each unit. width, height > 0.
  static Canvas pixels(int width, int height, const Colour8& paper, int scale = 1);
  /// Drawn on a picture, one unit a pixel, at most kMostCanvasPixels wide and high.
  static Canvas over(const Picture& picture);
  /// Words become outlines, so that a reader needs no font.
  static Canvas svg(int width, int height, const Colour8& paper);
  ~Canvas();
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;

  /// `width` in units; joints and ends are round. Nothing for fewer than two points. `dashes`: six units
  /// drawn, four not.
  void stroke(const std::vector<PlotPoint>& path, const Colour8& colour, double width, bool dashes = false);
  void dot(const PlotPoint& centre, double radius, const Colour8& colour);
  void fill(double x, double y, double width, double height, const Colour8& colour);
  /// `at`: the middle of the height of figures; of their width as `align` says. UTF-8; a byte that is none is
  /// read as Latin-1. A character that DejaVu Sans lacks becomes a box. Throws Error(bad_input) where that
  /// font is not installed.
  void write(const PlotPoint& at, std::string_view words, const Lettering& lettering = {});

  /// Units. Throws as write() does.
  double width_of(std::string_view words, double size = kLetter) const;
  /// The words, or their beginning and "..." where they are wider than `width` units.
  std::string fitting(std::string_view words, double width, double size = kLetter) const;

  /// What pixels() or over() made. The canvas is used up.
  Picture finish_picture();
  /// What svg() made. The canvas is used up.
  std::string finish_svg();

 private:
  struct Surface;
  explicit Canvas(std::unique_ptr<Surface> surface);
  std::unique_ptr<Surface> surface_;
};

}  // namespace phos::inline image
