// The tables: pure data.
#include "file/kinds/tables.h"

#include "file/kinds/tensor_row.h"

namespace phos::inline file {

namespace {

using Rule = NumberCheck::Rule;
using enum TensorGroup::Present;

constexpr double kInfinite = __builtin_inf();

constexpr NumberCheck kAny{Rule::any, ""}, kFinite{Rule::finite, "finite"},
    kNotNegative{Rule::within, "0 or above", 0, kInfinite},
    kFiniteNotNegative{Rule::within, "finite and 0 or above", 0, 3.5e38},
    kPositive{Rule::positive, "finite and above 0"}, kShare{Rule::within, "from 0 to 1", 0, 1},
    kUnit{Rule::unit, "a vector of unit length"},
    kFrame{Rule::frame, "two vectors of unit length at right angles"},
    kPath{Rule::within, "from 0 to 3", 0, 3},
    kPlace{Rule::within, "finite and less than 1e18 m away", -1e18f, 1e18f};

// --- photons ---

constexpr TensorRow kPhoton[] = {
    {"position", Dtype::f32, "n,xyz", "m", kPlace, "place where the photon landed"},
    {"flux", Dtype::f32, "n,rgb", "lm", kFinite, "flux before the surface reflects"},
    {"direction", Dtype::u32, "n", kOctahedralUnit, kAny,
     "unit vector towards the place that the photon came from"},
    {"normal", Dtype::u32, "n", kOctahedralUnit, kAny,
     "unit normal of the surface where the photon landed, on the side where it landed"},
    {"source_normal", Dtype::u32, "n", kOctahedralUnit, kAny,
     "unit normal of the surface that the photon left; gradients need it"},
    {"distance", Dtype::f32, "n", "m", kNotNegative, "distance to the surface that the photon left"},
    {"path", Dtype::u8, "n", "1", kPath,
     "0: straight from a light; 1: from a light by way of a surface that is no mirror; 2: caustic, from a "
     "light by mirrors and glass only; 3: caustic, by flat mirrors in which shadow rays find the light too"},
    {"bounce", Dtype::u8, "n", "1", kAny, "number of surfaces that the photon met before"},
};
constexpr TensorRow kFamilies[] = {
    {"family", Dtype::u32, "n", "1", kAny, "number of its path, the lowest 32 bits"},
};
constexpr TensorRow kTree[] = {
    {"kdtree", Dtype::u8, "bytes", kOpaqueUnit, kAny, "the tree, compressed with lz4"},
};
constexpr TensorRow kFlights[] = {
    {"flight_from", Dtype::f32, "flights,xyz", "m", kPlace, "where a stretch of caustic light begins"},
    {"flight_flux", Dtype::f32, "flights,rgb", "lm", kFinite, "flux of the stretch"},
    {"flight_direction", Dtype::u32, "flights", kOctahedralUnit, kAny,
     "direction of the light on the stretch"},
    {"flight_length", Dtype::f32, "flights", "m", kNotNegative, "length of the stretch"},
};
constexpr TensorGroup kPhotonGroups[] = {
    {always, "", kPhoton},
    {always, "", kTree, FileForm::whole, FileForm::shard},
    {optional,
     "Light that is scattered outside of rooms goes on through portals in many photons of one path, which "
     "are "
     "not independent. This tensor is absent where no path parts so:",
     kFamilies},
    {optional,
     "Sensors in mid-air need the stretches of caustic light that end at no stored photon. These tensors are "
     "absent where there are no such stretches:",
     kFlights},
};

// --- tensors of both kinds of records ---

constexpr TensorRow kLives[] = {
    {"birth", Dtype::i32, "n", "frame", kAny, "first frame that the record serves"},
    {"end", Dtype::i32, "n", "frame", kAny, "first frame after its birth that the record does not serve"},
    {"chain", Dtype::u32, "n", "1", kAny,
     "number of the record's place; the records of one place follow one another"},
    {"rate", Dtype::f32, "n", "1/frame", kFiniteNotNegative, "relative change per frame that was expected",
     "f2"},
};
constexpr TensorRow kAnchors[] = {
    {"anchor", Dtype::u32, "n", "1", kAny, "triangle that the record moves with; 4294967295: none"},
    {"anchor_uv", Dtype::f32, "n,2", "1", kFinite, "place in the triangle"},
    {"anchor_turn", Dtype::f32, "n,4", "1", kUnit,
     "rotation of the triangle at the record's birth, quaternion x, y, z, w"},
};
constexpr TensorRow kRadiusChange[] = {
    {"radius_change", Dtype::f32, "n", "m/frame", kFinite, "change of the radius per frame"},
};
constexpr TensorRow kShared[] = {
    {"shared", Dtype::f32, "n", "1", kShare,
     "share of the variance that records nearby have in common; absent where every record has the default"},
};
constexpr TensorRow kCaustics[] = {
    {"caustic_position", Dtype::f32, "caustics,xyz", "m", kPlace, "place where the photon landed"},
    {"caustic_flux", Dtype::f32, "caustics,rgb", "lm", kFinite, "flux before the surface reflects"},
    {"caustic_direction", Dtype::u32, "caustics", kOctahedralUnit, kAny,
     "unit vector towards the place that the photon came from"},
    {"caustic_normal", Dtype::u32, "caustics", kOctahedralUnit, kAny,
     "unit normal of the surface where the photon landed, on the side where it landed"},
    {"caustic_distance", Dtype::f32, "caustics", "m", kNotNegative,
     "distance to the last surface that changed the photon's direction"},
};
constexpr TensorRow kCausticFlights[] = {
    {"caustic_flight_from", Dtype::f32, "caustic_flights,xyz", "m", kPlace, "as `flight_from` of photons"},
    {"caustic_flight_flux", Dtype::f32, "caustic_flights,rgb", "lm", kFinite, "as `flight_flux`"},
    {"caustic_flight_direction", Dtype::u32, "caustic_flights", kOctahedralUnit, kAny,
     "as `flight_direction`"},
    {"caustic_flight_length", Dtype::f32, "caustic_flights", "m", kNotNegative, "as `flight_length`"},
};
constexpr TensorGroup kSharedGroup{optional, "", kShared};
constexpr TensorGroup kCausticGroup{
    optional, "Where a scene has caustic light, caches of records carry caustic photons:", kCaustics};
constexpr TensorGroup kCausticFlightGroup{optional, "", kCausticFlights};
constexpr TensorGroup kLifeGroup{
    always,
    "Files of films (`phos-temporal`) hold the tensors above for each record as it was born, in the order of "
    "`chain` and `birth`. A record serves the frames from its birth on and before its end. `extra.film` of "
    "the header holds the frames, the fade, and the scene's hash at each frame:",
    kLives, FileForm::film};
constexpr TensorGroup kAnchorGroup{optional, "Where surfaces move:", kAnchors, FileForm::film};
constexpr TensorGroup kRadiusChangeGroup{
    optional, "Unless the film was made with `--temporal-gradients none`:", kRadiusChange, FileForm::film};

// --- irradiance ---

constexpr TensorRow kIrradiance[] = {
    {"position", Dtype::f32, "n,xyz", "m", kFinite, "place of the record"},
    {"normal", Dtype::f32, "n,xyz", "1", kUnit, "unit normal on the lit side"},
    {"irradiance", Dtype::f32, "n,rgb", "lx", kFiniteNotNegative,
     "irradiance by the light that `quantity` of the header names: `indirect` or `all`"},
    {"stderr", Dtype::f32, "n,rgb", "lx", kFinite, "standard error of the irradiance"},
    {"distance", Dtype::f32, "n", "m", kNotNegative, "mean distance to the surroundings", "a7 c6"},
    {"radius", Dtype::f32, "n", "m", kPositive,
     "radius R of the weight; a record serves points within accuracy × R"},
    {"rotation_gradient", Dtype::f32, "n,rgb,xyz", "lx/rad", kFinite,
     "change of irradiance by a turn of the normal", "a5"},
    {"translation_gradient", Dtype::f32, "n,rgb,xyz", "lx/m", kFinite, "change of irradiance by a step",
     "a5"},
};
constexpr TensorRow kLeastRadius[] = {
    {"least_radius", Dtype::f32, "n", "m", kNotNegative, "least radius that neighbours leave to the record"},
};
constexpr TensorRow kFootprint[] = {
    {"footprint_axis", Dtype::f32, "n,xyz", "1", kUnit, "first of eight axes, 45 degrees apart"},
    {"footprint_length", Dtype::f32, "n,8", "m", kPositive, "length of each axis"},
    {"footprint_slope", Dtype::f32, "n,rgb,8", "lx", kFinite,
     "first order change of irradiance over the length of each axis"},
    {"footprint_bend", Dtype::f32, "n,rgb,8", "lx", kFinite,
     "second order change of irradiance over the length of each axis"},
    {"footprint_turn_slope", Dtype::f32, "n,rgb,8", "lx/rad", kFinite,
     "first order change of irradiance by a turn of the normal towards each axis"},
    {"footprint_turn_bend", Dtype::f32, "n,rgb,8", "lx/rad2", kFinite,
     "second order change of irradiance by a turn of the normal towards each axis"},
};
constexpr TensorRow kIndex[] = {
    {"index_box", Dtype::f64, "4", "m", kFinite, "lower corner and side of the root cell"},
    {"index_children", Dtype::u8, "cells", "1", kAny, "bit o tells whether octant o has a cell"},
    {"index_cells", Dtype::u32, "cells+1,2", "1", kAny, "number of the first child, and of the first entry"},
    {"index_entries", Dtype::u32, "entries", "1", kAny, "numbers of records, cell after cell"},
};
constexpr TensorRow kIrradianceChanges[] = {
    {"irradiance_change", Dtype::f32, "n,rgb", "lx/frame", kFinite, "change of the irradiance per frame"},
    {"rotation_gradient_change", Dtype::f32, "n,rgb,xyz", "lx/rad/frame", kFinite,
     "change of `rotation_gradient` per frame"},
    {"translation_gradient_change", Dtype::f32, "n,rgb,xyz", "lx/m/frame", kFinite,
     "change of `translation_gradient` per frame"},
};
constexpr TensorRow kFootprintChanges[] = {
    {"footprint_length_change", Dtype::f32, "n,8", "m/frame", kFinite,
     "change of `footprint_length` per frame", "f8"},
    {"footprint_slope_change", Dtype::f32, "n,rgb,8", "lx/frame", kFinite,
     "change of `footprint_slope` per frame"},
    {"footprint_bend_change", Dtype::f32, "n,rgb,8", "lx/frame", kFinite,
     "change of `footprint_bend` per frame"},
    {"footprint_turn_slope_change", Dtype::f32, "n,rgb,8", "lx/rad/frame", kFinite,
     "change of `footprint_turn_slope` per frame"},
    {"footprint_turn_bend_change", Dtype::f32, "n,rgb,8", "lx/rad2/frame", kFinite,
     "change of `footprint_turn_bend` per frame"},
};
constexpr TensorGroup kIrradianceGroups[] = {
    {always, "", kIrradiance},
    kSharedGroup,
    {optional, "With `--footprint adaptive` ([methods E](../methods.md#e)):", kFootprint},
    {optional,
     "Files of 65,536 records or more also hold an octree, so that a program that opens the file need not "
     "build one:",
     kIndex},
    kCausticGroup,
    kCausticFlightGroup,
    {always, "Only in parts of a run (`--part`):", kLeastRadius, FileForm::part},
    kLifeGroup,
    kAnchorGroup,
    kRadiusChangeGroup,
    {optional, "", kIrradianceChanges, FileForm::film},
    {optional, "With `--footprint adaptive`, unless the film was made with `--temporal-gradients none`:",
     kFootprintChanges, FileForm::film},
};

// --- radiance ---

constexpr CompactType kLightHalf{Dtype::f16, "light_scale"}, kChangeHalf{Dtype::f16, "change_scale"},
    kGradientByte{Dtype::i8, "2^gradient_exponent"},
    kGradientChangeByte{Dtype::i8, "2^gradient_change_exponent"};

constexpr TensorRow kRadiance[] = {
    {"position", Dtype::f32, "n,xyz", "m", kFinite, "place of the record"},
    {"frame", Dtype::f32, "n,2,xyz", "1", kFrame, "x axis and normal (z); y = z × x"},
    {"coefficients", Dtype::f32, "n,rgb,N^2", "cd/m2 sqrt(sr)", kFinite, "coefficients c_i of each colour",
     "", kLightHalf},
    {"stderr", Dtype::f32, "n,rgb,N", "cd/m2 sqrt(sr)", kFiniteNotNegative,
     "standard error of one coefficient of each band", "", kLightHalf},
    {"distance", Dtype::f32, "n", "m", kNotNegative, "mean distance to the surroundings", "a7 c6"},
    {"radius", Dtype::f32, "n", "m", kPositive,
     "radius R of the weight; a record serves points within accuracy × R"},
};
constexpr TensorRow kRadianceGradients[] = {
    {"gradient_x", Dtype::f32, "n,rgb,N^2", "cd/m2 sqrt(sr)/m", kFinite,
     "change of the coefficients per metre along x; absent where there is none", "", kGradientByte},
    {"gradient_y", Dtype::f32, "n,rgb,N^2", "cd/m2 sqrt(sr)/m", kFinite,
     "change of the coefficients per metre along y; absent where there is none", "", kGradientByte},
};
constexpr TensorRow kOrder[] = {
    {"order", Dtype::u8, "n", "1", kAny,
     "order of the record; absent where all orders are N; coefficients beyond a record's order are 0"},
};
constexpr TensorRow kRadianceFootprint[] = {
    {"footprint_length", Dtype::f32, "n,8", "m", kPositive,
     "length of each of eight axes, 45 degrees apart, the first along x of `frame`"},
};
constexpr TensorRow kRadianceFootprintChange[] = {
    {"footprint_length_change", Dtype::f32, "n,8", "m/frame", kFinite,
     "change of `footprint_length` per frame; absent with `--temporal-gradients none`", "f8"},
};
constexpr TensorRow kRadianceChanges[] = {
    {"coefficients_change", Dtype::f32, "n,rgb,N^2", "cd/m2 sqrt(sr)/frame", kFinite,
     "change of the coefficients per frame", "", kChangeHalf},
};
constexpr TensorRow kRadianceGradientChanges[] = {
    {"gradient_x_change", Dtype::f32, "n,rgb,N^2", "cd/m2 sqrt(sr)/m/frame", kFinite,
     "change of `gradient_x` per frame", "", kGradientChangeByte},
    {"gradient_y_change", Dtype::f32, "n,rgb,N^2", "cd/m2 sqrt(sr)/m/frame", kFinite,
     "change of `gradient_y` per frame", "", kGradientChangeByte},
};
constexpr TensorRow kLightScale[] = {
    {"light_scale", Dtype::f32, "n", "cd/m2 sqrt(sr)", kPositive,
     "unit of the record's `coefficients` and `stderr`, a power of two"},
};
constexpr TensorRow kGradientExponent[] = {
    {"gradient_exponent", Dtype::i8, "n,N", "1", kAny,
     "e of each band: 2^e cd/m2 sqrt(sr)/m is the unit of its `gradient_x` and `gradient_y`"},
};
constexpr TensorRow kChangeScale[] = {
    {"change_scale", Dtype::f32, "n", "cd/m2 sqrt(sr)/frame", kPositive,
     "unit of the record's `coefficients_change`, a power of two"},
};
constexpr TensorRow kGradientChangeExponent[] = {
    {"gradient_change_exponent", Dtype::i8, "n,N", "1", kAny,
     "e of each band: 2^e cd/m2 sqrt(sr)/m/frame is the unit of the changes of both gradients"},
};
constexpr TensorGroup kRadianceGroups[] = {
    {always, "", kRadiance},
    {optional, "", kRadianceGradients},
    {optional, "", kOrder},
    {optional, "", kRadianceChanges, FileForm::film},
    {optional, "", kRadianceGradientChanges, FileForm::film},
    {optional,
     "Files of `--store compact` hold coefficients, changes of coefficients and standard errors as half "
     "floats (F16), and gradients as signed bytes (I8). These numbers count units that belong to the record, "
     "or to one band of the record:",
     kLightScale},
    {optional, "", kGradientExponent},
    {optional, "", kChangeScale, FileForm::film},
    {optional, "", kGradientChangeExponent, FileForm::film},
    {optional, "With `--footprint adaptive` ([E8](../methods.md#e8)):", kRadianceFootprint},
    {optional, "", kRadianceFootprintChange, FileForm::film},
    kSharedGroup,
    kCausticGroup,
    kCausticFlightGroup,
    kLifeGroup,
    kAnchorGroup,
    kRadiusChangeGroup,
};

// --- lobes ---

constexpr TensorRow kLobes[] = {
    {"K.orders", Dtype::u8, "K.rows", "1", kAny, "lowest order that meets the error; 0: traced"},
    {"K.error", Dtype::f32, "K.rows", "1", kShare, "share of the lobe's energy that is left out"},
};
constexpr TensorRow kLobeCoefficients[] = {
    {"K.coefficients", Dtype::f32, "K.rows,K.i,rgb", "1/sqrt(sr)", kFinite,
     "coefficients of the cosine-weighted lobe; for isotropic materials only the coefficients with 0 ≤ m ≤ "
     "l; absent where all directions are traced"},
};
constexpr TensorGroup kLobeGroups[] = {{always, "", kLobes}, {optional, "", kLobeCoefficients}};

constexpr KindRow kKindRows[] = {
    {FileKind::photons, 1, ".photons", "phos-photons phos-merge",
     "photons where they landed, and a kd-tree over them (FLANN builds it)", "Photons", "", kPhotonGroups},
    {FileKind::irradiance, 1, ".irradiance", "phos-irradiance phos-temporal phos-merge", "irradiance records",
     "Irradiance records", "", kIrradianceGroups},
    {FileKind::radiance, 1, ".radiance", "phos-radiance phos-temporal",
     "radiance records: light by direction", "Radiance records",
     "N is the greatest order. The radiance that arrives from the direction w, in the record's frame, is the "
     "sum of c_i H_i(w) with i = l² + l + m. The H_i are orthonormal, with the Condon-Shortley phase.",
     kRadianceGroups},
    {FileKind::brdf, 1, ".brdf", "phos-brdf", "glossy lobes as hemispherical harmonics", "Lobes",
     "Each glossy material has one table, and K is the number of the material in the file. The table of an "
     "isotropic material has a row for each of `resolution` angles. The table of any other material has a "
     "row for each cell of the parabolic map.",
     kLobeGroups},
    {FileKind::image,
     1,
     ".exr",
     "phos-splat phos-reference phos-bands",
     "pictures with layers",
     "Pictures",
     "",
     {}},
};

}  // namespace

std::span<const KindRow> all_kinds() { return kKindRows; }

}  // namespace phos::inline file
