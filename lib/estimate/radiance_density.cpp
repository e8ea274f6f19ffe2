#include "estimate/radiance_density.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "estimate/harmonics/cosine_fit.h"
#include "estimate/harmonics/light_sums.h"
#include "hsh/rotation.h"

namespace phos::inline estimate {
namespace {

/// Least cosine of a source in a gradient, which it divides (as translation_term).
constexpr float kLeastCosine = 0.1f;
/// The variance of a coefficient over the variance of irradiance, so that E = sqrt(pi/2) c_00 + sqrt(pi/6)
/// c_10 has its own; alone, c_00 has the whole variance.
double white(int order) { return (order > 1 ? 1.5 : 2) / std::numbers::pi; }

std::vector<float> narrowed(const std::vector<double>& v) { return {v.begin(), v.end()}; }

double squares(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return sum;
}

}  // namespace

struct PhotonProjector::Impl {
  explicit Impl(int of_order) : order(of_order), sums(of_order), fit(of_order) {}
  int order;
  LightSums sums;
  CosineFit fit;
  std::vector<double> moved;

  /// Light at a step away from where the sums are of.
  void move(const glm::dvec2& step) {
    if (step == glm::dvec2(0)) return;
    moved.resize(sums.light.size());
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i] = step.x * sums.slope[0][i] + step.y * sums.slope[1][i];
    const double most = squares(sums.light), change = squares(moved);
    const double share = change > most ? std::sqrt(most / change) : 1;
    for (std::size_t i = 0; i < moved.size(); ++i) sums.light[i] += share * moved[i];
  }

  /// [order][3], of the variance of irradiance that photons make, and the relative error of the area.
  std::vector<float> errors(const DVec3& variance, double area_error) const {
    std::vector<float> error;
    for (int l = 0; l < order; ++l) {
      DVec3 energy(0);
      for (int m = -l; m <= l; ++m) {
        const double* c = &sums.light[3 * static_cast<std::size_t>(harmonic_index(l, m))];
        energy += DVec3(c[0] * c[0], c[1] * c[1], c[2] * c[2]);
      }
      const DVec3 all = white(order) * variance + area_error * area_error / (2 * l + 1) * energy;
      for (int c = 0; c < 3; ++c) error.push_back(static_cast<float>(std::sqrt(all[c])));
    }
    return error;
  }
};

PhotonProjector::PhotonProjector(int order) : impl_(std::make_unique<Impl>(require_radiance_order(order))) {}
PhotonProjector::~PhotonProjector() = default;

RadianceRecord PhotonProjector::project(const ZonePhotons& photons, std::span<const std::uint8_t> used,
                                        double area_m2, double area_error, const Vec2& step_m,
                                        const Frame& frame, RadianceGradient mode) {
  LightSums& sums = impl_->sums;
  // A step asks for slopes even where the record is to have none.
  const bool sloped = mode != RadianceGradient::none || step_m != Vec2(0);
  sums.start(sloped && mode == RadianceGradient::none ? SlopesBy::terms : slopes_by(mode),
             Falloff::projected);
  DVec3 variance(0);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!used[i]) continue;
    const Vec3 w = frame.to_local(photons.direction[i]), n = frame.to_local(photons.source_normal[i]);
    const Rgb light(DVec3(photons.flux_lm[i]) / area_m2);
    const float cosine = std::max(kLeastCosine, -glm::dot(n, w)), near = photons.inverse_distance[i];
    const Vec2 normal = Vec2(n) / cosine;
    sums.add({w, light, near * light, normal});
    const DVec3 moved =
        DVec3(light) * (1 + static_cast<double>(near * glm::dot(normal + 4.f * Vec2(w), step_m)));
    variance += moved * moved;
  }
  sums.finish();
  for (std::vector<double>* of : {&sums.light, &sums.slope[0], &sums.slope[1]}) impl_->fit.solve(*of);
  impl_->move(step_m);
  RadianceRecord record;
  record.frame = frame;
  record.light = narrowed(sums.light);
  if (mode != RadianceGradient::none)
    record.gradient_x = narrowed(sums.slope[0]), record.gradient_y = narrowed(sums.slope[1]);
  record.stderr_light = impl_->errors(variance, area_error);
  return record;
}

namespace {

struct DensityWorker : Estimator::Worker {
  explicit DensityWorker(int order) : projector(order) {}
  DensityEstimator::Scratch zone;
  PhotonProjector projector;
};

RecordOptions indirect_by_hull(RecordOptions options) {
  options.estimate = Estimate::hull, options.paths = Quantity::indirect;
  return options;
}

}  // namespace

struct RadianceDensityEstimator::Impl {
  DensityEstimator zones;
  int order;
  RadianceGradient gradient;
  DVec3 origin_m;
};

RadianceDensityEstimator::RadianceDensityEstimator(const PhotonMap& photons, const RayScene& rays,
                                                   const RecordOptions& resolved, int order,
                                                   RadianceGradient gradient, std::uint64_t seed)
    : impl_(new Impl{{photons, rays, indirect_by_hull(resolved), seed},
                     require_radiance_order(order),
                     gradient,
                     rays.scene().origin_m}) {}
RadianceDensityEstimator::~RadianceDensityEstimator() = default;

std::unique_ptr<Estimator::Worker> RadianceDensityEstimator::make_worker() const {
  return std::make_unique<DensityWorker>(impl_->order);
}

Made RadianceDensityEstimator::make(const RecordSite& site, Worker& worker) const {
  auto& w = static_cast<DensityWorker&>(worker);
  Made made = impl_->zones.make(site, w.zone);
  w.counters.merge(w.zone.counters);
  w.zone.counters = Counters();
  const IrradianceRecord& e = made.record;
  const ZoneEstimate& zone = w.zone.zone;
  auto& used = w.zone.density.used;
  const bool dark = zone.kind == ZoneKind::dark || e.irradiance == Rgb(0);
  if (dark) std::fill(used.begin(), used.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < w.zone.gathered.zone.size() && !dark; ++i)
    w.zone.gathered.zone.flux_lm[i] *= 1 - w.zone.bend[i];
  // The radius asks for gradients even where the record is to have none.
  const bool without = impl_->gradient == RadianceGradient::none;
  auto record = std::make_shared<RadianceRecord>(
      w.projector.project(w.zone.gathered.zone, used, zone.area_m2, zone.area_error, w.zone.moved_m,
                          w.zone.frame, without ? RadianceGradient::analytic : impl_->gradient));
  // What zones know of their errors besides: paths, and curvature that is left.
  const Rgb found = irradiance_of(*record).stderr_lx;
  for (std::size_t i = 0; i < record->stderr_light.size(); ++i) {
    const int c = static_cast<int>(i % 3);
    if (found[c] > 0) record->stderr_light[i] *= e.stderr_lx[c] / found[c];
  }
  if (dark) {  // known no better than by the light of one photon
    for (std::size_t i = 0; i < record->stderr_light.size(); ++i)
      record->stderr_light[i] =
          static_cast<float>(std::sqrt(white(impl_->order))) * e.stderr_lx[static_cast<int>(i % 3)];
  }
  record->shared = e.shared;
  record->position = e.position, record->distance_m = e.distance_m;
  record->radius_m = std::max(made.least_radius_m, within_gradient_m(*record, e.radius_m));
  if (without) record->gradient_x.clear(), record->gradient_y.clear();
  require_finite(impl_->origin_m, *record);
  made.record = irradiance_of(*record);
  made.radiance = std::move(record);
  return made;
}

}  // namespace phos::inline estimate
