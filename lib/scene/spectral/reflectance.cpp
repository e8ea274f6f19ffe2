#include "scene/spectral/reflectance.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace phos::inline scene {
namespace {

constexpr int kMaxSteps = 60;
/// Linear Rec.709; a thousandth of a step of an 8-bit texture.
constexpr double kGoodEnough = 1e-6;
/// A determinant below which a step would be beyond numbers.
constexpr double kSingular = 1e-100;

double sigmoid(double x) { return 0.5 + 0.5 * x / std::sqrt(1 + x * x); }
/// Its inverse, for 0 < y < 1.
double inverse_sigmoid(double y) { return (y - 0.5) / std::sqrt(y * (1 - y)); }

bool grey(const Rgb& c) { return c.x == c.y && c.y == c.z; }

}  // namespace

ReflectanceFit::ReflectanceFit(const Bands& bands) {
  for (int b = 0; b < bands.size(); ++b) {
    weight_.push_back(rgb_of_xyz(bands.white_xyz(b)));
    t_.push_back((2.0 * b + 1) / bands.size() - 1);
  }
}

DVec3 ReflectanceFit::rgb_of(const std::vector<double>& reflectance) const {
  DVec3 sum(0);
  for (std::size_t b = 0; b < weight_.size(); ++b) sum += reflectance[b] * weight_[b];
  return sum;
}

/// Colour, and its derivatives by the coefficients.
DVec3 ReflectanceFit::evaluate(const Coefficients& c, glm::dmat3* slopes) const {
  DVec3 sum(0);
  if (slopes) *slopes = glm::dmat3(0);
  for (std::size_t b = 0; b < weight_.size(); ++b) {
    const double t = t_[b], x = c.x + t * (c.y + t * c.z), root = 1 / std::sqrt(1 + x * x);
    sum += (0.5 + 0.5 * x * root) * weight_[b];
    if (!slopes) continue;
    const DVec3 slope = 0.5 * root * root * root * weight_[b];
    (*slopes)[0] += slope, (*slopes)[1] += slope * t, (*slopes)[2] += slope * (t * t);
  }
  return sum;
}

/// Levenberg and Marquardt's steps, from a grey of the same luminance.
std::vector<double> ReflectanceFit::fit(const Rgb& rgb) const {
  const Rgb wanted = glm::clamp(rgb, Rgb(0), Rgb(1));
  std::vector<double> out(weight_.size(), static_cast<double>(wanted.x));
  if (grey(wanted)) return out;
  const DVec3 target(wanted);
  const double y = 0.2126 * target.x + 0.7152 * target.y + 0.0722 * target.z;
  Coefficients c(inverse_sigmoid(std::clamp(y, 1e-4, 1 - 1e-4)), 0, 0);
  glm::dmat3 slopes;
  DVec3 rest = target - evaluate(c, &slopes);
  double error = glm::dot(rest, rest), damping = 1e-3;
  const double enough = kGoodEnough * kGoodEnough * std::max(glm::dot(target, target), 1e-12);
  for (int step = 0; step < kMaxSteps && error > enough && damping < 1e12;) {
    const glm::dmat3 transposed = glm::transpose(slopes);
    glm::dmat3 normal = transposed * slopes;
    for (int i = 0; i < 3; ++i) normal[i][i] += damping * normal[i][i];
    if (!(glm::determinant(normal) > kSingular)) {
      damping *= 8;
      continue;
    }
    const Coefficients tried = c + glm::inverse(normal) * (transposed * rest);
    glm::dmat3 new_slopes;
    const DVec3 new_rest = target - evaluate(tried, &new_slopes);
    const double new_error = glm::dot(new_rest, new_rest);
    if (new_error < error) {
      c = tried, rest = new_rest, slopes = new_slopes, error = new_error, damping *= 0.2;
      ++step;
    } else {
      damping *= 8;
    }
  }
  for (std::size_t b = 0; b < out.size(); ++b) out[b] = sigmoid(c.x + t_[b] * (c.y + t_[b] * c.z));
  return out;
}

BandColours::BandColours(const Bands& bands, int triplet) : bands_(&bands), triplet_(triplet), fit_(bands) {
  DVec3 shares(0);
  for (int c = 0; c < 3; ++c)
    if (const int band = bands.band_of(triplet, c); band >= 0) shares[c] = bands.white_xyz(band).y;
  white_ = Rgb(light_of_shares(shares));
}

Rgb BandColours::reflectance(const Rgb& rgb) const {
  const float largest = max_component(rgb);
  if (!(largest > 0)) return Rgb(0);
  const float scale = std::max(largest, 1.f);
  return scale * Rgb(bands_->triplet_of(fit_.fit(rgb / scale), triplet_));
}

Rgb BandColours::light(const Rgb& rgb) const {
  const float largest = max_component(rgb);
  if (!(largest > 0)) return Rgb(0);
  const Rgb half = 0.5f * (rgb / largest);
  return 2 * largest * white_ * Rgb(bands_->triplet_of(fit_.fit(half), triplet_));
}

BandColourTable::BandColourTable(const BandColours& exact) : exact_(&exact) {
  const std::size_t plane = std::size_t{kSide} * kSide, cube = plane * kSide;
  node_.resize(3 * cube);
  parallel_for(node_.size(), 64, [&](std::size_t i) {
    const auto which = static_cast<int>(i / cube);
    const auto at = [&](std::size_t n) { return static_cast<float>(n % kSide) / (kSide - 1); };
    // The smallest stands for all below: colours that dark have spectra in proportion.
    const float size = at(i / plane), largest = std::max(size * size, 1e-3f);
    Rgb c;
    c[which] = 1, c[(which + 1) % 3] = at(i / kSide), c[(which + 2) % 3] = at(i);
    node_[i] = exact_->reflectance(largest * c) / largest;
  });
}

/// Of a colour with a largest component up to 1, over that.
Rgb BandColourTable::relative(const Rgb& rgb, float largest) const {
  const int which = rgb.x >= largest ? 0 : rgb.y >= largest ? 1 : 2;
  const float side = kSide - 1;
  const float x[3] = {std::sqrt(largest) * side, rgb[(which + 1) % 3] / largest * side,
                      rgb[(which + 2) % 3] / largest * side};
  std::size_t first[3];
  float share[3];
  for (int k = 0; k < 3; ++k) {
    const float below = std::clamp(std::floor(x[k]), 0.f, side - 1);
    first[k] = static_cast<std::size_t>(below), share[k] = std::clamp(x[k] - below, 0.f, 1.f);
  }
  Rgb sum(0);
  for (unsigned corner = 0; corner < 8; ++corner) {
    float weight = 1;
    std::size_t index = static_cast<std::size_t>(which);
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned up = corner >> k & 1;
      weight *= up ? share[k] : 1 - share[k];
      index = index * kSide + first[k] + up;
    }
    sum += weight * node_[index];
  }
  return sum;
}

Rgb BandColourTable::reflectance(const Rgb& rgb) const {
  const Rgb light = glm::max(rgb, Rgb(0));
  const float largest = max_component(light);
  if (!(largest > 0)) return Rgb(0);
  const float scale = std::max(largest, 1.f);
  return largest * relative(light / scale, std::min(largest, 1.f));
}

Rgb BandColourTable::light(const Rgb& rgb) const {
  const Rgb light = glm::max(rgb, Rgb(0));
  const float largest = max_component(light);
  if (!(largest > 0)) return Rgb(0);
  const Rgb half = 0.5f * (light / largest);
  return largest * exact_->white_light() * relative(half, max_component(half));
}

}  // namespace phos::inline scene
