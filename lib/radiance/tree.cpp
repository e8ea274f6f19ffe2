#include "radiance/tree.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "hsh/rotation.h"
#include "radiance/cache.h"
#include "radiance/lobe_dot.h"
#include "record/tree.h"
#include "scene/rays.h"

namespace phos::inline radiance {
namespace {

std::size_t numbers(int order) { return 3 * static_cast<std::size_t>(harmonic_count(order)); }

double squares(const std::vector<float>& v) {
  double sum = 0;
  for (const float x : v) sum += static_cast<double>(x) * static_cast<double>(x);
  return sum;
}

/// The angle between normals at which no weight is left, |n - n_i| / sqrt(2) = a, and a little more.
float most_turned(double accuracy) {
  const double angle = 2 * std::asin(std::min(1., accuracy / std::numbers::sqrt2)) + 0.01;
  return static_cast<float>(std::min(angle, std::numbers::pi / 2));
}

bool same(const Frame& a, const Frame& b) { return a.x == b.x && a.z == b.z; }

}  // namespace

struct RadianceTree::Impl {
  struct Lobe {
    explicit Lobe(std::span<const float> all)
        : numbers(all), order(static_cast<int>(std::lround(std::sqrt(static_cast<double>(all.size() / 3))))) {
      for (std::size_t i = 0; i < all.size(); i += 3)
        grey = grey && all[i] == all[i + 1] && all[i] == all[i + 2];
    }
    std::span<const float> numbers;
    int order;
    bool grey = true;
  };
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

  float weight(const IrradianceRecord& r, const Vec3& p, const Vec3& n) const {
    if (r.footprint) return weight_within(*r.footprint, r, accuracy, p, n) * r.weight;
    return weight_at(r.position, r.normal, r.radius_m, accuracy, p, n) * r.weight;
  }
  /// How far along frame.x and frame.y a record is followed towards p, m.
  Vec2 step_m(std::size_t record, const Vec3& p) const {
    const RadianceRecord& r = records[record];
    const Vec3 step = p - r.position;
    const float steep = steepness_per_m[record];
    if (!(steep > 0)) return Vec2(0);
    return step_share(step, steep) * Vec2(glm::dot(step, r.frame.x), glm::dot(step, r.frame.y));
  }
  /// sum += w (c + dx g_x + dy g_y), as far as `sum` goes.
  void add(std::size_t record, float w, const Vec3& p, std::vector<float>& sum) const {
    const RadianceRecord& r = records[record];
    const Vec2 step = w * step_m(record, p);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * r.light[i];
    if (step == Vec2(0)) return;
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += step.x * r.gradient_x[i] + step.y * r.gradient_y[i];
  }
  /// A lobe times (c + dx g_x + dy g_y).
  Rgb through(const std::vector<float>& lobe, std::size_t record, const Vec2& step) const {
    const RadianceRecord& r = records[record];
    Rgb sum = lobe_dot(lobe.data(), r.light.data(), lobe.size());
    if (step == Vec2(0)) return sum;
    return sum + step.x * lobe_dot(lobe.data(), r.gradient_x.data(), lobe.size()) +
           step.y * lobe_dot(lobe.data(), r.gradient_y.data(), lobe.size());
  }
  Rgb irradiance(std::size_t record, const Vec2& step) const {
    const RadianceRecord& r = records[record];
    Rgb e = irradiance_of(r.light);
    if (step != Vec2(0)) e += step.x * irradiance_of(r.gradient_x) + step.y * irradiance_of(r.gradient_y);
    return glm::max(e, Rgb(0));
  }

  /// A lobe in `frame` as records kept in `own` are to be multiplied by it.
  void turn_lobe(const Lobe& lobe, const Frame& frame, const Frame& own, Worker& worker) const {
    worker.turned.resize(lobe.numbers.size());
    if (same(own, frame)) {
      std::copy(lobe.numbers.begin(), lobe.numbers.end(), worker.turned.begin());
      return;
    }
    const HshRotator& rotator = rotators[static_cast<std::size_t>(lobe.order - 1)];
    const ZyzAngles angles = rotation_angles(own, frame);
    if (!lobe.grey) return rotator.rotate_transposed(angles, lobe.numbers, worker.turned, 3);
    const std::size_t n = lobe.numbers.size() / 3;
    worker.sum.resize(2 * n);
    const std::span<float> one(worker.sum.data(), n), turned(worker.sum.data() + n, n);
    for (std::size_t i = 0; i < n; ++i) one[i] = lobe.numbers[3 * i];
    rotator.rotate_transposed(angles, one, turned);
    for (std::size_t i = 0; i < lobe.numbers.size(); ++i) worker.turned[i] = turned[i / 3];
  }
};

float steepness_per_m(const RadianceRecord& r) {
  const double light = squares(r.light), slope = squares(r.gradient_x) + squares(r.gradient_y);
  // Without light of its own, any step would change it by more than that.
  const auto steepness = static_cast<float>(light > 0 ? std::sqrt(slope / light) : 0.);
  return std::isfinite(steepness) ? steepness : 0;
}

RadianceTree::RadianceTree(const Bounds& bounds, double accuracy, int order, const RayScene* leak_test) {
  impl_ = std::make_unique<Impl>(bounds, accuracy, require_radiance_order(order), leak_test);
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
  impl_->steepness_per_m.push_back(steepness_per_m(r));
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
  BlendSums sums;
  for (const IrradianceRecord* found : worker.found) {
    const auto record = static_cast<std::size_t>(found - first);
    const RadianceRecord& r = impl_->records[record];
    if (!own || !same(*own, r.frame)) turn(), own = &r.frame;
    const float w = impl_->weight(*found, p, frame.z);
    impl_->add(record, w, p, worker.sum);
    for (std::size_t i = 0; i < worker.stderr_light.size(); ++i)
      worker.stderr_light[i] += w * r.stderr_light[i];
    weight += w, sums.add(w, r.shared, 0);
  }
  turn();
  if (!(weight > 0)) return 0;
  const float share = 1 / weight;
  for (float& x : worker.light) x *= share;
  const float left = blended_error(sums, weight, Rgb(0), Rgb(1), 0).x;  // of errors
  for (float& x : worker.stderr_light) x *= share * left;
  return weight;
}

GlossyLight RadianceTree::outgoing(const Vec3& p, const Frame& frame, std::span<const float> coefficients,
                                   const Rgb& least, Worker& worker) const {
  const Impl::Lobe lobe(coefficients);
  PHOS_CHECK(lobe.order >= 1 && lobe.order <= impl_->order && coefficients.size() == numbers(lobe.order),
             coefficients.size(), " numbers of a lobe, records of order ", impl_->order);
  GlossyLight light;
  BlendSums sums;
  Rgb irradiance(0);
  worker.stderr_light.assign(3 * static_cast<std::size_t>(lobe.order), 0);
  impl_->tree.valid(p, frame.z, worker.found);
  const IrradianceRecord* first = impl_->tree.records().data();
  const Frame* own = nullptr;  // that the lobe has been turned to
  for (const IrradianceRecord* found : worker.found) {
    const auto record = static_cast<std::size_t>(found - first);
    const RadianceRecord& r = impl_->records[record];
    if (!own || !same(*own, r.frame)) impl_->turn_lobe(lobe, frame, r.frame, worker);
    own = &r.frame;
    const float w = impl_->weight(*found, p, frame.z);
    const Vec2 step = impl_->step_m(record, p);
    const Rgb through = impl_->through(worker.turned, record, step);
    light.radiance += w * through;
    sums.add(w, r.shared, static_cast<double>(luminance(through)));
    if (least != Rgb(0)) irradiance += w * impl_->irradiance(record, step);
    for (std::size_t i = 0; i < worker.stderr_light.size(); ++i)
      worker.stderr_light[i] += w * r.stderr_light[i];
    light.weight += w;
  }
  if (!(light.weight > 0)) return {};
  Rgb variance(0);
  for (std::size_t l = 0, i = 0; l < static_cast<std::size_t>(lobe.order); ++l) {
    Rgb energy(0);  // of the lobe in this band
    for (; i < 3 * (l + 1) * (l + 1); i += 3) {
      const Rgb c(coefficients[i], coefficients[i + 1], coefficients[i + 2]);
      energy += c * c;
    }
    const Rgb error(worker.stderr_light[3 * l], worker.stderr_light[3 * l + 1],
                    worker.stderr_light[3 * l + 2]);
    variance += energy * error * error;
  }
  const double mean = static_cast<double>(luminance(light.radiance)) / static_cast<double>(light.weight);
  light.radiance = glm::max(light.radiance, least * irradiance) / light.weight;
  light.stderr_cd =
      blended_error(sums, light.weight, light.radiance, glm::sqrt(variance) / light.weight, mean);
  return light;
}

}  // namespace phos::inline radiance
