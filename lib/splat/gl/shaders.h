// GLSL 4.50 of the splatter. Pixels are counted from the top: the projection turns the picture over.
#pragma once

namespace phos::inline splat::shaders {

/// Triangles of the scene, seen through `view`. Reversed depth: 1 at the nearest, towards 0 far away.
extern const char* const scene_vertex;
/// Writes the triangle's number.
extern const char* const scene_fragment;
/// The same, without the holes of materials that are not opaque.
extern const char* const masked_fragment;
/// One rectangle per instance, each with a record.
extern const char* const splat_vertex;
/// record/weight.inc, as it is. What follows it may call its functions.
extern const char* const record_weight;
/// Weight and extrapolated irradiance of a record at a pixel. To be put after #version and record_weight.
extern const char* const splat_fragment;
/// One rectangle per instance, all of one record.
extern const char* const one_record_vertex;
/// The same as splat_fragment for a record with a footprint, which is a uniform block.
extern const char* const footprint_fragment;
/// Weight of a radiance record at a pixel, and the light that it sends through the pixel's lobe. To be put
/// after #version, record_weight, a definition of COUNT, the number of coefficients, and one of FOOTPRINT
/// where the record has a footprint.
extern const char* const gloss_fragment;
/// One triangle over the whole picture.
extern const char* const picture_vertex;
/// Illuminance of each pixel by one sample of a light, where its shadow map lets it through.
extern const char* const shadow_fragment;

}  // namespace phos::inline splat::shaders
