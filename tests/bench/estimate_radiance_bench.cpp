// Radiance records: making one of 4,000 rays and what of that is projection, lookups of light that leaves by
// a lobe, on a flat surface and on a curved one, and ways of turning what records of a curved surface say.
#include <benchmark/benchmark.h>

#include "core/parallel.h"
#include "estimate/radiance_gather.h"
#include "hsh/conversion.h"
#include "hsh/rotation.h"
#include "radiance/brdf/projection.h"
#include "radiance/tree.h"
#include "scene/lamp/luminaires.h"
#include "support/gathered.h"
#include "support/one_material.h"
#include "support/radiance_records.h"

namespace phos {
namespace {

constexpr std::int64_t kRays = 4000;

struct Ground {
  Scene scene = test::cornell();
  RayScene rays{scene};
  Luminaires lights{scene};
  RecordOptions options = test::gather_options(scene, Quantity::indirect, 1, kRays);
  std::vector<RecordSite> sites;
  Ground() {
    for (std::uint64_t i = 0; sites.size() < 16; ++i) {
      RandomStream random(1, Stage::test, i);
      SurfacePoint point;
      if (trace(rays, {scene.bounds.centre(), sample_uniform_sphere(random.uniform2())}, point))
        sites.push_back({point.position, point.smooth_normal, i});
    }
  }
};
const Ground& ground() {
  static const Ground one;
  return one;
}

/// Per record, by order.
void record(benchmark::State& state) {
  const Ground& g = ground();
  const RadianceEstimator estimator(g.rays, g.lights, {}, g.options, static_cast<int>(state.range(0)),
                                    RadianceGradient::hybrid, 1);
  const auto worker = estimator.make_worker();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(estimator.make(g.sites[i++ % g.sites.size()], *worker));
}
BENCHMARK(record)->Arg(1)->Arg(5)->Arg(10)->Unit(benchmark::kMillisecond);

/// Of a hemisphere that is already there.
void projection(benchmark::State& state, RadianceGradient mode) {
  const Ground& g = ground();
  const RadianceEstimator estimator(g.rays, g.lights, {}, g.options, 1, RadianceGradient::none, 1);
  const auto worker = estimator.make_worker();
  estimator.make(g.sites[0], *worker);
  RadianceProjector projector(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(projector.project(RadianceEstimator::seen(*worker), mode, 1e-3f));
}
BENCHMARK_CAPTURE(projection, analytic, RadianceGradient::analytic)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projection, hybrid, RadianceGradient::hybrid)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projection, numeric, RadianceGradient::numeric)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projection, none, RadianceGradient::none)->Arg(10)->Unit(benchmark::kMillisecond);

/// 400 records of order 10 over a square metre that is flat, or a cap of a sphere of radius 1 m.
void look_up(benchmark::State& state, bool curved, float exponent) {
  Material m = test::make_material(Model::phong, Rgb(0.1f), Rgb(0.8f));
  m.exponent = exponent;
  Counters counters;
  const BrdfTable table = project_brdf(test::scene_of(m), 0, {}, counters);
  const BrdfLookup brdf(table);
  Bounds bounds;
  bounds.include(Vec3(-0.5f)), bounds.include(Vec3(0.5f));
  RadianceTree tree(bounds, 0.2, 10);
  const auto frame_at = [&](const Vec3& p) {
    return make_frame(curved ? glm::normalize(Vec3(p.x, p.y, 1)) : Vec3(0, 0, 1));
  };
  const auto place = [](RandomStream& random) {
    const Vec2 u = random.uniform2() - 0.5f;
    return Vec3(u, 0);
  };
  for (std::uint64_t i = 0; i < 400; ++i) {
    RandomStream random(1, Stage::test, i);
    const Vec3 p = place(random);
    RadianceRecord r = test::random_radiance(1, 10).records[0];
    r.position = p, r.frame = frame_at(p), r.radius_m = r.distance_m = 0.5f;
    tree.insert(r);
  }
  struct Query {
    Vec3 p;
    Frame frame;
    Vec3 wo;
  };
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RandomStream random(2, Stage::test, i);
    const Vec3 p = place(random);
    queries.push_back({p, frame_at(p), sample_uniform_cone(random.uniform2(), 0.6f)});
  }
  RadianceTree::Worker worker;
  std::vector<float> lobe;
  double records = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    const Query& q = queries[i++ % queries.size()];
    brdf.coefficients(q.wo, lobe);
    benchmark::DoNotOptimize(tree.outgoing(q.p, q.frame, lobe, Rgb(0), worker));
    records += static_cast<double>(worker.found.size());
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["records"] = records / static_cast<double>(state.iterations());
  state.counters["order"] = brdf.order(queries[0].wo);
}
BENCHMARK_CAPTURE(look_up, flat_phong_5, false, 5.f);
BENCHMARK_CAPTURE(look_up, flat_phong_22, false, 22.f);
BENCHMARK_CAPTURE(look_up, curved_phong_5, true, 5.f);
BENCHMARK_CAPTURE(look_up, curved_phong_22, true, 22.f);

BENCHMARK_CAPTURE(look_up, flat_phong_40, false, 40.f);
BENCHMARK_CAPTURE(look_up, curved_phong_40, true, 40.f);

/// What a lookup among kNear records, each tilted by 10 degrees another way, has to turn. Light continues
/// below their horizons.
struct Turning {
  static constexpr int kNear = 5;
  int order;
  HarmonicConversion conversion{order, 2 * order};
  HshRotator rotator{order};
  std::vector<Frame> frame;
  std::vector<std::vector<float>> light, global;  // of each record: HSH in its frame; SH in the world's
  std::vector<float> lobe, truth;  // in the frame of the point: a lobe without colour, the light

  explicit Turning(int n) : order(n) {
    const auto sky = [](const Vec3& w) {
      const float glow = std::max(glm::dot(w, glm::normalize(Vec3(0.5f, 0.3f, 0.4f))), 0.f);
      return Rgb(1 + 4 * glow * glow * glow * glow, 1 - 0.5f * w.x, 1 + 0.5f * w.y * w.z);
    };
    truth = test::projected(sky, make_frame({0, 0, 1}), order);
    for (int k = 0; k < kNear; ++k) {
      const float azimuth = 2 * kPi * static_cast<float>(k) / kNear, tilt = kPi / 18;
      frame.push_back(make_frame(
          {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)}));
      light.push_back(test::projected(sky, frame.back(), order));
      std::vector<float> world(numbers(2 * order));
      ShRotation(2 * order, rotation_angles(frame.back(), Frame())).rotate(filled(light.back()), world, 3);
      global.push_back(world);
    }
    const std::vector<float> rgb = test::projected(
        [](const Vec3& w) { return Rgb(std::pow(std::max(w.z, 0.f), 22.f)); }, make_frame({0, 0, 1}), order);
    for (std::size_t i = 0; i < rgb.size(); i += 3) lobe.push_back(rgb[i]);
  }
  static std::size_t numbers(int of_order) { return 3 * static_cast<std::size_t>(harmonic_count(of_order)); }

  /// SH of light that goes on below the horizon as it is there, so that a constant stays one.
  std::vector<float> filled(const std::vector<float>& hsh) const {
    std::vector<float> sh(numbers(2 * order));
    conversion.hsh_to_sh(hsh, sh, 3);
    for (std::size_t c = 0; c < 3; ++c) {
      double horizon = 0;
      for (int l = 0; l < order; ++l) {
        const double value = std::sqrt((2 * l + 1) / (2 * std::numbers::pi)) *
                             static_cast<double>(hsh[3 * static_cast<std::size_t>(l * l + l) + c]);
        horizon += l % 2 == 0 ? value : -value;
      }
      for (int l = 0; l < 2 * order; ++l) {
        const double upper = std::sqrt(2 * std::numbers::pi) * conversion.at(0, harmonic_index(l, 0));
        const double lower = (l == 0 ? std::sqrt(4 * std::numbers::pi) : 0) - upper;
        sh[3 * static_cast<std::size_t>(l * l + l) + c] += static_cast<float>(horizon * lower);
      }
    }
    return sh;
  }
  double error(const std::vector<float>& found) const {
    double off = 0, all = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      off += std::pow(double(found[i]) - double(truth[i]), 2), all += std::pow(double(truth[i]), 2);
    return std::sqrt(off / all);
  }
};

/// Each record's light turned, RGB.
void turn_each_light(benchmark::State& state) {
  const Turning t(static_cast<int>(state.range(0)));
  std::vector<float> sum(t.truth.size()), turned(sum);
  for (auto _ : state) {
    std::fill(sum.begin(), sum.end(), 0.f);
    for (std::size_t k = 0; k < t.frame.size(); ++k) {
      t.rotator.rotate(rotation_angles(t.frame[k], make_frame({0, 0, 1})), t.light[k], turned, 3);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += turned[i] / Turning::kNear;
    }
    benchmark::DoNotOptimize(sum.data());
  }
  state.counters["error"] = t.error(sum);
}
BENCHMARK(turn_each_light)->Arg(6)->Arg(10);

/// A lobe without colour turned to each record instead, and multiplied by its light.
void turn_lobe_to_each(benchmark::State& state) {
  const Turning t(static_cast<int>(state.range(0)));
  std::vector<float> turned(t.lobe.size());
  for (auto _ : state) {
    Rgb sum(0);
    for (std::size_t k = 0; k < t.frame.size(); ++k) {
      t.rotator.rotate_transposed(rotation_angles(t.frame[k], make_frame({0, 0, 1})), t.lobe, turned, 1);
      for (std::size_t i = 0; i < turned.size(); ++i)
        sum += turned[i] * Rgb(t.light[k][3 * i], t.light[k][3 * i + 1], t.light[k][3 * i + 2]);
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(turn_lobe_to_each)->Arg(6)->Arg(10);

/// SH of twice the order, kept in one frame: summed, turned once, converted.
void turn_global_sum(benchmark::State& state) {
  const Turning t(static_cast<int>(state.range(0)));
  std::vector<float> sum(Turning::numbers(2 * t.order)), turned(sum), out(t.truth.size());
  for (auto _ : state) {
    std::fill(sum.begin(), sum.end(), 0.f);
    for (const std::vector<float>& sh : t.global)
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sh[i] / Turning::kNear;
    ShRotation(2 * t.order, rotation_angles(Frame(), make_frame({0, 0, 1}))).rotate(sum, turned, 3);
    t.conversion.sh_to_hsh(turned, out, 3);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["error"] = t.error(out);
}
BENCHMARK(turn_global_sum)->Arg(6)->Arg(10);

/// The sum alone of it: what it costs if turning were free.
void sum_global(benchmark::State& state) {
  const Turning t(static_cast<int>(state.range(0)));
  std::vector<float> sum(Turning::numbers(2 * t.order));
  for (auto _ : state) {
    std::fill(sum.begin(), sum.end(), 0.f);
    for (const std::vector<float>& sh : t.global)
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sh[i] / Turning::kNear;
    benchmark::DoNotOptimize(sum.data());
  }
}
BENCHMARK(sum_global)->Arg(6)->Arg(10);

}  // namespace
}  // namespace phos
