#include "place/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "photon/tree/kd_tree.h"

namespace phos::inline place {
namespace {

constexpr std::size_t kPilots = 32;
constexpr std::uint64_t kSecondItems = std::uint64_t{1} << 44;  // random streams of records made twice
constexpr std::size_t kLooked = 32, kNeighbours = 10;           // nearest ones looked at, and used
constexpr double kNeighbourhood = 3;                            // in reaches
constexpr float kSameFacing = 0.9396926f;                       // cos 20 deg, as zones of photons
constexpr float kFlat = 0.1f;      // neighbours lie within this share of the distance of the tangent plane
constexpr double kTolerance = 3;   // in target errors: a plane misses more than reading does
constexpr std::size_t kPlane = 4;  // neighbours that a plane is fitted to, at least
constexpr double kLeastNoise = 1e-6;
constexpr std::size_t kTask = 64;

struct Neighbour {
  std::size_t record;
  glm::dvec2 offset_m;  // on the tangent plane
};

/// Neighbours of records on their surface.
class Neighbourhoods {
 public:
  Neighbourhoods(std::span<const IrradianceRecord> records, float accuracy)
      : records_(records), accuracy_(accuracy) {
    for (const IrradianceRecord& r : records) positions_.push_back(r.position);
    tree_ = KdTree::build(positions_);
  }

  double reach_m(std::size_t i) const {
    return static_cast<double>(accuracy_) * static_cast<double>(records_[i].radius_m);
  }

  /// At most kNeighbours, nearest first; records at the same place are none.
  std::vector<Neighbour> of(std::size_t i, const Frame& frame) const {
    const IrradianceRecord& own = records_[i];
    std::vector<std::uint32_t> rows;
    std::vector<float> distance2;
    tree_.nearest(own.position, kLooked, rows, distance2, static_cast<float>(kNeighbourhood * reach_m(i)));
    std::vector<Neighbour> found;
    for (const std::uint32_t row : rows) {
      if (found.size() == kNeighbours) break;
      const IrradianceRecord& r = records_[row];
      if (row == i || glm::dot(r.normal, own.normal) < kSameFacing) continue;
      const Vec3 step = frame.to_local(r.position - own.position);
      const float away_m = glm::length(Vec2(step));
      if (!(away_m > 0) || std::fabs(step.z) > kFlat * away_m) continue;
      found.push_back({row, glm::dvec2(step.x, step.y)});
    }
    return found;
  }

 private:
  std::span<const IrradianceRecord> records_;
  float accuracy_;
  std::vector<Vec3> positions_;
  KdTree tree_;
};

double light_of(const IrradianceRecord& r) { return static_cast<double>(luminance(r.irradiance)); }

/// Weights of neighbours by distance: 0 at 1.3 times the distance of the farthest.
std::vector<double> weights_of(std::span<const Neighbour> neighbours) {
  double farthest = 0;
  for (const Neighbour& n : neighbours) farthest = std::max(farthest, glm::length(n.offset_m));
  std::vector<double> weights;
  for (const Neighbour& n : neighbours) {
    const double x = glm::length(n.offset_m) / (1.3 * farthest);
    weights.push_back((1 - x * x) * (1 - x * x));
  }
  return weights;
}

/// The coefficients by which values at the neighbours make up the value of the weighted plane of least
/// squares at the middle. Nothing where they lie on a line, or are too few.
std::optional<std::vector<double>> plane_through(std::span<const Neighbour> neighbours) {
  if (neighbours.size() < kPlane) return std::nullopt;
  const std::vector<double> weights = weights_of(neighbours);
  const double unit = glm::length(neighbours.back().offset_m);
  glm::dmat3 normal(0);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const DVec3 row(1, neighbours[k].offset_m / unit);
    normal += weights[k] * glm::outerProduct(row, row);
  }
  const double determinant = glm::determinant(normal);
  const double size = normal[0][0] * normal[0][0] * normal[0][0];
  if (!(determinant > 1e-4 * size)) return std::nullopt;
  const DVec3 first = glm::inverse(normal)[0];
  std::vector<double> coefficients;
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    coefficients.push_back(weights[k] * glm::dot(first, DVec3(1, neighbours[k].offset_m / unit)));
  return coefficients;
}

/// How wrongly a record's neighbours foretell it.
struct Residual {
  double excess = 0;  ///< square, lx2, less its expectation by noise alone
  bool known = false;
  std::vector<std::size_t> neighbours{};
};

Residual residual_of(std::span<const IrradianceRecord> records, const Neighbourhoods& about,
                     const RecordNoise& noise, std::size_t i) {
  const IrradianceRecord& own = records[i];
  const std::vector<Neighbour> neighbours = about.of(i, make_frame(own.normal));
  Residual residual;
  if (neighbours.empty()) return residual;
  for (const Neighbour& n : neighbours) residual.neighbours.push_back(n.record);
  const auto count = static_cast<double>(neighbours.size());
  const auto variance_of = [&](const IrradianceRecord& r) { return noise.error_lx(r) * noise.error_lx(r); };
  double foretold = 0, variance = variance_of(own);
  if (const auto plane = plane_through(neighbours)) {
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const double l = (*plane)[k];
      const IrradianceRecord& r = records[neighbours[k].record];
      foretold += l * light_of(r), variance += l * l * variance_of(r);
    }
  } else {  // few or in a row: each by its own gradient
    for (const Neighbour& n : neighbours) {
      const IrradianceRecord& r = records[n.record];
      foretold += static_cast<double>(luminance(extrapolate(r, own.position, own.normal))) / count;
      const double turn = noise.gradient * glm::length(n.offset_m) /
                          std::max(static_cast<double>(r.distance_m), 1e-30) /
                          std::max(noise.irradiance, kLeastNoise);
      variance += (1 + turn * turn) * variance_of(r) / (count * count);
    }
  }
  const double wrong = foretold - light_of(own);
  residual.excess = wrong * wrong - variance;
  residual.known = true;
  return residual;
}

}  // namespace

double RecordNoise::error_lx(const IrradianceRecord& record) const {
  return stated > 0 ? stated * static_cast<double>(luminance(record.stderr_lx))
                    : irradiance * light_of(record);
}

RecordNoise noise_of(std::span<const Made> first, std::span<const Made> second) {
  PHOS_CHECK(first.size() == second.size(), first.size(), " and ", second.size());
  double variance = 0, light = 0, stated = 0, gradient = 0, count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const IrradianceRecord &a = first[i].record, &b = second[i].record;
    const double difference = light_of(a) - light_of(b), mean = (light_of(a) + light_of(b)) / 2;
    const double error_a = static_cast<double>(luminance(a.stderr_lx)),
                 error_b = static_cast<double>(luminance(b.stderr_lx));
    variance += difference * difference / 2, light += mean * mean;
    stated += (error_a * error_a + error_b * error_b) / 2;
    const double distance_m = static_cast<double>(a.distance_m);
    if (!(mean > 0) || !std::isfinite(distance_m)) continue;
    for (int c = 0; c < 3; ++c) {
      if (!(a.irradiance[c] > 0)) continue;
      const DVec3 g(a.translation_gradient[c] - b.translation_gradient[c]);
      const double relative = distance_m / static_cast<double>(a.irradiance[c]);
      gradient += glm::dot(g, g) * relative * relative / 4, count += 1;  // two components, a pair of records
    }
  }
  return {light > 0 ? std::sqrt(variance / light) : 0, count > 0 ? std::sqrt(gradient / count) : 0,
          stated > 0 ? std::sqrt(variance / stated) : 0};
}

Refinement::Refinement(Growth& growth, ParallelMaker& maker, const RecordOptions& resolved, double target)
    : growth_(growth), maker_(maker), accuracy_(static_cast<float>(resolved.accuracy)), target_(target) {
  PHOS_CHECK(target > 0, "target ", target);
}

void Refinement::measure_noise() {
  measured_ = true;
  const std::span<const Made> all = growth_.rules().made();
  const std::vector<Made> first(all.begin(),
                                all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), kPilots)));
  std::vector<RecordSite> sites;
  for (const Made& made : first)
    sites.push_back({made.record.position, made.record.normal, kSecondItems + made.item});
  noise_ = noise_of(first, maker_.make(sites));
}

std::size_t Refinement::refine() {
  if (!measured_) measure_noise();
  const std::span<const IrradianceRecord> records = growth_.tree().records();
  const Neighbourhoods about(records, accuracy_);
  std::vector<Residual> residuals(records.size());
  parallel_for(records.size(), kTask,
               [&](std::size_t i) { residuals[i] = residual_of(records, about, noise_, i); });
  double light = 0, area = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double reach2 = about.reach_m(i) * about.reach_m(i);
    light += reach2 * light_of(records[i]), area += reach2;
  }
  const double aim_lx = kTolerance * target_ * (area > 0 ? light / area : 0);
  std::vector<float> radius_m(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    radius_m[i] = records[i].radius_m;
    if (i < growth_.kept() || !residuals[i].known) continue;
    double sum = residuals[i].excess, weight = 1;
    for (const std::size_t j : residuals[i].neighbours) {
      if (!residuals[j].known) continue;
      const double ratio = about.reach_m(i) / about.reach_m(j);
      sum += residuals[j].excess * std::min(4.0, std::pow(ratio, 4)) / 2, weight += 0.5;
    }
    const double error_lx = std::sqrt(std::max(0.0, sum / weight));
    const double tolerance_lx = std::max(aim_lx, noise_.error_lx(records[i]));
    if (error_lx > tolerance_lx)
      radius_m[i] *= static_cast<float>(std::max(0.5, std::sqrt(tolerance_lx / error_lx)));
  }
  std::size_t shrunk = 0;
  for (std::size_t i = growth_.kept(); i < radius_m.size(); ++i)
    if (radius_m[i] < records[i].radius_m) shrunk += growth_.lower(i, radius_m[i]) ? 1 : 0;
  return shrunk;
}

void Refinement::fit_gradients(std::vector<IrradianceRecord>& records, std::size_t first_new) const {
  const Neighbourhoods about(records, accuracy_);
  const double noise = std::max(noise_.irradiance, kLeastNoise),
               slope_noise = std::max(noise_.gradient, kLeastNoise);
  std::vector<std::array<Vec3, 3>> fitted(records.size());
  parallel_for(records.size() - first_new, kTask, [&](std::size_t k) {
    const std::size_t i = first_new + k;
    const IrradianceRecord& own = records[i];
    std::copy(own.translation_gradient, own.translation_gradient + 3, fitted[i].begin());
    const Frame frame = make_frame(own.normal);
    const std::vector<Neighbour> neighbours = about.of(i, frame);
    if (neighbours.empty() || !std::isfinite(own.distance_m)) return;
    const std::vector<double> weights = weights_of(neighbours);
    for (int c = 0; c < 3; ++c) {
      const double light = static_cast<double>(own.irradiance[c]);
      if (!(light > 0)) continue;
      const double sd = noise * light, slope_sd = slope_noise * light / static_cast<double>(own.distance_m);
      const Vec3 local = frame.to_local(own.translation_gradient[c]);
      glm::dmat2 a(1 / (slope_sd * slope_sd));
      glm::dvec2 b = glm::dvec2(local.x, local.y) / (slope_sd * slope_sd);
      for (std::size_t n = 0; n < neighbours.size(); ++n) {
        const glm::dvec2& d = neighbours[n].offset_m;
        const double w = weights[n] / (2 * sd * sd);
        a += w * glm::outerProduct(d, d);
        b += w * (static_cast<double>(records[neighbours[n].record].irradiance[c]) - light) * d;
      }
      const double determinant = glm::determinant(a);
      if (!(determinant > 0) || !std::isfinite(determinant)) continue;
      const glm::dvec2 g = glm::inverse(a) * b;
      if (std::isfinite(g.x) && std::isfinite(g.y))
        fitted[i][static_cast<std::size_t>(c)] = frame.to_world(Vec3(g, 0));
    }
  });
  for (std::size_t i = first_new; i < records.size(); ++i)
    std::copy(fitted[i].begin(), fitted[i].end(), records[i].translation_gradient);
}

}  // namespace phos::inline place
