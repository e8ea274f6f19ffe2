// Weights of bidirectional paths from few numbers a vertex, against all densities written out.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "reference/path_weights.h"

namespace {

using namespace phos;

/// A path from a lamp (vertex 0) to a sensor (the last), with everything that its strategies need.
struct RandomPath {
  std::size_t n;
  std::vector<double> onward,
      back;                       // densities per sr at vertex i, towards i+1 and towards i-1; 1 of mirrors
  std::vector<double> g, g_back;  // of the edge to i+1: at i+1, and at i
  std::vector<bool> mirror, sharp;
  double f0;  // of the lamp's place
  bool hit;   // the lamp can be hit
  double eta, eta_sensor, light_paths;

  double light(std::size_t i) const { return i == 0 ? f0 : onward[i - 1] * g[i - 1]; }
  double eye(std::size_t i) const { return back[i + 1] * g_back[i]; }
  double merge(std::size_t i) const {
    if (i == 0 || mirror[i] || !sharp[i - 1] || i == 1) return 0;
    return i + 1 == n ? eta_sensor : eta;
  }
  bool connects(std::size_t i) const { return !mirror[i - 1] && !mirror[i]; }  // i-1 and i
};

RandomPath random_path(std::mt19937& engine, std::size_t n) {
  std::uniform_real_distribution<double> log(-6, 6), unit(0, 1);
  const auto any = [&] { return std::exp(log(engine)); };
  RandomPath p;
  p.n = n;
  for (std::size_t i = 0; i < n; ++i) {
    const bool inner = i > 0 && i + 1 < n;
    p.mirror.push_back(inner && unit(engine) < 0.4);
    p.sharp.push_back(inner && (p.mirror[i] || unit(engine) < 0.3));
    p.onward.push_back(p.mirror[i] ? 1 : any()), p.back.push_back(p.mirror[i] ? 1 : any());
    p.g.push_back(any()), p.g_back.push_back(any());
  }
  p.f0 = any(), p.hit = unit(engine) < 0.5;
  p.eta = any(), p.eta_sensor = any(), p.light_paths = any();
  return p;
}

/// Ends of the light's sub-path, and of the eye's, at each vertex. The lamp's V_1 is (g'_0 / f_1) / f_0.
std::vector<SubPathEnd> light_ends(const RandomPath& p) {
  std::vector<SubPathEnd> end(p.n);
  end[0].connect = p.hit ? 1 / p.f0 : 0;
  for (std::size_t i = 1; i < p.n; ++i) {
    const double f = p.light(i);
    end[i].connect = p.connects(i) ? 1 / f : 0;
    end[i].merge = p.merge(i);
    end[i].before = end[i - 1].next_before(p.g_back[i - 1] / f, p.back[i - 1], p.mirror[i - 1]);
  }
  return end;
}

/// But for merging at the vertex itself, which only the vertex after it decides.
std::vector<SubPathEnd> eye_ends(const RandomPath& p) {
  std::vector<SubPathEnd> end(p.n);
  for (std::size_t i = p.n - 1; i-- > 0;) {
    const double f = p.eye(i);
    SubPathEnd last = end[i + 1];
    last.merge = p.merge(i + 1);
    end[i].connect = p.connects(i + 1) ? (i + 2 == p.n ? p.light_paths : 1) / f : 0;
    end[i].before = last.next_before(p.g[i] / f, p.onward[i + 1], p.mirror[i + 1]);
  }
  return end;
}

TEST(ReferenceWeights, AreThoseOfAllDensitiesWrittenOut) {
  std::mt19937 engine(1);
  for (int trial = 0; trial < 20000; ++trial) {
    const RandomPath p = random_path(engine, 3 + static_cast<std::size_t>(trial) % 6);
    const auto light = light_ends(p), eye = eye_ends(p);
    // Densities of every strategy, and the weights that the recurrence gives it.
    std::vector<double> density, weight;
    const auto product = [&](std::size_t lights, std::size_t eyes) {
      double d = 1;
      for (std::size_t i = 0; i < lights; ++i) d *= p.light(i);
      for (std::size_t i = eyes; i + 1 < p.n; ++i) d *= p.eye(i);
      return d;
    };
    if (p.hit) {  // the eye's path comes to the lamp
      density.push_back(product(0, 0));
      weight.push_back(balance(p.f0 * (eye[0].connect + p.onward[0] * eye[0].before), 0));
    }
    for (std::size_t s = 1; s < p.n; ++s) {
      if (!p.connects(s)) continue;
      // The sensor has no direction of its own to be entered from: its V is 0.
      const double paths = s + 1 == p.n ? p.light_paths : 1;
      SubPathEnd z = eye[s];
      z.merge = p.merge(s);
      density.push_back(paths * product(s, s));
      weight.push_back(balance(light[s - 1].left_to_the_other(p.eye(s - 1), p.back[s - 1]) / paths,
                               z.left_to_the_other(p.light(s), p.onward[s]) / paths));
    }
    for (std::size_t i = 1; i < p.n; ++i) {
      if (p.merge(i) == 0) continue;
      density.push_back(p.merge(i) * product(i + 1, i));
      weight.push_back(balance(light[i].instead_of_merging(p.merge(i), p.back[i]),
                               eye[i].instead_of_merging(p.merge(i), p.onward[i])));
      if (i + 1 == p.n && p.connects(i))  // connected to the sensor by more than one path
        weight.back() =
            balance((p.light_paths * light[i].connect + p.back[i] * light[i].before) / p.merge(i), 0);
    }
    double all = 0, weights = 0;
    for (const double d : density) all += d;
    for (std::size_t k = 0; k < density.size(); ++k) {
      EXPECT_NEAR(weight[k] / (density[k] / all), 1, 1e-10) << "path " << trial << ", strategy " << k;
      weights += weight[k];
    }
    if (!density.empty()) {
      EXPECT_NEAR(weights, 1, 1e-10) << "path " << trial;
    }
    if (HasFailure()) return;
  }
}

}  // namespace
