// How well hemispherical harmonics, and the bases they compete with, hold a scene's glossy reflection.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scene/scene.h"

namespace phos::inline radiance {

/// A table, CSV: material, weight, basis, coefficients, accuracy. Accuracy is the share of the energy
/// (integral of the square over the hemisphere) of the luminance of a material's glossy lobe that so many
/// functions of a basis (hsh/comparison_bases.h) hold, up to 100 of them: the mean over directions of view,
/// spread evenly over the parabolic map. Weight names the projected function: the lobe times the cosine of
/// the incident direction ("cosine", which rendering needs), or the lobe alone ("none"). Parallel; the same
/// text on any number of threads.
std::string basis_accuracy_csv(const Scene& scene, std::span<const std::uint32_t> materials);

}  // namespace phos::inline radiance
