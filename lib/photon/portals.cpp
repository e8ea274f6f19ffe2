#include "photon/portals.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sampling.h"

namespace phos {

Portals::Portals(std::vector<Portal> pieces, const Environment& light) : pieces_(std::move(pieces)) {
  for (const Portal& p : pieces_) {
    const DVec3 area = (p.triangle ? 0.5 : 1.0) * glm::cross(DVec3(p.edge[0]), DVec3(p.edge[1]));
    area_m2_.push_back(p.inwards == Vec3(0) ? area : glm::length(area) * DVec3(p.inwards));
  }
  // A texel is judged by its middle: a little more, so that what is seen of a portal from its edge is not 0.
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
  const Vec2 weight = p.triangle ? sample_triangle(u) : u;
  point = p.corner + weight.x * p.edge[0] + weight.y * p.edge[1];
  return true;
}

int Portals::crossings(const Vec3& point, const Vec3& direction) const {
  int count = 0;
  const DVec3 d(direction), from(point);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (!(seen_m2(i, d) > 0)) continue;
    // Moller and Trumbore 1997, for the whole line.
    const Portal& p = pieces_[i];
    const DVec3 a(p.edge[0]), b(p.edge[1]), across = glm::cross(d, b), way = from - DVec3(p.corner);
    const double determinant = glm::dot(a, across);
    const double u = glm::dot(way, across) / determinant;
    if (!(u >= 0 && u <= 1)) continue;
    const double v = glm::dot(d, glm::cross(way, a)) / determinant;
    count += v >= 0 && (p.triangle ? u + v : v) <= 1;
  }
  return count;
}

double Portals::density(const Vec3& point, const Vec3& direction) const {
  const double seen = seen_m2(direction);
  if (!(seen > 0)) return 0;
  return guide_->flux_density(-direction) * crossings(point, direction) / seen;
}

std::vector<Portal> named_portals(const Scene& scene, const std::string& names) {
  std::vector<Portal> pieces;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    const std::string name = names.substr(begin, end - begin);
    begin = end + 1;
    bool found = false;
    for (const Instance& instance : scene.instance) {
      if (instance.node != name && scene.material[instance.material].name != name) continue;
      found = true;
      for (std::uint32_t t = 0; t < instance.triangle_count; ++t) {
        const auto& v = scene.triangle[instance.first_triangle + t].v;
        const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
        pieces.push_back({a, {b - a, c - a}, true, Vec3(0)});
      }
    }
    if (!found)
      throw Error(ExitCode::usage, "--portals",
                  text("there is no node or material \"", name, "\"; give names of the scene, or auto"));
  }
  return pieces;
}

}  // namespace phos
