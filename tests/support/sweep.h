// Scenes scaled in length and power, and estimates that must follow the laws of dimension: bit by bit where
// the factors are powers of two, within rounding where they are powers of ten.
#pragma once

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "support/limits.h"
#include "support/scenes.h"

namespace phos::test {

/// Lengths and lumens, relative to the original's.
struct Scale {
  double length = 1, lumens = 1;
  static Scale binades(int size, int power) { return {std::ldexp(1.0, size), std::ldexp(1.0, power)}; }
  static Scale decades(int size, int power) { return {std::pow(10.0, size), std::pow(10.0, power)}; }

  /// length^n lumens^m, exact where the factors are powers of two.
  double of(int n, int m) const { return raised(length, n) * raised(lumens, m); }
  std::string text() const { return phos::text(length, " times the length, ", lumens, " times the lumens"); }

 private:
  static double raised(double base, int n) {
    double product = 1;
    for (int i = 0; i < std::abs(n); ++i) product *= base;
    return n < 0 ? 1 / product : product;
  }
};

/// The scene at another size, its lamps of another flux: candela by the power, luminance and lux of the sun
/// by power over area. What it knows of its light goes with it.
inline AnalyticScene resized(const AnalyticScene& original, Scale by) {
  AnalyticScene s = original;
  const auto length = static_cast<float>(by.of(1, 0)), lumens = static_cast<float>(by.of(0, 1)),
             lux = static_cast<float>(by.of(-2, 1));
  Scene& scene = s.scene;
  for (Vec3& p : scene.position) p *= length;
  for (Instance& i : scene.instance) i.to_world = glm::scale(Mat4(1), Vec3(length)) * i.to_world;
  for (Material& m : scene.material) m.emission *= lux;
  std::erase_if(scene.light, [](const Light& l) { return l.kind == Light::Kind::area; });
  for (Light& light : scene.light) {
    light.position *= length;
    light.intensity *= light.kind == Light::Kind::directional ? lux : lumens;
  }
  for (Fitting& fitting : scene.fitting) fitting.set_colour(lumens * fitting.colour());
  for (Camera& camera : scene.camera) {
    camera.to_world[3] = Vec4(length * Vec3(camera.to_world[3]), 1);
    camera.ymag_m *= length;
  }
  scene.bounds = {};
  finalize(scene);
  if (original.irradiance_lx)
    s.irradiance_lx = [f = original.irradiance_lx, length, by](const Vec3& p, const Vec3& n) {
      return by.of(-2, 1) * f(p / length, n);
    };
  for (Check& check : s.checks) check.position *= length, check.irradiance_lx *= by.of(-2, 1);
  s.area_m2 *= by.of(2, 0), s.mean_irradiance_lx *= by.of(-2, 1);
  return s;
}

/// The same scene elsewhere, as floats have it there.
inline AnalyticScene moved(const AnalyticScene& original, const Vec3& by) {
  AnalyticScene s = original;
  for (Vec3& p : s.scene.position) p += by;
  std::erase_if(s.scene.light, [](const Light& l) { return l.kind == Light::Kind::area; });
  for (Light& light : s.scene.light) light.position += by;
  for (Camera& camera : s.scene.camera) camera.to_world[3] += Vec4(by, 0);
  s.scene.bounds = {};
  finalize(s.scene);
  for (Check& check : s.checks) check.position += by;
  if (original.irradiance_lx)
    s.irradiance_lx = [f = original.irradiance_lx, by](const Vec3& p, const Vec3& n) { return f(p - by, n); };
  return s;
}

/// A number that an estimate gave, and how it goes with length and lumens: lux (-2, 1).
struct Figure {
  double value = 0;
  int length_power = 0, light_power = 0;
  double noise = 0;  ///< its standard error; 0: none is stated
};
struct Figures {
  std::vector<Figure> all;
  void add(double value, int length_power, int light_power, double noise = 0) {
    all.push_back({value, length_power, light_power, noise});
  }
  void lux(const Rgb& v, const Rgb& noise = Rgb(0)) {
    for (int c = 0; c < 3; ++c) add(static_cast<double>(v[c]), -2, 1, static_cast<double>(noise[c]));
  }
  void number(double v) { add(v, 0, 0); }
  void metres(double v) { add(v, 1, 0); }
  void lux_per_metre(const Vec3& v, float noise = 0) {
    for (int c = 0; c < 3; ++c) add(static_cast<double>(v[c]), -3, 1, static_cast<double>(noise));
  }
  /// Of irradiance (this header knows no caches).
  template <class Record>
  void record(const Record& r) {
    lux(r.irradiance, r.stderr_lx), lux(r.stderr_lx, r.stderr_lx);
    metres(static_cast<double>(r.radius_m)), metres(static_cast<double>(r.distance_m));
    const float zone_m = kZone * r.radius_m;
    for (int c = 0; c < 3; ++c) {
      const float noise = r.stderr_lx[c];
      lux(r.rotation_gradient[c], Rgb(noise)), lux_per_metre(r.translation_gradient[c], noise / zone_m);
    }
  }

 private:
  static constexpr float kZone = 0.2f;  // of a record's radius: the zone of the photons of its slope
};
using EstimateOf = std::function<Figures(const AnalyticScene&)>;
using EstimateAt = std::function<Figures(Scale)>;

/// How an estimate of the resized scene stands to the law.
struct Followed {
  double worst = 0;     ///< relative to the largest figure of the kind; infinity: not finite, or others
  int by_noise = 0;     ///< figures that are off by more than rounding, within their noise: not in `worst`
  std::string refusal;  ///< the error that it ended with instead
  std::string first;    ///< the figure that was off the most
  std::string how;      ///< in a word
};
/// Where `rounding` is above 0, figures that are off by more may be so by 4.5 of their standard errors: a
/// photon that lies within rounding of a border falls to its other side.
inline Followed follows(const Figures& original, Scale by, const EstimateAt& estimate, double rounding = 0) {
  Followed f;
  Figures now;
  try {
    now = estimate(by);
  } catch (const Error& e) {
    f.refusal = e.what();
    return f;
  }
  if (now.all.size() != original.all.size()) {
    f.worst = HUGE_VAL;
    f.first = text(now.all.size(), " figures in place of ", original.all.size());
    f.how = "other records";
    return f;
  }
  for (std::size_t i = 0; i < now.all.size(); ++i) {
    const Figure& then = original.all[i];
    const double law = then.value * by.of(then.length_power, then.light_power);
    if (now.all[i].value == law) continue;
    const bool denormal = std::fabs(law) < static_cast<double>(std::numeric_limits<float>::min());
    if (denormal && now.all[i].value == 0) continue;  // as set_flush_to_zero() has it
    double kin = std::fabs(law);
    for (const Figure& k : original.all)
      if (k.length_power == then.length_power && k.light_power == then.light_power && std::isfinite(k.value))
        kin = std::max(kin, std::fabs(k.value) * by.of(k.length_power, k.light_power));
    const double off = std::fabs(now.all[i].value - law) / kin;
    const double noise = then.noise * by.of(then.length_power, then.light_power);
    if (rounding > 0 && off > rounding && off * kin < 4.5 * noise) {
      ++f.by_noise;
      continue;
    }
    if (!(off <= f.worst)) {
      f.first = text("figure ", i, " of m^", then.length_power, " lm^", then.light_power, ": ",
                     now.all[i].value, " in place of ", law);
      const bool counter = then.length_power == 0 && then.light_power == 0 && law == 0;
      const bool finite = std::isfinite(now.all[i].value);
      f.how = counter ? "counted" : !finite ? "not finite" : std::fabs(law) < 1e-30 ? "fades out" : "wrong";
    }
    f.worst = std::max(f.worst, std::isfinite(off) ? off : HUGE_VAL);
  }
  return f;
}

inline std::string law_text(const Followed& f) { return f.refusal.empty() ? f.how : "refused"; }

/// The reach from 0 outwards by steps of `step` binades, as far as the law holds within `tolerance`, at most
/// `most`. `beyond` describes the first step where it fails.
struct Reach {
  int last = 0;
  double worst = 0;
  Followed beyond;  ///< the first step that failed
  bool ended = false;
};
inline Reach reach_of(int step, int most, double tolerance, const std::function<Followed(int)>& at) {
  Reach reach;
  for (int n = step; std::abs(n) <= most; n += step) {
    const Followed f = at(n);
    if (!f.refusal.empty() || !(f.worst <= tolerance)) {
      reach.beyond = f, reach.ended = true;
      return reach;
    }
    reach.last = n, reach.worst = std::max(reach.worst, f.worst);
  }
  return reach;
}

/// How far estimates may be off the law, relative.
struct SweepTolerance {
  double binades = 0;     ///< by powers of two; 0: bit by bit
  double decades = 1e-5;  ///< by powers of ten, or 4.5 of their standard errors
};

/// Sizes of 1e-6 to 1e6, powers of 1e-12 to 1e12 and both at once must follow the law, by powers of two and
/// by powers of ten; how far each goes alone stands in the page.
inline void sweep_scales(const std::string& quantity, const EstimateAt& estimate,
                         SweepTolerance tolerance = {}) {
  const Figures original = estimate({});
  ASSERT_FALSE(original.all.empty());
  const auto expect = [&](const Scale& by, double within, double rounding = 0) {
    const Followed f = follows(original, by, estimate, rounding);
    EXPECT_TRUE(f.refusal.empty()) << quantity << ": " << by.text() << ": " << f.refusal;
    EXPECT_LE(f.worst, within) << quantity << ": " << by.text() << ": " << f.first;
    return f;
  };
  for (const int size : {-20, -13, -7, 7, 13, 20}) expect(Scale::binades(size, 0), tolerance.binades);
  for (const int power : {-40, -27, -13, 13, 27, 40}) expect(Scale::binades(0, power), tolerance.binades);
  for (const int size : {-20, 20})
    for (const int power : {-40, 40}) expect(Scale::binades(size, power), tolerance.binades);

  const auto by_tens = [&](const std::string& along, int most, const std::function<Scale(int)>& scale) {
    double worst = 0;
    int by_noise = 0;
    for (int n = -most; n <= most; ++n) {
      if (n == 0) continue;
      const Followed f = expect(scale(n), tolerance.decades, tolerance.decades);
      worst = std::max(worst, f.worst), by_noise = std::max(by_noise, f.by_noise);
    }
    if (by_noise > 0)
      std::printf("%s, %s: up to %d of %zu figures off within their noise\n", quantity.c_str(), along.c_str(),
                  by_noise, original.all.size());
    // Where a single place may fall on the other side of a border, the page states the demanded error: the
    // number of such places differs between machines.
    if (tolerance.decades > SweepTolerance().decades) worst = tolerance.decades / 1.5;
    expect_limit(
        {quantity, along, std::pow(10, -most), std::pow(10, most), worst, "not tested", by_noise > 0});
  };
  by_tens("length, powers of ten", 6, [](int n) { return Scale::decades(n, 0); });
  by_tens("power, powers of ten", 12, [](int n) { return Scale::decades(0, n); });

  const auto record = [&](const std::string& along, int step, int most,
                          const std::function<Scale(int)>& scale) {
    const auto at = [&](int n) { return follows(original, scale(n), estimate); };
    const Reach down = reach_of(-step, most, tolerance.binades, at),
                up = reach_of(step, most, tolerance.binades, at);
    const auto end = [](const Reach& r, const char* side) {
      return std::string(side) + (r.ended ? law_text(r.beyond) : "not tested");
    };
    for (const Reach* r : {&down, &up})
      if (r->ended)
        std::printf("%s, %s, after 2^%d: %s%s\n", quantity.c_str(), along.c_str(), r->last,
                    r->beyond.refusal.c_str(), r->beyond.first.c_str());
    expect_limit({quantity, along, std::ldexp(1.0, down.last), std::ldexp(1.0, up.last),
                  std::max(down.worst, up.worst), end(down, "below: ") + ", " + end(up, "above: ")});
  };
  record("length, times", 5, 60, [](int n) { return Scale::binades(n, 0); });
  record("power, times", 10, 120, [](int n) { return Scale::binades(0, n); });
}
inline void sweep_scales(const std::string& quantity, const AnalyticScene& scene, const EstimateOf& estimate,
                         SweepTolerance tolerance = {}) {
  sweep_scales(
      quantity, [&](Scale by) { return estimate(resized(scene, by)); }, tolerance);
}

}  // namespace phos::test
