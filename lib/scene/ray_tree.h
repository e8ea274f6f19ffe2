// Embree's tree over the triangles of a scene, and the data of each triangle that hits need.
#pragma once

#include <embree3/rtcore.h>

#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos::inline scene {

/// The data of a triangle that every hit needs, in one cache line.
struct alignas(64) Facet {
  Vec3 corner[3];
  Vec3 normal;  ///< of the front side
  float offset_m;
  std::uint32_t instance, material;
  bool flat;  ///< the vertices have that normal too
};
static_assert(sizeof(Facet) == 64);

/// Holds a reference to the scene. Queries may be made from any thread.
class RayTree {
 public:
  /// `isa`: RayOptions::isa. Throws Error where Embree does not know it, cannot start, or runs out of memory.
  RayTree(const Scene& scene, const std::string& isa);
  ~RayTree();
  RayTree(const RayTree&) = delete;
  RayTree& operator=(const RayTree&) = delete;

  const Scene& scene() const { return scene_; }
  /// Lengths in the tree, of a scene in metres: a power of two.
  float units_per_m() const { return units_per_m_; }
  float m_per_unit() const { return m_per_unit_; }
  RTCScene native() const { return tree_; }
  /// Of a triangle of the scene.
  const Facet& facet(std::uint32_t triangle) const { return facet_[triangle]; }
  /// The triangle of the scene that a primitive of Embree is.
  std::uint32_t triangle(unsigned geometry, unsigned primitive) const {
    return triangle_of_[geometry].empty() ? primitive : triangle_of_[geometry][primitive];
  }
  bool has_panes() const { return !triangle_of_[kPane].empty(); }

 private:
  // Geometries: surfaces that are hit; surfaces that are hit but for holes; surfaces that light may pass
  // straight.
  static constexpr unsigned kOpaque = 0, kMasked = 1, kPane = 2, kGeometries = 3;

  explicit RayTree(const Scene& scene) : scene_(scene) {}  ///< nothing is made yet
  void make_device(const std::string& isa);
  void throw_if_failed() const;
  void make_facets();
  void attach(unsigned geometry, const std::vector<std::uint32_t>* triangles);
  void build();
  unsigned geometry_of(std::uint32_t triangle, const std::vector<std::uint8_t>& straight,
                       const std::vector<std::uint8_t>& filled) const;
  static void filter(const RTCFilterFunctionNArguments* args);
  static void pane_filter(const RTCFilterFunctionNArguments* args);

  const Scene& scene_;
  float units_per_m_ = 1, m_per_unit_ = 1;
  RTCDevice device_ = nullptr;
  RTCScene tree_ = nullptr;
  std::vector<std::uint32_t> triangle_of_[kGeometries];  // by geometry; empty where primitive i is triangle i
  std::vector<Facet> facet_;                             // per triangle
  std::string trouble_;                                  // the last message of Embree
};

}  // namespace phos::inline scene
