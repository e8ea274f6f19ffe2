// What a measured table reflects as a whole, and the lobes that its samples are drawn from.
#include <algorithm>
#include <array>
#include <limits>

#include "core/error.h"
#include "core/json.h"
#include "core/sampling.h"
#include "scene/material/merl.h"
#include "scene/material/microfacet.h"

namespace phos::inline scene {
namespace {

/// Gloss that moves less than this share of the reflected light is rounding.
constexpr float kLeastGloss = 1e-3f;
/// Albedos up to this may be the quadrature's.
constexpr float kMostAlbedo = 1.005f;

Vec3 direction_at(float cos_theta) {
  return {std::sqrt(std::max(0.f, 1 - cos_theta * cos_theta)), 0, cos_theta};
}

/// i about the normal seen from o; false below the surface.
bool reflect_visible(const Ggx& ggx, const Vec3& o, const Vec2& u, Vec3& i) {
  const Vec3 h = ggx.sample_visible(o, u);
  i = glm::normalize(2 * glm::dot(o, h) * h - o);
  return glm::dot(o, h) > 0 && i.z > 0;
}

float magnitude(const Rgb& c) { return luminance(glm::abs(c)); }

}  // namespace

bool MerlBrdf::sample_gloss(const Vec3& o, const Vec2& u, Vec3& i) const {
  if (u.x < broad_share_) {
    i = sample_cosine_hemisphere({u.x / broad_share_, u.y});
    return i.z > 0;
  }
  const float rest = std::min((u.x - broad_share_) / (1 - broad_share_), kBelowOne);
  return reflect_visible({alpha_, alpha_}, o, {rest, u.y}, i);
}

float MerlBrdf::gloss_density(const Vec3& o, const Vec3& i) const {
  return broad_share_ * i.z / kPi + (1 - broad_share_) * Ggx{alpha_, alpha_}.density(o, i);
}

void MerlBrdf::find_lambert() {
  constexpr int kPairs = 4096;
  for (int c = 0; c < 3; ++c) lambert_[c] = 0;
  std::array<std::vector<float>, 3> values;
  for (int k = 0; k < kPairs; ++k) {
    // The first direction's azimuth does not matter.
    const float cosine = std::sqrt((static_cast<float>(k) + 0.5f) / kPairs);
    const Vec3 i = sample_cosine_hemisphere(r2_point(k, Vec2(0.5f)));
    if (!(i.z > 0)) continue;
    const Rgb f = evaluate(direction_at(cosine), i);
    for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)].push_back(f[c]);
  }
  for (int c = 0; c < 3; ++c) {
    auto& v = values[static_cast<std::size_t>(c)];
    const auto quartile = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 4);
    std::nth_element(v.begin(), quartile, v.end());
    lambert_[c] = kPi * *quartile;
  }
}

/// The roughness and the share for which the mean of (f cos / density)^2 is least, relative to its least
/// value at each of several angles. The points are drawn from all candidates at once, so that the sharpest
/// lobe is seen.
void MerlBrdf::fit_lobe() {
  constexpr int kAlphas = 20, kPoints = 64;
  constexpr float kSharpest = 0.004f;
  constexpr std::array<float, 6> kCosines = {0.98f, 0.85f, 0.65f, 0.45f, 0.25f, 0.1f};
  constexpr std::array<float, 8> kShares = {0.05f, 0.1f, 0.2f, 0.3f, 0.45f, 0.6f, 0.75f, 0.9f};
  std::array<float, kAlphas> alpha;
  for (std::size_t a = 0; a < kAlphas; ++a) {
    alpha[a] = kSharpest * std::pow(1 / kSharpest, static_cast<float>(a) / (kAlphas - 1));
  }
  using Costs = std::array<std::array<double, kShares.size()>, kAlphas>;
  Costs total{};
  for (const float cosine : kCosines) {
    const Vec3 o = direction_at(cosine);
    Costs cost{};
    const auto add = [&](const Vec3& i) {
      std::array<float, kAlphas> d;
      float proposal = i.z / kPi;
      for (std::size_t a = 0; a < kAlphas; ++a) proposal += d[a] = Ggx{alpha[a], alpha[a]}.density(o, i);
      const float f = magnitude(gloss(o, i)) * i.z;
      const double f2 = static_cast<double>(f) * static_cast<double>(f) / static_cast<double>(proposal);
      for (std::size_t a = 0; a < kAlphas; ++a) {
        for (std::size_t s = 0; s < kShares.size(); ++s) {
          cost[a][s] += f2 / static_cast<double>(kShares[s] * i.z / kPi + (1 - kShares[s]) * d[a]);
        }
      }
    };
    for (int k = 0; k < kPoints; ++k) {
      const Vec2 u = r2_point(k, Vec2(0.5f));
      Vec3 i = sample_cosine_hemisphere(u);
      if (i.z > 0) add(i);
      for (const float a : alpha) {
        if (reflect_visible({a, a}, o, u, i)) add(i);
      }
    }
    double least = std::numeric_limits<double>::infinity();
    for (const auto& row : cost) least = std::min(least, *std::min_element(row.begin(), row.end()));
    if (!(least > 0)) continue;
    for (std::size_t a = 0; a < kAlphas; ++a) {
      for (std::size_t s = 0; s < kShares.size(); ++s) total[a][s] += cost[a][s] / least;
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = kAlphas; a-- > 0;) {  // the broader of equals
    for (std::size_t s = 0; s < kShares.size(); ++s) {
      if (!(total[a][s] < least)) continue;
      least = total[a][s], alpha_ = alpha[a], broad_share_ = kShares[s];
    }
  }
}

void MerlBrdf::tabulate_albedo() {
  constexpr int kPoints = 2048;
  float gloss_of_all = 0, all = 0;
  for (int k = 0; k < kAngles; ++k) {
    const Vec3 o = direction_at(angle_cosine(k));
    glm::dvec3 sum(0);
    double taken = 0;
    for (int n = 0; n < kPoints; ++n) {
      Vec3 i;
      if (!sample_gloss(o, r2_point(n, Vec2(0.5f)), i)) continue;
      const Rgb weight = gloss(o, i) * (i.z / gloss_density(o, i));
      sum += glm::dvec3(weight);
      taken += static_cast<double>(magnitude(weight));
    }
    albedo_.push_back(lambert_ + Rgb(sum / double{kPoints}));
    gloss_albedo_.push_back(static_cast<float>(taken / double{kPoints}));
    gloss_of_all += angle_cosine(k) * gloss_albedo_.back();
    all += angle_cosine(k) * luminance(albedo_.back());
  }
  glossy_ = gloss_of_all > kLeastGloss * all;
}

template <class T>
T MerlBrdf::over_cosine(const std::vector<T>& table, float cos_theta) const {
  const float at = std::clamp(cos_theta, 0.f, 1.f) * (kAngles - 1);
  const auto low = static_cast<std::size_t>(std::min(static_cast<int>(at), kAngles - 2));
  const float share = at - static_cast<float>(low);
  return (1 - share) * table[low] + share * table[low + 1];
}

Rgb MerlBrdf::albedo(float cos_theta) const { return over_cosine(albedo_, cos_theta); }

float MerlBrdf::gloss_albedo(float cos_theta) const { return over_cosine(gloss_albedo_, cos_theta); }

Rgb MerlBrdf::mean_albedo() const {
  Rgb sum(0);
  float weight = 0;
  for (int k = 0; k < kAngles; ++k) {  // trapezoids of the cosine-weighted albedo
    const float w = angle_cosine(k) * (k == kAngles - 1 ? 0.5f : 1.f);
    sum += w * albedo_[static_cast<std::size_t>(k)];
    weight += w;
  }
  return sum / weight;
}

float MerlBrdf::largest_albedo() const {
  float largest = 0;
  for (const Rgb& a : albedo_) largest = std::max(largest, max_component(a));
  return largest;
}

std::uint64_t MerlBrdf::gaining_angles() const {
  std::uint64_t n = 0;
  for (const Rgb& a : albedo_) n += max_component(a) > kMostAlbedo;
  return n;
}

std::string MerlBrdf::energy_gain() const {
  if (gaining_angles() == 0) return "";
  const auto worst = std::max_element(albedo_.begin(), albedo_.end(), [](const Rgb& a, const Rgb& b) {
    return max_component(a) < max_component(b);
  });
  const float angle_deg = glm::degrees(std::acos(angle_cosine(static_cast<int>(worst - albedo_.begin()))));
  return text(kGainsEnergy, "it reflects up to ", shortest(max_component(*worst)), " of the light, ",
              shortest(std::round(angle_deg)), " degrees from the normal (", gaining_angles(), " of ",
              kAngles, " angles are above 1)");
}

}  // namespace phos::inline scene
