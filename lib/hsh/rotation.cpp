#include "hsh/rotation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <numbers>

#include "core/error.h"
#include "hsh/turn/hsh_turn.h"
#include "hsh/turn/kernel.h"
#include "hsh/turn/sh_turn.h"

namespace phos::inline hsh {
namespace {

constexpr int kDegrees = 90;  // the last table
constexpr float kPerDegree = kPi / 180;
constexpr float kLeastBeta = 0.1f * kPerDegree;

/// A turn about z: cos(m a) and sin(m a), m = 0 .. order - 1.
struct ZTurn {
  ZTurn(float angle, int of_order) : order(of_order) {
    const double a = angle, c = std::cos(a), s = std::sin(a);
    double cm = 1, sm = 0;
    for (int m = 0; m < order; ++m) {
      cosine[m] = static_cast<float>(cm), sine[m] = static_cast<float>(sm);
      const double next = c * cm - s * sm;
      sm = s * cm + c * sm, cm = next;
    }
  }
  int order;
  float cosine[HarmonicBasis<float>::kMaxOrder], sine[HarmonicBasis<float>::kMaxOrder];

  /// Coefficients `width` apart, turned, to cosines and sines.
  void split(const float* from, std::ptrdiff_t width, float* to_cosine, float* to_sine) const {
    for (int l = 0; l < order; ++l) {
      const float* centre = from + harmonic_index(l, 0) * width;
      *to_cosine++ = *centre;
      for (int m = 1; m <= l; ++m) {
        const float p = centre[m * width], q = centre[-m * width];
        *to_cosine++ = p * cosine[m] - q * sine[m], *to_sine++ = p * sine[m] + q * cosine[m];
      }
    }
  }
  /// The same the other way.
  void join(const float* from_cosine, const float* from_sine, float* to, std::ptrdiff_t width) const {
    for (int l = 0; l < order; ++l) {
      float* centre = to + harmonic_index(l, 0) * width;
      *centre = *from_cosine++;
      for (int m = 1; m <= l; ++m) {
        const float p = *from_cosine++, q = *from_sine++;
        centre[m * width] = p * cosine[m] - q * sine[m], centre[-m * width] = p * sine[m] + q * cosine[m];
      }
    }
  }
};

int order_of(std::size_t coefficients) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(coefficients))));
}

void check_sizes(int order, std::span<const float> in, std::span<const float> out, int channels) {
  PHOS_CHECK(channels > 0, "channels ", channels);
  PHOS_CHECK(
      in.size() == static_cast<std::size_t>(harmonic_count(order) * channels) && out.size() == in.size(),
      in.size(), " and ", out.size(), " coefficients");
}

void check(const ZyzAngles& a) {
  PHOS_CHECK(std::isfinite(a.alpha + a.beta + a.gamma) && a.beta >= 0, "alpha ", a.alpha, " beta ", a.beta,
             " gamma ", a.gamma);
}

}  // namespace

ZyzAngles rotation_angles(const Frame& from, const Frame& to) {
  const auto r = [&](const Vec3& row, const Vec3& column) { return glm::dot(DVec3(row), DVec3(column)); };
  const double xz = r(to.x, from.z), yz = r(to.y, from.z), sine = std::hypot(xz, yz);
  ZyzAngles angles;
  const double beta = std::atan2(sine, r(to.z, from.z));
  // Next to 0 and pi alpha and gamma are undefined one by one: their sum, or difference, is not.
  const bool undefined = !(sine > 1e-6);
  const double gamma = undefined ? 0 : std::atan2(yz, xz);
  const double xx = r(to.x, from.x), xy = r(to.x, from.y), yx = r(to.y, from.x), yy = r(to.y, from.y);
  const double alpha = beta <= std::numbers::pi / 2 ? std::atan2(yx - xy, xx + yy) - gamma
                                                    : gamma - std::atan2(-(yx + xy), yy - xx);
  angles.alpha = static_cast<float>(alpha), angles.beta = static_cast<float>(beta);
  angles.gamma = static_cast<float>(gamma);
  return angles;
}

void rotate_about_z(std::span<float> coefficients, float angle, int channels) {
  PHOS_CHECK(channels > 0 && std::isfinite(angle), "channels ", channels, " angle ", angle);
  const auto width = static_cast<std::size_t>(channels);
  const int order = order_of(coefficients.size() / width);
  PHOS_CHECK(order <= HarmonicBasis<float>::kMaxOrder &&
                 coefficients.size() == static_cast<std::size_t>(harmonic_count(order)) * width,
             coefficients.size(), " coefficients");
  const ZTurn turn(angle, order);
  for (int l = 1; l < order; ++l)
    for (int m = 1; m <= l; ++m) {
      float* plus = coefficients.data() + static_cast<std::size_t>(harmonic_index(l, m)) * width;
      float* minus = coefficients.data() + static_cast<std::size_t>(harmonic_index(l, -m)) * width;
      const float c = turn.cosine[m], s = turn.sine[m];
      for (std::size_t k = 0; k < width; ++k) {
        const float p = plus[k], q = minus[k];
        plus[k] = p * c - q * s, minus[k] = p * s + q * c;
      }
    }
}

/// Matrices of the whole degrees, made when first asked for.
struct HshRotator::Tables {
  Tables(int of_order, HshRotation by) : order(of_order), method(by) {}
  int order;
  HshRotation method;

  PackedTurn make(double beta, bool transposed) const {
    Turn turn = hsh_turn(order, method, beta);
    if (transposed) turn.transpose();
    return pack(turn);
  }

  const PackedTurn& at_degree(int degree, bool transposed) const {
    Entry& e = entries[transposed][degree];
    std::call_once(e.made, [&] { e.turn = make(degree * std::numbers::pi / 180, transposed); });
    return e.turn;
  }

  static std::shared_ptr<const Tables> shared(int order, HshRotation method) {
    static std::mutex mutex;
    static std::map<std::pair<int, HshRotation>, std::shared_ptr<const Tables>> all;
    const std::lock_guard lock(mutex);
    auto& tables = all[{order, method}];
    if (!tables) tables = std::make_shared<const Tables>(order, method);
    return tables;
  }

 private:
  struct Entry {
    std::once_flag made;
    PackedTurn turn;
  };
  mutable Entry entries[2][kDegrees + 1];
};

HshRotator::HshRotator(int order, HshRotation method, float max_beta) : max_beta_(max_beta) {
  if (order < 1 || order > kMaxOrder)
    throw Error(ExitCode::usage, "", text("order ", order, ": HSH are rotated to order 1 .. ", kMaxOrder));
  if (!(max_beta >= 0 && max_beta <= std::numbers::pi_v<float> / 2))
    throw Error(ExitCode::usage, "", text("max_beta ", max_beta, ": must be from 0 to pi/2 rad"));
  tables_ = Tables::shared(order, method);
}
HshRotator::~HshRotator() = default;

int HshRotator::order() const { return tables_->order; }

void HshRotator::rotate(const ZyzAngles& angles, std::span<const float> in, std::span<float> out,
                        int channels) const {
  apply(angles, false, in, out, channels);
}

void HshRotator::rotate_transposed(const ZyzAngles& angles, std::span<const float> in, std::span<float> out,
                                   int channels) const {
  apply({-angles.gamma, angles.beta, -angles.alpha}, true, in, out, channels);
}

void HshRotator::apply(const ZyzAngles& angles, bool transposed, std::span<const float> in,
                       std::span<float> out, int channels) const {
  const int order = tables_->order;
  check_sizes(order, in, out, channels);
  check(angles);
  if (angles.beta < kLeastBeta) {
    std::copy(in.begin(), in.end(), out.begin());
    return rotate_about_z(out, angles.alpha + angles.gamma, channels);
  }
  const float degrees = std::min(angles.beta / kPerDegree, static_cast<float>(kDegrees));
  const int below = std::min(static_cast<int>(degrees), kDegrees - 1);
  PackedTurn exact;
  const bool tabled = angles.beta <= max_beta_;
  if (!tabled) exact = tables_->make(std::min<double>(angles.beta, std::numbers::pi), transposed);
  const PackedTurn& a = tabled ? tables_->at_degree(below, transposed) : exact;
  const PackedTurn& b = tabled ? tables_->at_degree(below + 1, transposed) : exact;
  const float of_b = tabled ? degrees - static_cast<float>(below) : 0, of_a = 1 - of_b;

  const ZTurn first(angles.alpha, order), last(angles.gamma, order);
  static TurnKernel* const turn = best_turn_kernel();
  constexpr int kStride = PackedTurn::kMaxRows;
  float cosine[2][3 * kStride], sine[2][3 * kStride];  // before and after the turn about y
  for (int channel = 0, vectors; channel < channels; channel += vectors) {
    vectors = channels - channel >= 3 ? 3 : 1;
    for (int v = 0; v < vectors; ++v)
      first.split(in.data() + channel + v, channels, cosine[0] + v * kStride, sine[0] + v * kStride);
    turn(a.cosine.data(), b.cosine.data(), a.cosines, of_a, of_b, vectors, cosine[0], cosine[1]);
    turn(a.sine.data(), b.sine.data(), a.sines, of_a, of_b, vectors, sine[0], sine[1]);
    for (int v = 0; v < vectors; ++v)
      last.join(cosine[1] + v * kStride, sine[1] + v * kStride, out.data() + channel + v, channels);
  }
}

struct ShRotation::Turns {
  Turns(int order, const ZyzAngles& angles)
      : about_y(order, angles.beta), first(angles.alpha, order), last(angles.gamma, order) {}
  ShTurn about_y;  // refuses orders that the others have no room for
  ZTurn first, last;
};

ShRotation::ShRotation(int order, const ZyzAngles& angles) {
  check(angles);
  turns_ = std::make_unique<const Turns>(order, angles);
}
ShRotation::~ShRotation() = default;

void ShRotation::rotate(std::span<const float> in, std::span<float> out, int channels) const {
  const int order = turns_->first.order;
  check_sizes(order, in, out, channels);
  const auto cosines = static_cast<std::size_t>(order * (order + 1) / 2);
  std::vector<float> before(2 * cosines), after(2 * cosines);
  const auto multiply = [](const double* matrix, int size, const float* x, float* y) {
    for (int i = 0; i < size; ++i, matrix += size) {
      double sum = 0;
      for (int j = 0; j < size; ++j) sum += matrix[j] * x[j];
      y[i] = static_cast<float>(sum);
    }
  };
  for (int channel = 0; channel < channels; ++channel) {
    turns_->first.split(in.data() + channel, channels, before.data(), before.data() + cosines);
    for (int l = 0; l < order; ++l) {
      const std::size_t c = Turn::cosine_index(l, 0), s = cosines + Turn::sine_index(l, 1);
      multiply(turns_->about_y.cosine(l), l + 1, before.data() + c, after.data() + c);
      multiply(turns_->about_y.sine(l), l, before.data() + s, after.data() + s);
    }
    turns_->last.join(after.data(), after.data() + cosines, out.data() + channel, channels);
  }
}

}  // namespace phos::inline hsh
