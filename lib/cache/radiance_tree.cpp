// Interpolation between radiance records.
#include <algorithm>
#include <cmath>

#include "cache/radiance_cache.h"
#include "core/error.h"
#include "hsh/rotation.h"

namespace phos {
namespace {

std::size_t numbers(int order) { return 3 * static_cast<std::size_t>(harmonic_count(order)); }

double squares(const std::vector<float>& v) {
  double sum = 0;
  for (const float x : v) sum += static_cast<double>(x) * static_cast<double>(x);
  return sum;
}

/// Change of a record's coefficients per metre relative to their own size, 1/m.
float steepness(const RadianceRecord& r) {
  const double light = squares(r.light), slope = squares(r.gradient_x) + squares(r.gradient_y);
  if (!(slope > 0)) return 0;
  return light > 0 ? static_cast<float>(std::sqrt(slope / light)) : kInfinity;
}

/// The angle between normals at which no weight is left, |n - n_i| / sqrt(2) = a, and a little more.
float most_turned(double accuracy) {
  const double angle = 2 * std::asin(std::min(1., accuracy / std::numbers::sqrt2)) + 0.01;
  return static_cast<float>(std::min(angle, std::numbers::pi / 2));
}

bool same(const Frame& a, const Frame& b) { return a.x == b.x && a.z == b.z; }

}  // namespace

struct RadianceTree::Impl {
  Impl(const Bounds& bounds, double a, int of_order, const RayScene* leak_test)
      : tree(bounds, a, leak_test), accuracy(static_cast<float>(a)), order(of_order) {
    for (int n = 1; n <= order; ++n) rotators.emplace_back(n, HshRotation::constant_fill, most_turned(a));
  }
  RecordTree tree;  ///< record i stands for records[i]
  float accuracy;
  int order;
  std::vector<HshRotator> rotators;  ///< of orders 1, 2, ...
  std::vector<RadianceRecord> records;
  std::vector<float> steepness_per_m;

  /// sum += w (c + dx g_x + dy g_y), as far as `sum` goes.
  void add(std::size_t record, float w, const Vec3& p, std::vector<float>& sum) const {
    const RadianceRecord& r = records[record];
    const Vec3 step = p - r.position;
    const float steep = steepness_per_m[record];
    if (!(steep > 0) || std::isinf(steep)) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * r.light[i];
      return;
    }
    const float shorter = w * std::min(1.f, 1 / (steep * glm::length(step)));
    const float x = shorter * glm::dot(step, r.frame.x), y = shorter * glm::dot(step, r.frame.y);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += w * r.light[i] + (x * r.gradient_x[i] + y * r.gradient_y[i]);
  }
};

RadianceTree::RadianceTree(const Bounds& bounds, double accuracy, int order, const RayScene* leak_test) {
  if (order < 1 || order > HshRotator::kMaxOrder) {
    throw Error(ExitCode::usage, "",
                text("order ", order, ": radiance records are of order 1 .. ", HshRotator::kMaxOrder));
  }
  impl_ = std::make_unique<Impl>(bounds, accuracy, order, leak_test);
}
RadianceTree::~RadianceTree() = default;
RadianceTree::RadianceTree(RadianceTree&&) noexcept = default;

int RadianceTree::order() const { return impl_->order; }
std::size_t RadianceTree::size() const { return impl_->records.size(); }
const RadianceRecord& RadianceTree::operator[](std::size_t record) const { return impl_->records[record]; }
const RecordTree& RadianceTree::irradiance() const { return impl_->tree; }

void RadianceTree::insert(RadianceRecord r) {
  PHOS_CHECK(r.order() == impl_->order && r.light.size() == numbers(r.order()), "order ", r.order(),
             " among records of order ", impl_->order);
  PHOS_CHECK(r.gradient_x.size() == r.gradient_y.size() &&
                 (r.gradient_x.empty() || r.gradient_x.size() == r.light.size()),
             r.gradient_x.size(), " and ", r.gradient_y.size(), " numbers of gradients");
  impl_->tree.insert(phos::irradiance_of(r));
  impl_->steepness_per_m.push_back(steepness(r));
  impl_->records.push_back(std::move(r));
}

float RadianceTree::interpolate(const Vec3& p, const Frame& frame, int order, Worker& worker) const {
  PHOS_CHECK(order >= 1, "order ", order);
  order = std::min(order, impl_->order);
  const HshRotator& rotator = impl_->rotators[static_cast<std::size_t>(order - 1)];
  worker.light.assign(numbers(order), 0);
  worker.stderr_light.assign(3 * static_cast<std::size_t>(order), 0);
  worker.sum.assign(numbers(order), 0), worker.turned.resize(numbers(order));
  impl_->tree.valid(p, frame.z, worker.found);
  const IrradianceRecord* first = impl_->tree.records().data();
  const Frame* own = nullptr;  // that `sum` is in
  // Records that share a frame (on a flat surface all do) are turned together.
  const auto turn = [&] {
    if (!own) return;
    if (same(*own, frame)) {
      std::copy(worker.sum.begin(), worker.sum.end(), worker.turned.begin());
    } else {
      rotator.rotate(rotation_angles(*own, frame), worker.sum, worker.turned, 3);
    }
    for (std::size_t i = 0; i < worker.light.size(); ++i) worker.light[i] += worker.turned[i];
    std::fill(worker.sum.begin(), worker.sum.end(), 0.f);
  };
  float weight = 0;
  for (const IrradianceRecord* found : worker.found) {
    const auto record = static_cast<std::size_t>(found - first);
    const RadianceRecord& r = impl_->records[record];
    if (!own || !same(*own, r.frame)) turn(), own = &r.frame;
    const float w = weight_at(found->position, found->normal, found->radius_m, impl_->accuracy, p, frame.z);
    impl_->add(record, w, p, worker.sum);
    for (std::size_t i = 0; i < worker.stderr_light.size(); ++i)
      worker.stderr_light[i] += w * r.stderr_light[i];
    weight += w;
  }
  turn();
  if (!(weight > 0)) return 0;
  const float share = 1 / weight;
  for (float& x : worker.light) x *= share;
  for (float& x : worker.stderr_light) x *= share;
  return weight;
}

GlossyLight RadianceTree::outgoing(const Vec3& p, const Frame& frame, std::span<const float> lobe,
                                   const Rgb& least, Worker& worker) const {
  const auto order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(lobe.size() / 3))));
  PHOS_CHECK(order >= 1 && lobe.size() == numbers(order), lobe.size(), " numbers of a lobe");
  GlossyLight light;
  light.weight = interpolate(p, frame, order, worker);
  if (!(light.weight > 0)) return light;
  Rgb sum(0), variance(0);
  for (std::size_t l = 0, i = 0; 3 * l < worker.stderr_light.size(); ++l) {
    Rgb energy(0);  // of the lobe in this band
    for (; i < 3 * (l + 1) * (l + 1); i += 3) {
      const Rgb c(lobe[i], lobe[i + 1], lobe[i + 2]);
      sum += c * Rgb(worker.light[i], worker.light[i + 1], worker.light[i + 2]);
      energy += c * c;
    }
    const Rgb error(worker.stderr_light[3 * l], worker.stderr_light[3 * l + 1],
                    worker.stderr_light[3 * l + 2]);
    variance += energy * error * error;
  }
  light.radiance = glm::max(sum, least * glm::max(irradiance_of(worker.light), Rgb(0)));
  light.stderr_cd = glm::sqrt(variance);
  return light;
}

GlossyLight RadianceTree::outgoing(const Vec3& p, const Frame& frame, const Vec3& wo, const BrdfLookup& brdf,
                                   Worker& worker) const {
  std::vector<float> lobe;
  if (brdf.coefficients(wo, lobe) == 0) return {};
  return outgoing(p, frame, lobe, Rgb(0), worker);
}

}  // namespace phos
