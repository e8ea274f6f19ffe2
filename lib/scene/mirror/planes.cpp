#include "scene/mirror/planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "scene/material/bsdf.h"
#include "scene/material/models.h"
#include "scene/mirror/sight.h"
#include "scene/offset.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kMostPlanes = 32, kMostChains = 256;
/// Of planes that reflect less than this, panes for instance, few are taken: each costs shadow rays
/// everywhere.
constexpr float kWeak = 0.2f;
constexpr std::size_t kMostWeakPlanes = 8;
/// Chains that reflect less are left to photons, whose noise is then of little light.
constexpr float kLeastReflectance = 0.02f;
/// And those that carry less than this part of the lamps' light, as far as a few places on them tell: one in
/// 256 sees a lamp.
constexpr float kLeastCarried = 0.002f;
constexpr float kSamePlane = 1 - 1e-6f;  // cosine of normals

/// Luminance that a material sends back as a mirror does at normal incidence; 0 of solid glass.
float mirror_reflectance(const Scene& scene, std::uint32_t material) {
  const Material& m = scene.material[material];
  if (is_solid_glass(m) || m.normal.used()) return 0;
  const Bsdf bsdf(scene, material);
  BsdfSample branch[2];
  const int branches = bsdf.specular_branches(Vec3(0, 0, 1), branch);
  float sum = 0;
  for (int b = 0; b < branches; ++b)
    if (!branch[b].transmitted) sum += luminance(branch[b].weight);
  return sum;
}

bool flat(const Scene& scene, const Triangle& t, const Vec3& normal) {
  if (scene.normal.empty()) return true;
  return std::all_of(std::begin(t.v), std::end(t.v), [&](std::uint32_t v) {
    return std::fabs(glm::dot(scene.normal[v], normal)) >= kSamePlane;
  });
}

}  // namespace

MirrorPlanes::MirrorPlanes(const Scene& scene) {
  find_planes(scene);
  if (!plane_.empty()) find_chains(scene);
}

void MirrorPlanes::find_planes(const Scene& scene) {
  std::vector<float> reflectance;
  bool any = false;
  for (std::uint32_t m = 0; m < scene.material.size(); ++m) {
    reflectance.push_back(mirror_reflectance(scene, m));
    any = any || reflectance.back() >= kLeastReflectance;
  }
  if (!any) return;
  std::vector<Plane> planes;
  std::vector<std::int32_t> plane_of(scene.triangle.size(), kNone);
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    const float own = reflectance[scene.instance[scene.triangle_instance[t]].material];
    if (!(own >= kLeastReflectance)) continue;
    const Vec3 normal = geometric_normal(scene, t);
    if (normal == Vec3(0) || !flat(scene, scene.triangle[t], normal)) continue;
    const auto& v = scene.triangle[t].v;
    const Vec3 &a = scene.position[v[0]], &b = scene.position[v[1]], &c = scene.position[v[2]];
    const float slack_m = 4 * offset_m(a, b, c);
    const auto same = [&](const Plane& p) {
      return std::fabs(glm::dot(p.normal, normal)) >= kSamePlane &&
             std::fabs(glm::dot(a - p.point, p.normal)) <= slack_m + p.slack_m;
    };
    auto found = std::find_if(planes.begin(), planes.end(), same);
    if (found == planes.end()) {
      found = planes.insert(planes.end(), Plane());
      found->point = a, found->normal = normal;
    }
    for (const Vec3& p : {a, b, c}) found->box.include(p);
    found->slack_m = std::max(found->slack_m, slack_m);
    found->reflectance = std::max(found->reflectance, own);
    found->area_m2 += area_m2(scene, t);
    plane_of[t] = static_cast<std::int32_t>(found - planes.begin());
    // A curved mirror of many flat faces is not worth a plane each.
    if (planes.size() > 16 * kMostPlanes) return;
  }
  std::vector<std::size_t> order(planes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return planes[x].area_m2 * planes[x].reflectance > planes[y].area_m2 * planes[y].reflectance;
  });
  std::size_t weak = 0;
  std::erase_if(order,
                [&](std::size_t i) { return planes[i].reflectance < kWeak && ++weak > kMostWeakPlanes; });
  order.resize(std::min(order.size(), kMostPlanes));
  std::vector<std::int32_t> place(planes.size(), kNone);
  for (const std::size_t i : order) {
    place[i] = static_cast<std::int32_t>(plane_.size());
    plane_.push_back(planes[i]);
  }
  if (plane_.empty()) return;
  plane_of_.assign(scene.triangle.size(), kNone);
  turned_.assign(scene.triangle.size(), 0);
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    if (plane_of[t] == kNone) continue;
    plane_of_[t] = place[static_cast<std::size_t>(plane_of[t])];
    if (plane_of_[t] != kNone)
      turned_[t] = glm::dot(geometric_normal(scene, t), plane(plane_of_[t]).normal) < 0;
  }
}

bool MirrorPlanes::beside(const Plane& part, const Plane& of, bool front) const {
  const float sign = front ? 1.f : -1.f, slack_m = part.slack_m + of.slack_m;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 p;
    for (int c = 0; c < 3; ++c) p[c] = corner >> c & 1 ? part.box.hi[c] : part.box.lo[c];
    if (sign * glm::dot(p - of.point, of.normal) > slack_m) return true;
  }
  return false;
}

void MirrorPlanes::find_chains(const Scene& scene) {
  std::vector<Vec3> normals;
  for (const Plane& p : plane_) normals.push_back(p.normal);
  const MirrorSight sight(scene, normals, plane_of_);
  const auto planes = static_cast<std::int32_t>(plane_.size());
  constexpr float kUnknown = -1;
  std::vector<float> seen_share(4 * plane_.size() * plane_.size(), kUnknown);
  const auto seen = [&](std::int32_t a, bool a_front, std::int32_t b, bool b_front) {
    const auto x = static_cast<std::size_t>(a), y = static_cast<std::size_t>(b);
    float& share = seen_share[((2 * x + a_front) * plane_.size() + y) * 2 + b_front];
    if (share == kUnknown) share = sight.seen_share({x, a_front}, {y, b_front});
    return share;
  };
  struct Candidate {
    float carried;  // share of the lamps' light, roughly
    float reflectance;
    std::int32_t before, plane;
    bool front;
    std::size_t number;  // earlier ones first
    bool operator<(const Candidate& o) const {
      return carried != o.carried ? carried < o.carried : number > o.number;
    }
  };
  std::priority_queue<Candidate> queue;
  std::size_t number = 0;
  const auto offer = [&](float reflectance, float lit, std::int32_t before, std::int32_t next, bool front) {
    const float r = reflectance * std::min(plane(next).reflectance, 1.f);
    if (r >= kLeastReflectance && r * lit >= kLeastCarried)
      queue.push({r * lit, r, before, next, front, number++});
  };
  for (std::int32_t p = 0; p < planes; ++p)
    for (const bool front : {true, false})
      offer(1, sight.lit_share({static_cast<std::size_t>(p), front}), kNone, p, front);
  while (!queue.empty() && chain_.size() < kMostChains) {
    const Candidate c = queue.top();
    queue.pop();
    const auto index = static_cast<std::int32_t>(chain_.size());
    chain_.push_back({c.before, c.plane, c.front, c.reflectance, {}});
    (c.before == kNone ? first_ : chain_[static_cast<std::size_t>(c.before)].next).push_back(index);
    for (std::int32_t next = 0; next < planes; ++next) {
      if (next == c.plane || !beside(plane(next), plane(c.plane), c.front)) continue;
      for (const bool front : {true, false})
        if (beside(plane(c.plane), plane(next), front))
          offer(c.reflectance, c.carried / c.reflectance * seen(c.plane, c.front, next, front), index, next,
                front);
    }
  }
}

std::int32_t MirrorPlanes::follow(std::int32_t chain, std::uint32_t triangle, bool front_of_triangle) const {
  const std::int32_t p = plane_of(triangle);
  if (p == kNone) return kNone;
  const bool front = front_of_triangle != static_cast<bool>(turned_[triangle]);
  const std::vector<std::int32_t>& next =
      chain == kNone ? first_ : chain_[static_cast<std::size_t>(chain)].next;
  for (const std::int32_t i : next) {
    const Chain& c = chain_[static_cast<std::size_t>(i)];
    if (c.plane == p && c.front == front) return i;
  }
  return kNone;
}

Vec3 MirrorPlanes::image(std::int32_t chain, const Vec3& receiver) const {
  Vec3 p = receiver;
  for (std::int32_t c = chain; c != kNone; c = chain_[static_cast<std::size_t>(c)].before)
    p = plane(chain_[static_cast<std::size_t>(c)].plane).mirrored(p);
  return p;
}

Vec3 MirrorPlanes::image_of_lamp(std::int32_t chain, const Vec3& lamp) const {
  const Chain& c = chain_[static_cast<std::size_t>(chain)];
  return plane(c.plane).mirrored(c.before == kNone ? lamp : image_of_lamp(c.before, lamp));
}

Vec3 MirrorPlanes::image_of_direction(std::int32_t chain, const Vec3& towards) const {
  const Chain& c = chain_[static_cast<std::size_t>(chain)];
  return plane(c.plane).mirrored_direction(c.before == kNone ? towards
                                                             : image_of_direction(c.before, towards));
}

}  // namespace phos::inline scene
