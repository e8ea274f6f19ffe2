#include "radiance/brdf/table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/options.h"
#include "hsh/basis.h"
#include "hsh/limits.h"
#include "radiance/lobe_dot.h"

namespace phos::inline radiance {

namespace {

/// The paraboloid's point (x/(1+z), y/(1+z)) back to the direction, kept above the horizon.
Vec3 from_paraboloid(const Vec2& p) {
  constexpr float kLeast = BrdfTable::kLeastCosine;
  const float r2 = glm::dot(p, p), z = (1 - r2) / (1 + r2);
  if (z >= kLeast) return {2 * p.x / (1 + r2), 2 * p.y / (1 + r2), z};
  const Vec2 across = std::sqrt(1 - kLeast * kLeast) / std::sqrt(r2) * p;
  return {across.x, across.y, kLeast};
}

Vec2 to_paraboloid(const Vec3& w) { return Vec2(w.x, w.y) / (1 + std::max(w.z, 0.f)); }

/// Centre of a texel of the grid, in [-1, 1]^2.
Vec2 texel_centre(std::size_t entry, int resolution) {
  const auto side = static_cast<std::size_t>(resolution);
  const float width = 2 / static_cast<float>(resolution);
  return {width * (static_cast<float>(entry % side) + 0.5f) - 1,
          width * (static_cast<float>(entry / side) + 0.5f) - 1};
}

std::size_t coefficients_per_entry(const BrdfTable& table) {
  return 3 * static_cast<std::size_t>(harmonic_count(table.order));
}

/// Two neighbours of x on a line of n nodes, and the share of the second.
struct Interval {
  std::size_t first;
  float fraction;
};
Interval interval(float x, int n) {
  const float clamped = x > 0 ? std::min(x, static_cast<float>(n - 1)) : 0.f;
  const int i = std::min(static_cast<int>(clamped), n - 2);
  return {static_cast<std::size_t>(i), clamped - static_cast<float>(i)};
}

int order_of(std::size_t numbers) {
  return static_cast<int>(std::sqrt(static_cast<float>(numbers / 3)) + 0.5f);
}

}  // namespace

void declare_options(Options& options, BrdfTableOptions& brdf) {
  options.section("Projection");
  options.number("error", brdf.error, "SHARE",
                 "share of a lobe's energy, the integral of (f cos)^2, that the harmonics may leave out; "
                 "each direction takes the lowest order that meets it. A share of 0.05 is 0.22 of the lobe's "
                 "rms value, 0.01 is 0.1; 0: nothing is left out",
                 {0, 1});
  options.integer("max-order", brdf.max_order, "N",
                  "highest order of the harmonics; directions that need more follow --too-sharp",
                  {1, kMostOrder.as<double>()});
  options.choice<TooSharp>("too-sharp", brdf.too_sharp, {{"trace", TooSharp::trace}, {"cut", TooSharp::cut}},
                           "directions that need a higher order: trace: marked to be traced; cut: cut off at "
                           "the highest order, which blurs their reflections");
  options.integer("resolution", brdf.resolution, "N",
                  "number of directions of view: N x N on the parabolic map, or N angles where the material "
                  "is isotropic; interpolation errs by 1/N^2",
                  {2, 1024});
}

Vec3 BrdfTable::direction(std::size_t entry) const {
  if (!isotropic) return from_paraboloid(texel_centre(entry, resolution));
  return from_paraboloid({static_cast<float>(entry) / static_cast<float>(resolution - 1), 0});
}

bool BrdfTable::inside(std::size_t entry) const {
  if (isotropic) return true;
  const Vec2 p = texel_centre(entry, resolution);
  return glm::dot(p, p) < 1;
}

bool BrdfTable::used(std::size_t entry) const {
  if (isotropic) return true;
  // Some point of the disc lies within a texel's width.
  const Vec2 nearest =
      glm::max(glm::abs(texel_centre(entry, resolution)) - 2 / static_cast<float>(resolution), Vec2(0));
  return glm::dot(nearest, nearest) < 1;
}

BrdfSummary summarize(const BrdfTable& table) {
  BrdfSummary s;
  std::size_t all = 0, kept = 0;
  for (std::size_t e = 0; e < table.entries(); ++e) {
    if (!table.inside(e)) continue;
    ++all;
    const int order = table.orders[e];
    if (order == 0) continue;
    s.least_order = kept == 0 ? order : std::min(s.least_order, order);
    s.greatest_order = std::max(s.greatest_order, order);
    ++kept;
    s.mean_order += order;
    s.mean_error += static_cast<double>(table.error[e]);
    s.worst_error = std::max(s.worst_error, static_cast<double>(table.error[e]));
  }
  if (kept > 0) s.mean_order /= static_cast<double>(kept), s.mean_error /= static_cast<double>(kept);
  s.traced_share = all > 0 ? static_cast<double>(all - kept) / static_cast<double>(all) : 0;
  const auto order = static_cast<std::uint64_t>(table.order);
  const std::uint64_t columns = table.isotropic ? order * (order + 1) / 2 : order * order;
  s.bytes = table.entries() * (3 * columns * sizeof(float) + sizeof(float) + 1);
  return s;
}

/// The entries between which wo lies, and their shares.
struct BrdfLookup::Around {
  std::array<std::size_t, 4> entry;
  std::array<float, 4> share;
  std::size_t count;
};

BrdfLookup::Around BrdfLookup::around(const Vec3& wo) const {
  const Vec2 p = to_paraboloid(wo);
  const int n = table_.resolution;
  if (table_.isotropic) {
    const Interval r = interval(glm::length(p) * static_cast<float>(n - 1), n);
    return {{r.first, r.first + 1}, {1 - r.fraction, r.fraction}, 2};
  }
  const float half = 0.5f * static_cast<float>(n);
  const Interval u = interval((p.x + 1) * half - 0.5f, n), v = interval((p.y + 1) * half - 0.5f, n);
  const std::size_t side = static_cast<std::size_t>(n), first = v.first * side + u.first;
  return {{first, first + 1, first + side, first + side + 1},
          {(1 - u.fraction) * (1 - v.fraction), u.fraction * (1 - v.fraction), (1 - u.fraction) * v.fraction,
           u.fraction * v.fraction},
          4};
}

int BrdfLookup::order(const Around& a) const {
  int most = 0;
  for (std::size_t k = 0; k < a.count; ++k) {
    if (!(a.share[k] > 0)) continue;
    const int order = table_.orders[a.entry[k]];
    if (order == 0) return 0;
    most = std::max(most, order);
  }
  return most;
}

int BrdfLookup::order(const Vec3& wo) const { return order(around(wo)); }

Rgb BrdfLookup::outgoing(const Vec3& wo, std::span<const float> incident) const {
  const Around a = around(wo);
  const int light_order = order_of(incident.size());
  const std::size_t stride = coefficients_per_entry(table_);
  if (!table_.isotropic) {
    Rgb out(0);
    for (std::size_t k = 0; k < a.count; ++k) {
      const int order = std::min<int>(table_.orders[a.entry[k]], light_order);
      const auto numbers = 3 * static_cast<std::size_t>(harmonic_count(order));
      out +=
          a.share[k] * lobe_dot(table_.coefficients.data() + a.entry[k] * stride, incident.data(), numbers);
    }
    return out;
  }
  // Turned by the azimuth a of wo, c_{l,m} cos(m phi) becomes c_{l,m} (cos(ma) cos(m phi) + sin(ma) sin(m
  // phi)).
  const std::size_t e0 = a.entry[0], e1 = a.entry[1];
  const int order = std::min<int>(std::max(table_.orders[e0], table_.orders[e1]), light_order);
  const float *c0 = table_.coefficients.data() + e0 * stride, *c1 = table_.coefficients.data() + e1 * stride;
  const auto mixed = [&](int index, int channel) {
    const auto i = 3 * static_cast<std::size_t>(index) + static_cast<std::size_t>(channel);
    return a.share[0] * c0[i] + a.share[1] * c1[i];
  };
  const auto light = [&](int index, int channel) {
    return incident[3 * static_cast<std::size_t>(index) + static_cast<std::size_t>(channel)];
  };
  const float across = std::sqrt(wo.x * wo.x + wo.y * wo.y);
  const Vec2 turn = across > 0 ? Vec2(wo.x, wo.y) / across : Vec2(1, 0);
  Rgb out(0);
  Vec2 angle(1, 0);  // cos(ma), sin(ma)
  for (int m = 0; m < order; ++m) {
    for (int l = m; l < order; ++l) {
      const int cosine = harmonic_index(l, m), sine = harmonic_index(l, -m);
      for (int c = 0; c < 3; ++c)
        out[c] += mixed(cosine, c) * (angle.x * light(cosine, c) + (m > 0 ? angle.y * light(sine, c) : 0.f));
    }
    angle = {angle.x * turn.x - angle.y * turn.y, angle.x * turn.y + angle.y * turn.x};
  }
  return out;
}

/// c_i(wo) below `order`.
void BrdfLookup::blend(const Around& a, const Vec3& wo, int order, std::vector<float>& out) const {
  const std::size_t stride = coefficients_per_entry(table_);
  out.assign(3 * static_cast<std::size_t>(harmonic_count(order)), 0);
  for (std::size_t k = 0; k < a.count; ++k) {
    const float* entry = table_.coefficients.data() + a.entry[k] * stride;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += a.share[k] * entry[i];
  }
  if (!table_.isotropic) return;
  const float across = std::sqrt(wo.x * wo.x + wo.y * wo.y);
  const Vec2 turn = across > 0 ? Vec2(wo.x, wo.y) / across : Vec2(1, 0);
  Vec2 angle = turn;
  for (int m = 1; m < order; ++m) {
    for (int l = m; l < order; ++l) {
      for (std::size_t c = 0; c < 3; ++c) {
        float& cosine = out[3 * static_cast<std::size_t>(harmonic_index(l, m)) + c];
        out[3 * static_cast<std::size_t>(harmonic_index(l, -m)) + c] = angle.y * cosine;
        cosine *= angle.x;
      }
    }
    angle = {angle.x * turn.x - angle.y * turn.y, angle.x * turn.y + angle.y * turn.x};
  }
}

std::vector<float> BrdfLookup::coefficients(const Vec3& wo) const {
  std::vector<float> out;
  blend(around(wo), wo, table_.order, out);
  return out;
}

int BrdfLookup::coefficients(const Vec3& wo, std::vector<float>& out) const {
  const Around a = around(wo);
  const int n = order(a);
  blend(a, wo, n, out);
  return n;
}

}  // namespace phos::inline radiance
