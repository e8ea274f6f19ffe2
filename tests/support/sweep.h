// Scenes scaled in length and power, and estimates that must follow the laws of dimension, bit by bit where
// the factors are powers of two.
#pragma once

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "support/limits.h"
#include "support/scenes.h"

namespace phos::test {

/// 2^n lengths and 2^m lumens of the original.
struct Scale {
  int size = 0, power = 0;
  double of(int length_power, int light_power) const {
    return std::ldexp(1.0, size * length_power + power * light_power);
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
};
struct Figures {
  std::vector<Figure> all;
  void add(double value, int length_power, int light_power) {
    all.push_back({value, length_power, light_power});
  }
  void lux(const Rgb& v) {
    for (int c = 0; c < 3; ++c) add(static_cast<double>(v[c]), -2, 1);
  }
  void number(double v) { add(v, 0, 0); }
  void metres(double v) { add(v, 1, 0); }
  void lux_per_metre(const Vec3& v) {
    for (int c = 0; c < 3; ++c) add(static_cast<double>(v[c]), -3, 1);
  }
};
using EstimateOf = std::function<Figures(const AnalyticScene&)>;

/// How an estimate of the resized scene stands to the law.
struct Followed {
  double worst = 0;     ///< relative to the largest figure of the kind; infinity: not finite, or others
  std::string refusal;  ///< the error that it ended with instead
  std::string first;    ///< the figure that was off the most
  std::string how;      ///< in a word
};
inline Followed follows(const Figures& original, const AnalyticScene& scene, Scale by,
                        const EstimateOf& estimate) {
  Followed f;
  Figures now;
  try {
    now = estimate(resized(scene, by));
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
    double kin = std::fabs(law);
    for (const Figure& k : original.all)
      if (k.length_power == then.length_power && k.light_power == then.light_power && std::isfinite(k.value))
        kin = std::max(kin, std::fabs(k.value) * by.of(k.length_power, k.light_power));
    const double off = std::fabs(now.all[i].value - law) / kin;
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

/// From 0 outwards by steps of `step` binades, as far as the law holds within `tolerance`, at most `most`;
/// what is met there is told in `beyond`.
struct Reach {
  int last = 0;
  double worst = 0;
  Followed beyond;  ///< of the first that failed
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

/// Sizes of 1e-6 to 1e6, powers of 1e-12 to 1e12 and both at once must follow the law within `tolerance` (0:
/// bit by bit); how far each goes alone stands in the page.
inline void sweep_scales(const std::string& quantity, const AnalyticScene& scene, const EstimateOf& estimate,
                         double tolerance = 0) {
  const Figures original = estimate(resized(scene, {0, 0}));
  ASSERT_FALSE(original.all.empty());
  std::vector<Scale> demanded;
  for (const int size : {-20, -13, -7, 7, 13, 20}) demanded.push_back({size, 0});
  for (const int power : {-40, -27, -13, 13, 27, 40}) demanded.push_back({0, power});
  for (const int size : {-20, 20})
    for (const int power : {-40, 40}) demanded.push_back({size, power});
  for (const Scale& by : demanded) {
    const Followed f = follows(original, scene, by, estimate);
    EXPECT_TRUE(f.refusal.empty()) << quantity << ": 2^" << by.size << " m, 2^" << by.power
                                   << " lm: " << f.refusal;
    EXPECT_LE(f.worst, tolerance) << quantity << ": 2^" << by.size << " m, 2^" << by.power
                                  << " lm: " << f.first;
  }
  const auto record = [&](const std::string& along, int step, int most,
                          const std::function<Scale(int)>& scale) {
    const auto at = [&](int n) { return follows(original, scene, scale(n), estimate); };
    const Reach down = reach_of(-step, most, tolerance, at), up = reach_of(step, most, tolerance, at);
    const auto end = [](const Reach& r, const char* side) {
      return std::string(side) + (r.ended ? law_text(r.beyond) : "not looked for");
    };
    for (const Reach* r : {&down, &up})
      if (r->ended)
        std::printf("%s, %s, after 2^%d: %s%s\n", quantity.c_str(), along.c_str(), r->last,
                    r->beyond.refusal.c_str(), r->beyond.first.c_str());
    expect_limit({quantity, along, std::ldexp(1.0, down.last), std::ldexp(1.0, up.last),
                  std::max(down.worst, up.worst), end(down, "below: ") + ", " + end(up, "above: ")});
  };
  record("length, times", 5, 60, [](int n) { return Scale{n, 0}; });
  record("power, times", 10, 120, [](int n) { return Scale{0, n}; });
}

}  // namespace phos::test
