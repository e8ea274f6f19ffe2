// Light of many lamps at a point, by a few rays to each node of a cut through their hierarchy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cache/light_tree.h"
#include "core/random.h"
#include "scene/rays.h"

namespace phos {

struct CutNode {
  LightTree::Index node = 0;
  double importance_lx = 0;  ///< above 0
};

/// Nodes that hold every lamp that could light the point, once each: from the root on, the node of the
/// largest spread_lx() is opened until there are `nodes`, or every node is a lamp. Fewer where few can light
/// it. FORMULAS-placement T2.
std::vector<CutNode> light_cut(const LightTree& tree, const SurfacePoint& point, std::size_t nodes);

struct CutLight {
  DVec3 irradiance{0}, variance{0};  ///< lx, lx^2, by channel
  std::uint64_t rays = 0;
  bool exact = true;  ///< every node was a lamp without area
};

/// Illuminance by the tree's lamps: two rays to each node of a cut, one to each half of its importance, whose
/// difference tells the error or more (FORMULAS-placement T3); one to a lamp without area, of which it is
/// all; to a lamp of an extent that stands alone as many as its share of the importance, at least two. Lamps'
/// images in mirrors are no part.
CutLight light_by_cut(const RayScene& rays, const Luminaires& lights, const LightTree& tree,
                      const SurfacePoint& point, std::size_t nodes, RandomStream& random);

}  // namespace phos
