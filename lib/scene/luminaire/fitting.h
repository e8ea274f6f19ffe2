// A luminaire whose distribution was measured, where it hangs in a scene.
#pragma once

#include <memory>
#include <vector>

#include "core/vector.h"

namespace phos::inline file {
class Hasher;
}

namespace phos::inline scene {

class Photometry;
struct PhotometricFile;

/// Directions are the world's, unit, the way light travels; intensities hold the colour.
class Fitting {
 public:
  /// `axes`: columns are the world's directions of the luminaire's x (C0), y (C90) and up, orthonormal.
  /// `colour` multiplies the candela of the file.
  Fitting(std::shared_ptr<const PhotometricFile> file, const Mat3& axes, const Rgb& colour);

  const PhotometricFile& file() const { return *file_; }
  const Photometry& photometry() const { return *photometry_; }
  const Mat3& axes() const { return axes_; }
  const Rgb& colour() const { return colour_; }
  void set_colour(const Rgb& colour) { colour_ = colour; }
  Vec3 down() const { return -axes_[2]; }

  Rgb flux_lm() const;
  Rgb peak_cd() const;  ///< intensity in the brightest direction
  /// Intensity over that in the brightest direction; 0 for a dark luminaire.
  float share(const Vec3& direction) const;
  Rgb intensity_cd(const Vec3& direction) const;
  /// Density intensity / flux per sr.
  Vec3 sample_direction(const Vec2& u) const;

  /// Of a luminous opening: a convex surface's normals, and areas in w. Its luminance is then the intensity
  /// over the area seen.
  void set_surface(const std::vector<Vec4>& facets, bool both_sides);
  struct Facet {
    Vec3 normal{0};
    float area_m2 = 0;
    double lm_per_m2 = 0;  ///< about, of the file's lumens; 0 only where it is dark
  };
  const std::vector<Facet>& facets() const { return facet_; }  ///< in the order of the surface's triangles
  /// An opening of one plane.
  bool flat() const { return plane_.size() == 1; }
  /// What is seen of the opening from far away in that direction; 0 without one.
  float projected_area_m2(const Vec3& direction) const;
  /// Of every point of the opening that is seen so, cd/m2. 0 where nothing is seen.
  Rgb luminance(const Vec3& direction) const;
  /// A facet in proportion to its visible area, by u in [0, 1).
  std::size_t seen_facet(const Vec3& direction, float u) const;

  void add_to(Hasher& hasher) const;

 private:
  Vec3 to_local(const Vec3& d) const {
    return {glm::dot(d, axes_[0]), glm::dot(d, axes_[1]), glm::dot(d, axes_[2])};
  }
  float seen(const Vec3& normal, const Vec3& direction) const;

  std::shared_ptr<const PhotometricFile> file_;
  const Photometry* photometry_;
  Mat3 axes_{1};
  Rgb colour_{1};
  bool both_sides_ = false;
  std::vector<Facet> facet_;
  std::vector<Vec4> plane_;  // facets of one normal together: normal, area
};

}  // namespace phos::inline scene
