// What must hold of every file of photometry that is read.
#pragma once

#include "core/error.h"
#include "core/sampling.h"
#include "reading.h"
#include "scene/luminaire/goniometric.h"
#include "scene/luminaire/hang.h"
#include "scene/luminaire/photometric_lines.h"

namespace phos::fuzz {

inline void require_sound(const PhotometricFile& file) {
  const Photometry& p = *file.photometry;
  const double lm = p.flux_lm();
  PHOS_CHECK(std::isfinite(lm) && lm >= 0, lm, " lm");
  PHOS_CHECK(p.downward_share() >= 0 && p.downward_share() <= 1, p.downward_share());
  for (int i = 0; i < 16; ++i) {
    const Vec2 u = r2_point(i, Vec2(0.5f));
    const float cd = p.candela(sample_uniform_sphere(u));
    PHOS_CHECK(cd >= 0 && cd <= p.peak_cd() * 1.0001f, cd, " of ", p.peak_cd());
    if (!(lm > 0)) continue;
    const Vec3 d = p.sample(u);
    PHOS_CHECK(std::fabs(glm::length(d) - 1) < 1e-4f, d.x, " ", d.y, " ", d.z);
  }
  use(describe_photometry(file).dump(0));
  if (lm > 0) use(goniometric_plot(file, "input"));
  Scene scene;
  hang_luminaire(scene, std::make_shared<const PhotometricFile>(file), {"lamp", glm::dmat4(1), Rgb(1)},
                 LuminairesAs::openings);
  PHOS_CHECK(scene.fitting.size() == 1, scene.fitting.size());
}

}  // namespace phos::fuzz
