// Isotropic lobes as rows of a texture.
#pragma once

#include <utility>
#include <vector>

#include "radiance/gloss_tables.h"
#include "splat/cpu/gloss_splatter.h"

namespace phos::inline splat {

/// Tables of isotropic materials one below the other, tables of one order together. Column l (l + 1) / 2 + m
/// holds the coefficient c_l^m, RGB; w of the first column is the entry's order.
class GlossRows {
 public:
  /// Tables beyond `most` rows are left out, and so are tables of lobes that may take light away.
  GlossRows(const GlossTables& tables, std::size_t materials, int most);
  int width() const { return width_; }
  int height() const { return static_cast<int>(texels_.size() / static_cast<std::size_t>(width_)); }
  const std::vector<Vec4>& texels() const { return texels_; }
  /// First row of the tables of an order, and the end.
  std::pair<int, int> of_order(int order) const;

  /// Where the lobe of a point towards wo (unit, world) is: row, share of the next, cosine and sine of the
  /// azimuth of wo in make_frame(smooth normal). False: not here, or it is to be traced.
  bool find(const SurfacePoint& point, const Vec3& wo, Vec4& place) const;
  /// Sum of the squares of a lobe's coefficients of band l.
  Rgb energy(const Vec4& place, int l) const;

 private:
  struct Table {
    const BrdfTable* table;
    int first;
  };
  const GlossTables& tables_;
  int width_ = 1;
  std::vector<Table> all_;              // ascending by order
  std::vector<std::int32_t> table_of_;  // per material, -1: none
  std::vector<Vec4> texels_;
};

/// What a pixel's light is left to others for.
struct GlossLeft {
  std::vector<Vec4>
      place;  ///< where its lobe is; x = -1: no record adds to the pixel, or it is drawn already
  std::vector<BlendSums> spread;  ///< but for value2
};
/// splat_gloss_on_cpu() of all pixels but those whose lobe is in `rows`: their light is left 0, and their
/// error the sum of w x the records' own.
GlossBuffer splat_gloss_beside(const GlossCache& cache, double accuracy, const RayScene& rays,
                               const GBuffer& gbuffer, const Camera& camera, const Vec2& subpixel,
                               const GlossRows& rows, GlossLeft& left);

}  // namespace phos::inline splat
