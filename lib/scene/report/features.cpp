#include "scene/report/features.h"

#include <algorithm>
#include <array>

#include "core/error.h"

namespace phos::inline scene {
namespace {

using enum Feature::Group;
using enum Feature::State;
constexpr auto kInfo = Note::Level::info;
constexpr auto kWarning = Note::Level::warning;

constexpr Feature kFeatures[] = {
    {property, "asset.version", modelled, "2.x; 1.0 is refused"},
    {property, "asset.copyright, asset.generator, asset.minVersion", no_effect, ""},
    {property, "name, extras (of anything)", in_part,
     "is read where it names materials, nodes, lights, cameras and meshes; of extras only extras.phos and "
     "scenes[].extras.animation",
     kInfo},
    {property, "extensionsUsed, extensionsRequired", modelled,
     "each that is not modelled is told; a required one is refused unless this page says otherwise"},
    {property, "scene", modelled, "without it the first scene"},
    {property, "scenes[].nodes", in_part, "is read of the default scene alone", kInfo},
    {property, "nodes[].children, .matrix, .translation, .rotation, .scale", modelled, ""},
    {property, "nodes[].mesh, .camera, .skin, .weights", modelled, ""},
    {property, "meshes[].weights, .primitives[].targets POSITION and NORMAL", modelled, ""},
    {property, "meshes[].primitives[].targets TANGENT", no_effect, "tangents stay those of the base mesh"},
    {property, "meshes[].primitives[].targets TEXCOORD_n and COLOR_n", told, "is ignored: they do not move"},
    {property, "meshes[].primitives[].mode 4, 5, 6 (triangles, strips, fans)", modelled, ""},
    {property, "meshes[].primitives[].mode 0 to 3 (points, lines)", told,
     "is left out: points and lines give no surface", kInfo},
    {property, "meshes[].primitives[].indices, .material", modelled,
     "without a material grey Lambert, kd 0.5, stands in for glTF's white metal, and is told"},
    {property, "attributes POSITION, NORMAL, TANGENT, TEXCOORD_0, TEXCOORD_1", modelled, ""},
    {property, "attributes TEXCOORD_2 and above", told,
     "is not read: TEXCOORD_0 is used where a texture asks for it"},
    {property, "attributes COLOR_0", modelled, "linear factor of the base colour, and of alpha"},
    {property, "attributes COLOR_1 and above", told, "is ignored: what it means is the application's", kInfo},
    {property, "attributes JOINTS_0, WEIGHTS_0", modelled, ""},
    {property, "attributes JOINTS_1, WEIGHTS_1 and above", told,
     "is ignored: four joints move a vertex at most"},
    {property, "attributes _ANYTHING (application-specific)", no_effect, ""},
    {property,
     "accessors[].bufferView, .byteOffset, .componentType, .normalized, .count, .type, .sparse (all of it)",
     modelled, ""},
    {property, "accessors[].min, .max", no_effect, "bounds are those of the vertices"},
    {property, "bufferViews[].buffer, .byteOffset, .byteLength, .byteStride", modelled, ""},
    {property, "bufferViews[].target", no_effect, ""},
    {property, "buffers[].uri, .byteLength", modelled, "beside the scene, embedded, or the binary chunk"},
    {property, "images[].uri, .bufferView", modelled,
     "PNG, JPEG, BMP, TGA; another kind, or one that is not there, is told, and the factor is used"},
    {property, "images[].mimeType", no_effect, "the kind is told from the content"},
    {property, "textures[].source, .sampler", modelled, ""},
    {property, "samplers[].magFilter, .wrapS, .wrapT", modelled, ""},
    {property, "samplers[].minFilter", no_effect, "texels are looked up, not averaged"},
    {property, "materials[].pbrMetallicRoughness.baseColorFactor, .baseColorTexture", modelled, ""},
    {property, "materials[].pbrMetallicRoughness.metallicFactor", modelled,
     "without it 1, as glTF says; where paint seems to be meant, it is told; 0 for glass"},
    {property, "materials[].pbrMetallicRoughness.roughnessFactor, .metallicRoughnessTexture", modelled, ""},
    {property, "materials[].normalTexture, .scale", modelled, ""},
    {property, "materials[].occlusionTexture, .strength", told,
     "is not used: how surfaces hide each other is computed", kInfo},
    {property, "materials[].emissiveFactor, .emissiveTexture", modelled, "luminance, cd/m2"},
    {property, "materials[].alphaMode, .alphaCutoff", modelled, ""},
    {property, "materials[].doubleSided", modelled, "of emission; reflection is of both sides always"},
    {property, "textureInfo.index, .texCoord", modelled, "texCoord 0 and 1"},
    {property, "cameras[].type, .perspective.yfov, .aspectRatio, .orthographic.xmag, .ymag", modelled, ""},
    {property, "cameras[].perspective and .orthographic .znear, .zfar", no_effect, "nothing is clipped"},
    {property, "skins[].joints, .inverseBindMatrices", modelled, ""},
    {property, "skins[].skeleton", no_effect, ""},
    {property, "animations[].channels[], .target.node, .target.path", modelled,
     "all animations at once, at --time or --frame; an unknown path is told"},
    {property, "animations[].samplers[].input, .output, .interpolation", modelled,
     "STEP, LINEAR, CUBICSPLINE"},

    {extension, "KHR_accessor_float64", told, "is not read", kWarning, ""},
    {extension, "KHR_animation_pointer", in_part,
     "moves light intensity, colour and cone angles, emissive factor and strength, visibility and node "
     "transforms; another target is told"},
    {extension, "KHR_audio_emitter", told, "is ignored: it is sound", kInfo, "", true},
    {extension, "KHR_draco_mesh_compression", told, "is not read: the uncompressed accessors are", kInfo, ""},
    {extension, "KHR_gaussian_splatting", told, "is ignored: its points give no surface", kWarning, ""},
    {extension, "KHR_interactivity", told, "is ignored: the scene is as it starts", kInfo, "", true},
    {extension, "KHR_lights_punctual", in_part, "has all but the lights' range", kWarning, "-"},
    {extension, "KHR_lights_punctual range", told,
     "is ignored: light falls with the square of the distance and ends nowhere"},
    {extension, "KHR_materials_anisotropy", modelled, ""},
    {extension, "KHR_materials_clearcoat", in_part,
     "is modelled in part: the coat takes the place of the base's gloss, or is added to its reflectance; its "
     "textures are not read",
     kWarning, "clearcoatFactor"},
    {extension, "KHR_materials_diffuse_transmission", modelled, ""},
    {extension, "KHR_materials_dispersion", told, "is ignored: light of all colours is refracted alike",
     kWarning, "dispersion"},
    {extension, "KHR_materials_emissive_strength", modelled, ""},
    {extension, "KHR_materials_ior", modelled, ""},
    {extension, "KHR_materials_iridescence", told, "is ignored: the thin film gives no colour", kWarning,
     "iridescenceFactor"},
    {extension, "KHR_materials_pbrSpecularGlossiness", told,
     "is ignored: the metallic-roughness values are used", kWarning, ""},
    {extension, "KHR_materials_sheen", in_part,
     "is modelled in part: the mean of what it reflects is added, evenly in all directions; its textures are "
     "not read",
     kWarning, "sheenColorFactor"},
    {extension, "KHR_materials_specular", in_part,
     "is modelled in part: specularTexture and specularColorTexture are not read", kWarning,
     "specularTexture,specularColorTexture"},
    {extension, "KHR_materials_transmission", in_part,
     "passes light straight, as a thin sheet or solid glass; rough glass does not scatter what it passes, "
     "and that is told"},
    {extension, "KHR_materials_unlit", told, "is ignored: it is lit like others", kWarning, "", true},
    {extension, "KHR_materials_variants", told, "is ignored: the materials of the meshes themselves are used",
     kInfo, "", true},
    {extension, "KHR_materials_volume", in_part, "is modelled in part: thicknessTexture is not read",
     kWarning, "thicknessTexture"},
    {extension, "KHR_materials_volume_scatter", told, "is ignored: light goes straight inside", kWarning, ""},
    {extension, "KHR_mesh_quantization", modelled, ""},
    {extension, "KHR_meshopt_compression", told, "is not read: the uncompressed buffer is", kInfo, ""},
    {extension, "KHR_node_hoverability", told, "is ignored: it is for viewers", kInfo, "", true},
    {extension, "KHR_node_selectability", told, "is ignored: it is for viewers", kInfo, "", true},
    {extension, "KHR_node_visibility", modelled,
     "meshes and lights of a node that is hidden, and of all below it, are left out; cameras stay"},
    {extension, "KHR_physics_rigid_bodies", told, "is ignored: bodies stay where they are", kInfo, "", true},
    {extension, "KHR_techniques_webgl", told, "is ignored: it is a shader", kWarning, ""},
    {extension, "KHR_texture_basisu", told, "is not read: the texture's other source is", kInfo, ""},
    {extension, "KHR_texture_transform", modelled, ""},
    {extension, "KHR_xmp", told, "is ignored: it is metadata", kInfo, "", true},
    {extension, "KHR_xmp_json_ld", told, "is ignored: it is metadata", kInfo, "", true},
    {extension, "EXT_instance_features", told, "is ignored: it is metadata", kInfo, "", true},
    {extension, "EXT_lights_ies", modelled, ""},
    {extension, "EXT_lights_image_based", told, "is ignored: give the map as --environment", kWarning, ""},
    {extension, "EXT_mesh_features", told, "is ignored: it is metadata", kInfo, "", true},
    {extension, "EXT_mesh_gpu_instancing", modelled,
     "each copy is \"node[k]\"; those that emit are lamps each"},
    {extension, "EXT_mesh_manifold", told, "is ignored: the mesh is read as it stands", kInfo, "", true},
    {extension, "EXT_meshopt_compression", told, "is not read: the uncompressed buffer is", kInfo, ""},
    {extension, "EXT_structural_metadata", told, "is ignored: it is metadata", kInfo, "", true},
    {extension, "EXT_texture_avif", told, "is not read: the texture's other source is", kInfo, ""},
    {extension, "EXT_texture_webp", told, "is not read: the texture's other source is", kInfo, ""},
    {extension, "CESIUM_primitive_outline", told, "is ignored: it is lines", kInfo, "", true},
    {extension, "GODOT_single_root", told, "is ignored: it is for editors", kInfo, "", true},
    {extension, "MSFT_lod", told, "is ignored: the finest level is read", kInfo, "", true},
    {extension, "MSFT_texture_dds", told, "is not read: the texture's other source is", kInfo, ""},
    {extension, "any other", told, "is not known, and is ignored"},

    {obj, "v, vt, vn, f", modelled, "polygons are cut into triangles"},
    {obj, "v with colours", told, "is read as a place alone", kInfo},
    {obj, "o, g", modelled, "names"},
    {obj, "s", modelled, "smooth normals where the file has none"},
    {obj, "usemtl, mtllib", modelled, "a material file that is not there is told"},
    {obj, "l, p", told, "is left out: lines and points have no surface", kInfo},
    {obj, "vp, cstype, curv, surf and other free forms", told, "is not read"},
    {obj, "ROOM.lights.json beside ROOM.obj", modelled, "lights and cameras, which OBJ does not have"},

    {mtl, "newmtl", modelled, ""},
    {mtl, "Kd, map_Kd", modelled, "a map stands in for a Kd of 0"},
    {mtl, "Ks, Ns", modelled, "a normalised Phong lobe, where illum is 2 or more"},
    {mtl, "map_Ks, map_Ns", told, "is not read: Ks and Ns hold all over"},
    {mtl, "Ke, map_Ke", modelled, "luminance, cd/m2"},
    {mtl, "Ka, map_Ka", no_effect, "ambient light is computed"},
    {mtl, "d, Tr", modelled, "the share of the surface that is there; what is not lets light pass straight"},
    {mtl, "map_d", modelled, "the same by texel"},
    {mtl, "Tf", modelled, "the tint of glass"},
    {mtl, "Ni", modelled, "refractive index of glass"},
    {mtl, "illum", modelled, "0 to 2 diffuse and gloss, 3, 5 and 8 mirrors, 4, 6, 7 and 9 glass"},
    {mtl, "norm", modelled, ""},
    {mtl, "bump, map_Bump, disp", told, "is not read: surfaces are smooth"},
    {mtl, "refl, decal, sharpness", told, "is not read"},
    {mtl, "Pr, Pm, Ps, Pc, Pcr, aniso, anisor and their maps", told, "is not read: Kd, Ks and Ns are"},
};

std::string_view word(Feature::State state) {
  constexpr std::array<std::string_view, 4> kWords = {"modelled", "in part, told", "told", "no effect"};
  return kWords[static_cast<std::size_t>(state)];
}

std::string table(Feature::Group group, const char* title, const char* what) {
  std::string out = text("### ", title, "\n\n| ", what, " | state | what phos does |\n|---|---|---|\n");
  for (const Feature& f : scene_features()) {
    if (f.group != group) continue;
    const bool warned =
        f.level == kWarning && (f.state == told || (f.state == in_part && f.group == extension));
    out += text("| ", f.name, " | ", word(f.state), warned ? " (warning)" : "", " | ", f.sentence, " |\n");
  }
  return out + "\n";
}

}  // namespace

std::span<const Feature> scene_features() { return kFeatures; }

const Feature* find_extension(std::string_view name) {
  const Feature* at = std::find_if(std::begin(kFeatures), std::end(kFeatures),
                                   [&](const Feature& f) { return f.group == extension && f.name == name; });
  return at == std::end(kFeatures) ? nullptr : at;
}

bool can_be_required(std::string_view name) {
  const Feature* f = find_extension(name);
  return f && (f->state == modelled || f->state == in_part || f->may_be_required);
}

std::string told(const Feature& feature) { return text(feature.name, " ", feature.sentence); }

std::string feature_tables() {
  return table(property, "glTF 2.0", "property") + table(extension, "Extensions", "extension") +
         table(obj, "OBJ", "statement") + table(mtl, "MTL", "statement");
}

}  // namespace phos::inline scene
