// What plots are drawn with: vectors or pixels.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/canvas.h"
#include "image/plot/plot.h"

namespace phos::inline image {

inline constexpr Colour8 kPaper{255, 255, 255}, kInk{40, 40, 40};
inline constexpr int kLetter = 14;  ///< height of a line of text, pixels

enum class Align { left, middle, right };

/// What a plot is drawn with: y grows downwards, numbers are pixels.
class Pen {
 public:
  virtual ~Pen() = default;
  virtual void stroke(const std::vector<PlotPoint>& path, const Colour8& colour, double width,
                      bool dashes) = 0;
  virtual void dot(const PlotPoint& centre, double radius, const Colour8& colour) = 0;
  /// `at`: middle of the letters' height. `upwards` turns it by 90 degrees, counter-clockwise.
  virtual void write(const PlotPoint& at, const std::string& words, Align align, bool upwards = false) = 0;
  virtual double width_of(const std::string& words) const = 0;
};

class SvgPen : public Pen {
 public:
  SvgPen(int width, int height);
  void stroke(const std::vector<PlotPoint>& path, const Colour8& colour, double width, bool dashes) override;
  void dot(const PlotPoint& centre, double radius, const Colour8& colour) override;
  void write(const PlotPoint& at, const std::string& words, Align align, bool upwards = false) override;
  /// About: the reader's font is not known.
  double width_of(const std::string& words) const override;
  std::string finish() { return svg_ + "</svg>\n"; }

 private:
  std::string svg_;
};

/// `scale` pixels for each of the plot's.
class PixelPen : public Pen {
 public:
  PixelPen(int width, int height, int scale);
  void stroke(const std::vector<PlotPoint>& path, const Colour8& colour, double width, bool dashes) override;
  void dot(const PlotPoint& centre, double radius, const Colour8& colour) override;
  void write(const PlotPoint& at, const std::string& words, Align align, bool upwards = false) override;
  double width_of(const std::string& words) const override { return text_width(words, 1); }
  Picture finish() { return std::move(picture_); }

 private:
  int to_pixel(double v) const;
  void segment(const PlotPoint& from, const PlotPoint& to, double width, const Colour8& colour);
  void blend(int x, int y, const Colour8& colour, double cover);

  int scale_;
  Picture picture_;
};

}  // namespace phos::inline image
