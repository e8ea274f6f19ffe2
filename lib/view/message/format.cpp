#include "view/message/format.h"

#include <algorithm>

#include "core/error.h"
#include "core/json.h"
#include "splat/direct/lamp_places.h"

namespace phos::inline view {
namespace {

using enum FieldType;

constexpr MessageField kSceneFields[] = {
    {"scene", "bounds_lo", f32, 3, "m", "lower corner of the bounds"},
    {"scene", "bounds_hi", f32, 3, "m", "upper corner of the bounds"},
    {"scene", "origin", f32, 3, "m", "place in the world that all positions are counted from"},
    {"scene", "sky_lamp", u32, 1, "", "lamp that the table of the sky shows", false, false, "lamp"},
    {"vertex", "position", f32, 3, "m", ""},
    {"vertex", "normal", f32, 3, "", "unit"},
    {"vertex", "uv", f32, 4, "", "texture coordinates of set 0 and of set 1; absent: 0", true},
    {"vertex", "colour", f32, 4, "", "linear, with alpha; absent: 1", true},
    {"triangle", "corner", u32, 3, "", "counter-clockwise", false, false, "vertex"},
    {"part", "first_triangle", u32, 1, "", "of a run of triangles of one material"},
    {"part", "triangle_count", u32, 1, "", ""},
    {"part", "material", u32, 1, "", "", false, false, "material"},
    {"part", "mirror", u32, 1, "", "in whose plane all its triangles lie", false, false, "mirror"},
    {"part", "lamp", u32, 1, "", "lamp whose surface it is", false, false, "lamp"},
    {"material", "diffuse", f32, 4, "", "diffuse reflectance, and alpha; multiplied by colour_texture"},
    {"material", "gloss", f32, 3, "",
     "mean reflectance of gloss, drawn as if it were diffuse where no radiance record reaches"},
    {"material", "emission", f32, 3, "cd/m2", "multiplied by emission_texture"},
    {"material", "flags", u32, 1, "", "MaterialFlag"},
    {"material", "cutoff", f32, 1, "", "least alpha that is there"},
    {"material", "colour_texture", u32, 1, "", "", false, false, "texture"},
    {"material", "colour_set", u32, 1, "", "set of texture coordinates, 0 or 1"},
    {"material", "colour_place", f32, 6, "", "offset, and the two columns of the matrix of coordinates"},
    {"material", "emission_texture", u32, 1, "", "", false, false, "texture"},
    {"material", "emission_set", u32, 1, "", "set of texture coordinates, 0 or 1"},
    {"material", "emission_place", f32, 6, "", "as colour_place"},
    {"material", "specular", u32, 1, "", "", false, false, "specular"},
    {"material", "glint", u32, 1, "", "GlintKind: how lamps shine in its gloss"},
    {"material", "glint_peak", f32, 3, "1/sr",
     "the lobe itself, where light comes and goes along the normal"},
    {"material", "glint_width", f32, 1, "",
     "of GlintKind::ggx and ward the roughness alpha, of phong the exponent"},
    {"specular", "reflects", f32, kSpecularFloats, "",
     "share of light that a mirror or glass reflects: RGB at 33 cosines of incidence, evenly from 0 to 1"},
    {"specular", "passes", f32, kSpecularFloats, "", "share that comes straight through it"},
    {"mirror", "plane", f32, 4, "m", "unit normal, and minus its product with a point of the plane"},
    {"mirror", "centre", f32, 3, "m", "of the surfaces in the plane"},
    {"mirror", "area", f32, 1, "m2", ""},
    {"texture", "width", u32, 1, "", ""},
    {"texture", "height", u32, 1, "", ""},
    {"texture", "wrap", u32, 2, "", "along u and v: 0 repeat, 1 clamp, 2 mirror"},
    {"texture", "nearest", u32, 1, "", "1: no interpolation"},
    {"texture", "srgb", u32, 1, "", "1: colours are sRGB; 0: linear"},
    {"texture", "first_texel", u32, 1, "", "the first of width x height, from v = 0"},
    {"texel", "rgba", u8, 4, "", ""},
    {"lamp", "name_end", u32, 1, "", "end of its name in lamp_name, which begins where the one before ends"},
    {"lamp_name", "utf8", u8, 1, "", ""},
    {"sample", "lamp", u32, 1, "", "lamp that shines from here", false, false, "lamp"},
    {"sample", "shape", u32, 1, "", "PlaceShape: 0 area, 1 point, 2 spot, 3 directional, 4 map, 5 area_map"},
    {"sample", "position", f32, 3, "m", "directional: unused"},
    {"sample", "nearest", f32, 1, "m", "nothing that throws a shadow is nearer; directional: unused"},
    {"sample", "forward", f32, 3, "",
     "unit; of an area the normal, of a spot the axis, of a directional lamp "
     "the way of the light"},
    {"sample", "colour", f32, 3, "cd", "on the axis; directional: lx on a surface that faces it"},
    {"sample", "cone", f32, 2, "", "of a spot: cosines of the outer and inner half angle"},
    {"sample", "two_sided", u32, 1, "", "1: an area shines from both sides"},
    {"sample", "distribution", u32, 1, "", "of PlaceShape::map and area_map", false, false, "distribution"},
    {"distribution", "axes", f32, 9, "", "rows: the luminaire's x, y and up in the scene"},
    {"distribution", "share", f32, ShareMap::kWidth* ShareMap::kHeight, "",
     "of the sample's colour, by degrees of azimuth (fastest) and from straight down"},
    {"camera", "position", f32, 3, "m", ""},
    {"camera", "right", f32, 3, "", "unit"},
    {"camera", "up", f32, 3, "", "unit, at right angles to right"},
    {"camera", "perspective", u32, 1, "", "1; 0: orthographic"},
    {"camera", "half_height", f32, 1, "", "of the picture: tangent, or m where orthographic"},
    {"camera", "aspect", f32, 1, "", "width over height"},
    {"camera", "name_end", u32, 1, "", "as of lamps, in camera_name"},
    {"camera_name", "utf8", u8, 1, "", ""},
    {"sky", "luminance", f32, 3, "cd/m2",
     "256 x 128 directions: row 0 at the zenith (+y), azimuth "
     "atan2(z, x) from -180 degrees"},
};

constexpr MessageField kRecordFields[] = {
    {"cache", "accuracy", f32, 1, "", "a of the weight"},
    {"cache", "holds_direct", u32, 1, "", "1: records hold all light; 0: indirect light"},
    {"record", "position", f32, 3, "m", ""},
    {"record", "inverse_radius", f32, 1, "1/m", ""},
    {"record", "normal", f32, 3, "", "unit"},
    {"record", "front_limit", f32, 1, "m", "of weight_if_lit()"},
    {"record", "irradiance", f32, 3, "lx", ""},
    {"record", "weight", f32, 1, "", "its share among others"},
    {"record", "stderr", f32, 3, "lx", "standard error of irradiance"},
    {"record", "over_limit", f32, 1, "m", "of weight_if_lit()"},
    {"record", "turn", f32, 9, "lx/rad", "by colour: g_r x n, whose product with n' - n is the change"},
    {"record", "translation", f32, 9, "lx/m", "by colour: the gradient along the surface"},
};

constexpr MessageField kGlossFields[] = {
    {"cache", "accuracy", f32, 1, "", "a of the weight of radiance records"},
    {"lobe", "material", u32, 1, "", "row of the scene's materials that reads radiance records"},
    {"lobe", "order", u32, 1, "", "n: it reads records of n bands"},
    {"lobe", "first_row", u32, 1, "", "of its table in lobe_row"},
    {"lobe", "row_count", u32, 1, "", "row k is the direction of view with tan(t / 2) = k / (row_count - 1)"},
    {"lobe_row", "bands", u32, 1, "", "bands that the row holds; 0: no records serve this direction"},
    {"lobe_row", "first_number", u32, 1, "",
     "of its n (n + 1) / 2 coefficients in lobe_number: c_l^m at l (l + 1) / 2 + m"},
    {"lobe_number", "value", f32, 3, "1/sqrt(sr)", "RGB"},
    {"record", "position", f32, 3, "m", ""},
    {"record", "inverse_radius", f32, 1, "1/m", ""},
    {"record", "normal", f32, 3, "", "unit"},
    {"record", "front_limit", f32, 1, "m", "of weight_if_lit()"},
    {"record", "axis_x", f32, 3, "", "unit, of its frame"},
    {"record", "over_limit", f32, 1, "m", "of weight_if_lit()"},
    {"record", "steepness", f32, 1, "1/m", "of step_share(); 0: it takes no steps"},
    {"record", "weight", f32, 1, "", "its share among others"},
    {"record", "order", u32, 1, "", "n: it holds n^2 coefficients"},
    {"record", "first_number", u32, 1, "",
     "of its coefficients in number, l l + l + m: each takes three rows, light (cd/m2 sqrt(sr)) and its "
     "change along axis_x and along the other axis (per m)"},
    {"number", "value", f32, 3, "", "RGB"},
};

constexpr MessageField kQuestionFields[] = {
    {"ray", "number", u32, 1, "", "which the reading repeats"},
    {"ray", "set", u32, 1, "", "of caches that are read, by about.json"},
    {"ray", "origin", f32, 3, "m", ""},
    {"ray", "direction", f32, 3, "", "of any length but 0"},
    {"group", "weight", f32, 1, "", "factor on the light of each group of the set; not below 0"},
};

constexpr MessageField kReadingFields[] = {
    {"reading", "number", u32, 1, "", "of the ray"},
    {"reading", "hit", u32, 1, "", "1; 0: the ray meets nothing, and all numbers are 0"},
    {"reading", "position", f32, 3, "m", "where the ray lands"},
    {"reading", "normal", f32, 3, "", "unit, on the side that the ray comes from"},
    {"reading", "illuminance", f32, 1, "lx", ""},
    {"reading", "illuminance_stderr", f32, 1, "lx", "standard error", false, true},
    {"reading", "direct", f32, 1, "lx", "straight from lamps", false, true},
    {"reading", "indirect", f32, 1, "lx", "", false, true},
    {"reading", "luminance", f32, 1, "cd/m2",
     "towards the origin of the ray, of emission and of diffuse "
     "reflection"},
    {"reading", "luminance_stderr", f32, 1, "cd/m2", "standard error", false, true},
    {"reading", "has_gloss", u32, 1, "",
     "1: the surface also reflects or passes light that `luminance` lacks"},
};

constexpr MessageLayout kLayouts[] = {{MessageKind::scene, "scene", kSceneFields},
                                      {MessageKind::records, "records", kRecordFields},
                                      {MessageKind::question, "question", kQuestionFields},
                                      {MessageKind::reading, "reading", kReadingFields},
                                      {MessageKind::gloss, "gloss", kGlossFields}};

std::string_view name_of_type(FieldType type) { return type == u8 ? "u8" : type == u32 ? "u32" : "f32"; }

}  // namespace

std::span<const MessageLayout> message_layouts() { return kLayouts; }

const MessageLayout& layout_of(MessageKind kind) {
  const auto* const found = std::find_if(std::begin(kLayouts), std::end(kLayouts),
                                         [&](const MessageLayout& l) { return l.kind == kind; });
  PHOS_CHECK(found != std::end(kLayouts), "kind ", static_cast<int>(kind));
  return *found;
}

std::size_t bytes_of(FieldType type) { return type == u8 ? 1 : 4; }

std::string message_format_json() {
  Json kinds = Json::Array{};
  for (const MessageLayout& layout : kLayouts) {
    Json fields = Json::Array{};
    for (const MessageField& field : layout.fields) {
      Json row = Json::Object{};
      row["table"] = std::string(field.table), row["name"] = std::string(field.name);
      row["type"] = std::string(name_of_type(field.type));
      row["components"] = static_cast<double>(field.components);
      fields.push_back(row);
    }
    Json row = Json::Object{};
    row["kind"] = static_cast<double>(layout.kind), row["name"] = std::string(layout.name);
    row["fields"] = fields;
    kinds.push_back(row);
  }
  Json format = Json::Object{};
  format["version"] = static_cast<double>(kMessageVersion);
  format["kinds"] = kinds;
  return format.dump();
}

}  // namespace phos::inline view
