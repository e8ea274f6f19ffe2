#include "photon/portals.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sampling.h"

namespace phos::inline photon {

Portals::Portals(std::span<const Portal> pieces, const Environment& light)
    : pieces_(pieces.begin(), pieces.end()) {
  for (const Portal& p : pieces_) {
    const DVec3 normal = glm::normalize(glm::cross(DVec3(p.edge[0]), DVec3(p.edge[1])));
    area_m2_.push_back(p.area_m2() * (p.inwards == Vec3(0) ? normal : DVec3(p.inwards)));
  }
  // A texel is judged by its middle: a little more, so that the visible part of a portal from its edge is not
  // 0.
  double all_m2 = 0;
  for (const DVec3& area : area_m2_) all_m2 += glm::length(area);
  PHOS_CHECK(all_m2 > 0, "portals without area");
  constexpr double kLeast = 0.001;
  const auto factor = [&](const Vec3& towards) {
    return static_cast<float>(seen_m2(-towards) / all_m2 + kLeast);
  };
  const auto columns = static_cast<std::size_t>(light.width());
  std::vector<Rgb> texels = light.texels();
  parallel_for(static_cast<std::size_t>(light.height()), 8, [&](std::size_t row) {
    for (std::size_t k = 0; k < columns; ++k)
      texels[row * columns + k] *= factor(light.middle(static_cast<int>(k), static_cast<int>(row)));
  });
  std::optional<Environment::Sun> sun = light.sun();
  if (sun) sun->illuminance_lx *= factor(Vec3(sun->towards));
  guide_.emplace(light.width(), light.height(), std::move(texels), light.rotation_rad(), sun);
  flux_lm_ = all_m2 * static_cast<double>(luminance(Rgb(guide_->integral_lx())));
}

double Portals::seen_m2(std::size_t piece, const DVec3& direction) const {
  const double across = glm::dot(area_m2_[piece], direction);
  return pieces_[piece].inwards == Vec3(0) ? std::fabs(across) : std::max(across, 0.0);
}

double Portals::seen_m2(const Vec3& direction) const {
  double sum = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) sum += seen_m2(i, DVec3(direction));
  return sum;
}

bool Portals::sample_point(const Vec3& direction, float u_piece, const Vec2& u, Vec3& point) const {
  double rest = static_cast<double>(u_piece) * seen_m2(direction);
  std::size_t chosen = pieces_.size();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double seen = seen_m2(i, DVec3(direction));
    if (!(seen > 0)) continue;
    chosen = i;
    if (rest < seen) break;
    rest -= seen;
  }
  if (chosen == pieces_.size()) return false;
  const Portal& p = pieces_[chosen];
  point = p.at(p.triangle ? sample_triangle(u) : u);
  return true;
}

int Portals::crossings(const Vec3& point, const Vec3& direction) const {
  int count = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    count += seen_m2(i, DVec3(direction)) > 0 && crosses(pieces_[i], DVec3(point), DVec3(direction));
  return count;
}

double Portals::density(const Vec3& point, const Vec3& direction) const {
  const double seen = seen_m2(direction);
  if (!(seen > 0)) return 0;
  return guide_->flux_density(-direction) * crossings(point, direction) / seen;
}

}  // namespace phos::inline photon
