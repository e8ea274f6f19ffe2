// The distance by which radii of records are chosen where nobody gives them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "estimate/record_options.h"
#include "photon/photon_map.h"
#include "place/candidates.h"
#include "scene/rays.h"

namespace phos::inline place {

struct PlacementOptions;
struct PlacementSource;

/// Median over the places of the harmonic mean distance of their surroundings, m (docs/methods.md#v1):
/// of 64 cosine-weighted rays from each (some thousand places); a ray that leaves the scene counts as
/// infinitely long. A far ground or background changes it little, unlike the scene's bounds. Half of the
/// scene's diagonal at most; a quarter of it where there is no place, or most see nothing; 1/4 m in a scene
/// of no size. Rounded to three digits. Same for any number of threads.
float typical_distance_m(const RayScene& rays, std::span<const SurfaceSample> places);

/// What a camera sees, through mirrors and glass too, at about a thousand pixels.
std::vector<SurfaceSample> seen_places(const RayScene& rays, const std::string& camera);
/// Where photons landed that a surface had scattered, a thousand at most; all photons count where these are
/// few.
std::vector<SurfaceSample> lit_places(const PhotonMap& photons);

/// Of the places that the records of a run serve: places that the camera sees, with Place::view; else places
/// where photons landed, if there are any, or the points given, or places where light lands on a few thousand
/// paths, and beside these the places that the scene's first camera sees, if it has one: photons may crowd in
/// a lamp shade, and a camera may look at a house from far. `source` is as of extend_cache(), the options as
/// resolve() leaves them.
TypicalDistance typical_distance(const RayScene& rays, const PlacementOptions& placement,
                                 const PlacementSource& source);

}  // namespace phos::inline place
