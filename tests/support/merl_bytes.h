// Writes reflection models in the layout of the MERL database.
#pragma once

#include <cmath>
#include <cstring>
#include <string>

#include "core/vector.h"
#include "scene/material/merl.h"

namespace phos::test {

/// A file's bytes for f(o, i) -> Rgb at the middle of every cell; cells that no light reaches hold -1, as in
/// the database.
template <class F>
std::string merl_bytes(const F& f) {
  constexpr int kH = MerlBrdf::kThetaH, kD = MerlBrdf::kThetaD, kP = MerlBrdf::kPhiD;
  constexpr std::size_t kCells = std::size_t{kH} * kD * kP;
  constexpr double kScale[3] = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
  std::string bytes(12 + 3 * kCells * sizeof(double), '\0');
  const std::int32_t header[3] = {kH, kD, kP};
  std::memcpy(bytes.data(), header, sizeof header);
  std::size_t cell = 0;
  for (int h = 0; h < kH; ++h) {
    const double root = (h + 0.5) / kH, theta_h = root * root * M_PI / 2;
    const double ch = std::cos(theta_h), sh = std::sin(theta_h);
    for (int d = 0; d < kD; ++d) {
      const double theta_d = (d + 0.5) / kD * M_PI / 2, cd = std::cos(theta_d), sd = std::sin(theta_d);
      for (int p = 0; p < kP; ++p, ++cell) {
        const double phi = (p + 0.5) / kP * M_PI, x = sd * std::cos(phi), y = sd * std::sin(phi);
        const DVec3 i(ch * x + sh * cd, y, ch * cd - sh * x), o(-ch * x + sh * cd, -y, ch * cd + sh * x);
        const Rgb value = i.z > 0 && o.z > 0 ? f(Vec3(o), Vec3(i)) : Rgb(-1);
        for (int c = 0; c < 3; ++c) {
          const double v = value[c] < 0 ? -1 : static_cast<double>(value[c]) / kScale[c];
          std::memcpy(bytes.data() + 12 + (static_cast<std::size_t>(c) * kCells + cell) * sizeof v, &v,
                      sizeof v);
        }
      }
    }
  }
  return bytes;
}

/// kd / pi, and a lobe of the half vector: ks (n + 8) / (8 pi) cos^n theta_h, normalised as Blinn's is.
struct HalfLobe {
  Rgb kd{0}, ks{0};
  float exponent = 1;
  Rgb operator()(const Vec3& o, const Vec3& i) const {
    const float cosine = glm::normalize(o + i).z;
    return kd / kPi + ks * ((exponent + 8) / (8 * kPi) * std::pow(cosine, exponent));
  }
};

/// kd / pi and Phong's lobe about the mirror direction, which every angle of the table sees.
struct MirrorLobe {
  Rgb kd{0}, ks{0};
  float exponent = 1;
  Rgb operator()(const Vec3& o, const Vec3& i) const {
    const float cosine = std::fmax(o.z * i.z - o.x * i.x - o.y * i.y, 0.f);
    return kd / kPi + ks * ((exponent + 2) / (2 * kPi) * std::pow(cosine, exponent));
  }
};

}  // namespace phos::test
