#include "scene/material/microfacet.h"

#include <algorithm>
#include <array>

namespace phos::inline scene {

float Ggx::distribution(const Vec3& h) const {
  if (h.z <= 0) return 0;
  const float x = h.x / alpha_x, y = h.y / alpha_y;
  const float s = x * x + y * y + h.z * h.z;
  return 1 / (kPi * alpha_x * alpha_y * s * s);
}

namespace {

float stretched_length(const Ggx& ggx, const Vec3& w) {
  return glm::length(Vec3(ggx.alpha_x * w.x, ggx.alpha_y * w.y, w.z));
}

}  // namespace

float Ggx::visibility(const Vec3& o, const Vec3& i) const {
  return 0.5f / (i.z * stretched_length(*this, o) + o.z * stretched_length(*this, i));
}

Vec3 Ggx::sample_visible(const Vec3& o, const Vec2& u) const {
  const Vec3 stretched = glm::normalize(Vec3(alpha_x * o.x, alpha_y * o.y, o.z));
  const float across2 = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vec3 t1 = across2 > 0 ? Vec3(-stretched.y, stretched.x, 0) / std::sqrt(across2) : Vec3(1, 0, 0);
  const Vec3 t2 = glm::cross(stretched, t1);
  const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
  const float p1 = r * std::cos(phi);
  const float s = 0.5f * (1 + stretched.z);
  const float p2 = (1 - s) * std::sqrt(std::max(0.f, 1 - p1 * p1)) + s * r * std::sin(phi);
  const Vec3 n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.f, 1 - p1 * p1 - p2 * p2)) * stretched;
  return glm::normalize(Vec3(alpha_x * n.x, alpha_y * n.y, std::max(1e-6f, n.z)));
}

float Ggx::density(const Vec3& o, const Vec3& i) const {
  const Vec3 h = glm::normalize(o + i);
  // D G1 / (4 cos_o), G1 / cos_o = 2 / (cos_o + stretched length).
  return 0.5f * distribution(h) / (o.z + stretched_length(*this, o));
}

float fresnel_dielectric(float cos_i, float eta, float& cos_t) {
  cos_i = std::clamp(cos_i, 0.f, 1.f);
  const float sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) {
    cos_t = 0;
    return 1;
  }
  cos_t = std::sqrt(1 - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float across = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + across * across);
}

namespace {

/// A and B of ggx_albedo over the square roots of cos(theta) and of alpha.
struct AlbedoTable {
  static constexpr int kCosines = 32, kAlphas = 17, kSamples = 24;
  struct Entry {
    float a = 0, b = 0;
  };
  std::array<std::array<Entry, kCosines>, kAlphas> entry;
  std::array<Entry, kAlphas> mean;

  /// Denser towards grazing, where the albedo bends most.
  static float cosine(std::size_t i) {
    const float root = static_cast<float>(i) / (kCosines - 1);
    return root * root;
  }

  AlbedoTable() {
    for (int j = 0; j < kAlphas; ++j) {
      const float root = static_cast<float>(j) / (kAlphas - 1);
      for (int i = 0; i < kCosines; ++i) {
        const auto column = static_cast<std::size_t>(i);
        entry[static_cast<std::size_t>(j)][column] = integrate(std::max(cosine(column), 1e-4f), root * root);
      }
      mean[static_cast<std::size_t>(j)] = mean_of(entry[static_cast<std::size_t>(j)]);
    }
  }

  /// Midpoint rule over the unit square of sample_visible.
  static Entry integrate(float cos_theta, float alpha) {
    if (alpha == 0) return {1 - schlick_power(cos_theta), schlick_power(cos_theta)};
    const Ggx ggx{alpha, alpha};
    const Vec3 o(std::sqrt(1 - cos_theta * cos_theta), 0, cos_theta);
    double a = 0, b = 0;
    for (int k = 0; k < kSamples * kSamples; ++k) {
      const Vec2 u((static_cast<float>(k % kSamples) + 0.5f) / kSamples,
                   (static_cast<float>(k / kSamples) + 0.5f) / kSamples);
      const Vec3 h = ggx.sample_visible(o, u);
      const Vec3 i = 2 * glm::dot(o, h) * h - o;
      if (i.z <= 0) continue;
      // G2 / G1, with G1 = 2 cos_o / (cos_o + stretched length).
      const float ratio = ggx.visibility(o, i) * 2 * i.z * (o.z + stretched_length(ggx, o));
      const float power = schlick_power(glm::dot(o, h));
      a += static_cast<double>(ratio * (1 - power)), b += static_cast<double>(ratio * power);
    }
    constexpr double kCount = kSamples * kSamples;
    return {static_cast<float>(a / kCount), static_cast<float>(b / kCount)};
  }

  /// 2 int E(c) c dc of the piecewise linear E, exactly.
  static Entry mean_of(const std::array<Entry, kCosines>& row) {
    double a = 0, b = 0;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      const double c0 = static_cast<double>(cosine(i)), c1 = static_cast<double>(cosine(i + 1)), h = c1 - c0;
      const double w0 = h * (2 * c0 + c1) / 6, w1 = h * (c0 + 2 * c1) / 6;
      a += 2 * (w0 * static_cast<double>(row[i].a) + w1 * static_cast<double>(row[i + 1].a));
      b += 2 * (w0 * static_cast<double>(row[i].b) + w1 * static_cast<double>(row[i + 1].b));
    }
    return {static_cast<float>(a), static_cast<float>(b)};
  }
};

const AlbedoTable& albedo_table() {
  static const AlbedoTable table;
  return table;
}

struct Cell {
  std::size_t index;
  float fraction;
};

Cell alpha_cell(float alpha) {
  const float x = std::sqrt(std::clamp(alpha, 0.f, 1.f)) * (AlbedoTable::kAlphas - 1);
  const int i = std::min(static_cast<int>(x), AlbedoTable::kAlphas - 2);
  return {static_cast<std::size_t>(i), x - static_cast<float>(i)};
}

Cell cosine_cell(float cos_theta) {
  const float c = std::clamp(cos_theta, 0.f, 1.f);
  const int row =
      std::min(static_cast<int>(std::sqrt(c) * (AlbedoTable::kCosines - 1)), AlbedoTable::kCosines - 2);
  const auto i = static_cast<std::size_t>(row);
  const float c0 = AlbedoTable::cosine(i), c1 = AlbedoTable::cosine(i + 1);
  return {i, (c - c0) / (c1 - c0)};
}

AlbedoTable::Entry mix(const AlbedoTable::Entry& p, const AlbedoTable::Entry& q, float t) {
  return {(1 - t) * p.a + t * q.a, (1 - t) * p.b + t * q.b};
}

}  // namespace

float ggx_albedo(float cos_theta, float alpha, float f0, float f90) {
  const AlbedoTable& table = albedo_table();
  const Cell c = cosine_cell(cos_theta), r = alpha_cell(alpha);
  const auto at = [&](std::size_t row) {
    return mix(table.entry[row][c.index], table.entry[row][c.index + 1], c.fraction);
  };
  const AlbedoTable::Entry e = mix(at(r.index), at(r.index + 1), r.fraction);
  return f0 * e.a + f90 * e.b;
}

float ggx_mean_albedo(float alpha, float f0, float f90) {
  const AlbedoTable& table = albedo_table();
  const Cell r = alpha_cell(alpha);
  const AlbedoTable::Entry e = mix(table.mean[r.index], table.mean[r.index + 1], r.fraction);
  return f0 * e.a + f90 * e.b;
}

}  // namespace phos::inline scene
