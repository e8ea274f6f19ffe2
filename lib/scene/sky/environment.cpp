#include "scene/sky/environment.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/sampling.h"
#include "image/image.h"
#include "image/primaries.h"

namespace phos::inline scene {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Over the mean luminance: brighter texels are a peak.
constexpr double kPeak = 4;

/// luminance() in double: the dimmest texel keeps a probability of its own.
double luminous(const DVec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// The whole number below x, within [0, count); 0 for not a number.
int cell_of(double x, int count) { return static_cast<int>(std::fmin(std::fmax(x, 0), count - 1)); }

/// The cell of a cumulative distribution that holds u, and how far u is through it.
template <class T>
std::size_t invert(const T* cdf, std::size_t n, float u, double& fraction) {
  const auto x = static_cast<T>(std::min(u, kBelowOne));
  const auto i = std::min(static_cast<std::size_t>(std::upper_bound(cdf, cdf + n, x) - cdf), n - 1);
  const double below = i > 0 ? static_cast<double>(cdf[i - 1]) : 0;
  fraction = (static_cast<double>(x) - below) / (static_cast<double>(cdf[i]) - below);
  return i;
}

bool valid(const Rgb& c) { return is_finite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0; }

/// A light may have a negative component of Rec.709, but X, Y and Z are never negative.
bool is_colour(const Rgb& c) {
  if (!is_finite(c)) return false;
  const Vec3 xyz = rgb_to_xyz(kRec709) * c, most = glm::abs(c);
  return std::min({xyz.x, xyz.y, xyz.z}) >= -1e-6f * max_component(most);
}

/// Mixed with grey of the same luminance.
Rgb into_gamut(const Rgb& c) {
  const auto grey = static_cast<float>(std::max(luminous(DVec3(c)), 0.0));
  const float least = std::min({c.x, c.y, c.z});
  return glm::max(Rgb(grey) + grey / (grey - least) * (c - grey), Rgb(0));
}

}  // namespace

Environment::Environment(int width, int height, std::vector<Rgb> texels, double rotation_rad,
                         const std::optional<Sun>& sun)
    : width_(width), height_(height), rotation_rad_(rotation_rad), texels_(std::move(texels)), sun_(sun) {
  PHOS_CHECK(width > 0 && height > 0 &&
                 texels_.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
             width, " x ", height, " of ", texels_.size(), " texels");
  PHOS_CHECK(std::all_of(texels_.begin(), texels_.end(), valid), "texels that are no light");
  for (int row = 0; row <= height; ++row) {
    const double sine = std::sin(std::numbers::pi * row / (2.0 * height));
    row_edge_.push_back(sine * sine);
  }
  integrate();
  if (sun_) add_sun();
  by_flux_ = make_table([](double luminance) { return luminance; });
  if (!(cap_ > 0)) return;
  by_both_ = make_table(
      [&](double luminance) { return luminance / luminous_lx_ + std::min(luminance, cap_) / capped_lx_; });
}

double Environment::texel_sr(int row) const {
  const double middle = std::numbers::pi * (row + 0.5) / height_, half = std::numbers::pi / (2.0 * height_);
  return kTurn / width_ * 2 * std::sin(middle) * std::sin(half);
}

/// Sums of the texels, and whether there are peaks among them.
void Environment::integrate() {
  const auto columns = static_cast<std::size_t>(width_);
  const auto sum_of = [&](const auto& value) {
    DVec3 sum(0);
    for (std::size_t row = 0; row < static_cast<std::size_t>(height_); ++row) {
      DVec3 light(0);
      for (std::size_t k = 0; k < columns; ++k) light += value(DVec3(texels_[row * columns + k]));
      sum += light * texel_sr(static_cast<int>(row));
    }
    return sum;
  };
  double brightest = 0;
  integral_lx_ = sum_of([&](const DVec3& texel) {
    brightest = std::max(brightest, luminous(texel));
    return texel;
  });
  luminous_lx_ = luminous(integral_lx_);
  const double cap = kPeak * luminous_lx_ / (2 * kTurn);
  if (!(brightest > cap)) return;
  cap_ = cap;
  capped_lx_ = sum_of([&](const DVec3& texel) { return DVec3(std::min(luminous(texel), cap)); }).x;
}

/// A disc of one luminance L and radius r gives pi L sin^2(r) on a surface that faces it.
void Environment::add_sun() {
  PHOS_CHECK(sun_->radius_rad > 0 && sun_->radius_rad < kTurn / 4 && valid(sun_->illuminance_lx),
             "sun of radius ", sun_->radius_rad);
  const double half = std::sin(sun_->radius_rad / 2), sine = std::sin(sun_->radius_rad);
  sun_chord2_ = 4 * half * half, sun_sr_ = kTurn * 2 * half * half;
  const DVec3 cd_m2 = DVec3(sun_->illuminance_lx) / (kTurn / 2 * sine * sine);
  sun_cd_m2_ = Rgb(cd_m2);
  integral_lx_ += cd_m2 * sun_sr_;
  const double lx = luminous(cd_m2) * sun_sr_;
  if (!(lx > 0)) return;
  sun_share_ = lx / (lx + luminous_lx_);
  sun_chance_ = luminous_lx_ > 0 ? std::min(sun_share_, 0.5) : 1;
}

template <class Weight>
Environment::Table Environment::make_table(const Weight& weight) const {
  const auto columns = static_cast<std::size_t>(width_), rows = static_cast<std::size_t>(height_);
  Table table{std::vector<double>(rows), std::vector<float>(texels_.size())};
  std::vector<double> sums(columns);
  double total = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    double sum = 0;
    for (std::size_t k = 0; k < columns; ++k)
      sums[k] = sum += weight(luminous(DVec3(texels_[row * columns + k])));
    table.row_cdf[row] = total += sum * texel_sr(static_cast<int>(row));
    for (std::size_t k = 0; k < columns && sum > 0; ++k)
      table.column_cdf[row * columns + k] = static_cast<float>(sums[k] / sum);
  }
  if (!(total > 0)) return {};
  for (double& x : table.row_cdf) x /= total;
  return table;
}

std::size_t Environment::texel_at(const Vec3& direction) const {
  const double x = direction.x, y = direction.y, z = direction.z;
  const double theta = std::atan2(std::hypot(x, z), y);
  const double turns = 0.5 - (std::atan2(x, z) - rotation_rad_) / kTurn;
  const int row = cell_of(theta / std::numbers::pi * height_, height_);
  const int column = cell_of((turns - std::floor(turns)) * width_, width_);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
}

float Environment::density_of(std::size_t texel) const {
  if (!(luminous_lx_ > 0)) return 0;
  const double luminance = luminous(DVec3(texels_[texel])), by_flux = luminance / luminous_lx_;
  if (!(cap_ > 0)) return static_cast<float>(by_flux);
  return static_cast<float>(0.5 * by_flux + 0.5 * std::min(luminance, cap_) / capped_lx_);
}

bool Environment::in_sun(const Vec3& direction) const {
  const DVec3 apart = DVec3(direction) - sun_->towards;
  return glm::dot(apart, apart) <= sun_chord2_;
}

/// Uniform over the disc's solid angle.
Vec3 Environment::sample_sun(const Vec2& u) const {
  // sin^2(theta / 2) is even in it.
  const double q = 0.25 * sun_chord2_ * static_cast<double>(u.y), sine = 2 * std::sqrt(q * (1 - q));
  const DVec3 side =
      glm::normalize(std::fabs(sun_->towards.y) < 0.9 ? glm::cross(DVec3(0, 1, 0), sun_->towards)
                                                      : glm::cross(DVec3(1, 0, 0), sun_->towards));
  const DVec3 other = glm::cross(sun_->towards, side);
  const Vec2 around = cos_sin(u.x);
  return Vec3(sine * (static_cast<double>(around.x) * side + static_cast<double>(around.y) * other) +
              (1 - 2 * q) * sun_->towards);
}

float Environment::density(const Vec3& direction) const {
  const float map = density_of(texel_at(direction));
  if (!(sun_chance_ > 0)) return map;
  const double disc = in_sun(direction) ? sun_chance_ / sun_sr_ : 0;
  return static_cast<float>(disc + (1 - sun_chance_) * static_cast<double>(map));
}

Environment::Sample Environment::sample(const Vec2& u) const {
  const Table& table = by_both_.row_cdf.empty() ? by_flux_ : by_both_;
  if (!(sun_chance_ > 0)) return draw(table, u);
  const double chance = sun_chance_, y = static_cast<double>(u.y);
  const bool sun = y < chance;
  const auto rest = static_cast<float>(sun ? y / chance : (y - chance) / (1 - chance));
  Sample sample;
  sample.direction = sun ? sample_sun({u.x, rest}) : draw(table, {u.x, rest}).direction;
  sample.luminance = luminance(sample.direction), sample.density = density(sample.direction);
  return sample;
}

Environment::Sample Environment::sample_flux(const Vec2& u) const {
  const double y = static_cast<double>(u.y);
  Sample sample;
  if (y < sun_share_) {
    sample.direction = sample_sun({u.x, static_cast<float>(y / sun_share_)});
  } else if (sun_share_ > 0) {
    sample.direction =
        draw(by_flux_, {u.x, static_cast<float>((y - sun_share_) / (1 - sun_share_))}).direction;
  } else {
    sample = draw(by_flux_, u);
    if (!(sample.density > 0)) return sample;
    sample.density = static_cast<float>(luminous(DVec3(sample.luminance)) / luminous_lx_);
    return sample;
  }
  sample.luminance = luminance(sample.direction);
  sample.density = static_cast<float>(luminous(DVec3(sample.luminance)) / luminous(integral_lx_));
  return sample;
}

Environment::Sample Environment::draw(const Table& table, const Vec2& u) const {
  Sample sample;
  if (table.row_cdf.empty()) return sample;
  const auto columns = static_cast<std::size_t>(width_);
  double down = 0, along = 0;
  const std::size_t row = invert(table.row_cdf.data(), table.row_cdf.size(), u.y, down);
  const std::size_t column = invert(table.column_cdf.data() + row * columns, columns, u.x, along);
  const std::size_t texel = row * columns + column;
  // Within a texel uniform over the solid angle: sin^2(theta / 2) is even in it, and exact near both poles.
  const double edge = row_edge_[row], q = edge + down * (row_edge_[row + 1] - edge);
  const double turns =
      0.5 - (static_cast<double>(column) + along) / static_cast<double>(width_) + rotation_rad_ / kTurn;
  const Vec2 around = cos_sin(static_cast<float>(turns - std::floor(turns)));
  const auto sine = static_cast<float>(2 * std::sqrt(q * (1 - q)));
  sample.direction = {sine * around.y, static_cast<float>(1 - 2 * q), sine * around.x};
  sample.luminance = texels_[texel];
  sample.density = density_of(texel);
  return sample;
}

double Environment::flux_density(const Vec3& direction) const {
  const double all = luminous(integral_lx_);
  return all > 0 ? luminous(DVec3(luminance(direction))) / all : 0;
}

Vec3 Environment::middle(int column, int row) const {
  const double theta = std::numbers::pi * (row + 0.5) / height_;
  const double phi = kTurn * (0.5 - (column + 0.5) / width_) + rotation_rad_;
  return Vec3(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
}

DVec3 Environment::irradiance_up_lx() const {
  const auto columns = static_cast<std::size_t>(width_);
  DVec3 sum(0);
  for (std::size_t row = 0; row < static_cast<std::size_t>(height_); ++row) {
    DVec3 light(0);
    for (std::size_t k = 0; k < columns; ++k) light += DVec3(texels_[row * columns + k]);
    // The integral of cos(theta) sin(theta) is sin^2(theta) / 2, that is 2 q (1 - q), down to the horizon.
    const auto lifted = [](double q) { return 2 * std::min(q, 0.5) * (1 - std::min(q, 0.5)); };
    sum += light * (kTurn / width_ * (lifted(row_edge_[row + 1]) - lifted(row_edge_[row])));
  }
  return sum;
}

EnvironmentFile read_environment(const std::string& path, double scale, double rotation_rad) {
  const auto fail = [&](const std::string& message) -> Error { return {ExitCode::bad_input, path, message}; };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw fail("is a folder; give an environment map (.hdr or .exr)");
  const Image image = read_image(path);
  if (image.width() != 2 * image.height() || image.pixels() == 0)
    throw fail(text("is ", image.width(), " x ", image.height(),
                    " pixels; an environment map is equirectangular, twice as wide as high: convert it"));
  if (!image.has_layer("")) throw fail("has no channels R, G and B; an environment map needs them");
  std::vector<Rgb> texels = image.rgb("");
  std::size_t outside = 0, bad = 0, first = 0;
  for (std::size_t i = texels.size(); i-- > 0;) {
    if (!is_colour(texels[i])) {
      ++bad, first = i;
      continue;
    }
    if (!valid(texels[i])) texels[i] = into_gamut(texels[i]), ++outside;
    const Rgb scaled(scale * DVec3(texels[i]));
    if (!is_finite(scaled))
      throw fail("has texels that --environment-scale makes infinite; give a smaller factor");
    texels[i] = scaled;
  }
  if (bad > 0) {
    const auto width = static_cast<std::size_t>(image.width());
    const Rgb& c = texels[first];
    throw fail(text(bad, " texels are negative, infinite or not a number, the first in column ",
                    first % width, ", row ", first / width, " (", c.x, " ", c.y, " ", c.z,
                    "); mend the map"));
  }
  return {{image.width(), image.height(), std::move(texels), rotation_rad}, outside};
}

}  // namespace phos::inline scene
