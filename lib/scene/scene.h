// A scene as the light sees it: world-space triangles, materials, luminaires, cameras, at one time.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "core/vector.h"
#include "scene/luminaire/fitting.h"
#include "scene/note.h"
#include "scene/opening/blind.h"
#include "scene/opening/portal.h"

namespace phos::inline scene {

class Environment;
class MerlBrdf;
class TransmittanceCurve;

/// Row 0 is at v = 0 (glTF). Texels are linear values, or the codes of an 8-bit image: a quarter of the
/// memory, and of the cache misses.
struct Texture {
  using Code = std::array<std::uint8_t, 4>;
  std::string name;
  int width = 0, height = 0;
  std::vector<Vec4> texels;
  std::vector<Code> codes;  ///< RGBA, used where `texels` is empty
  bool srgb = false;        ///< colours of `codes` are sRGB; else 0..255 stands for 0..1. Alpha always does
  std::size_t size() const { return texels.empty() ? codes.size() : texels.size(); }
  /// Linear value of texel i < size().
  Vec4 texel(std::size_t i) const;
  enum class Wrap : std::uint8_t { repeat, clamp, mirror };
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;  ///< magnification filter; else bilinear
  /// Bilinear at texture coordinates; finite for any finite uv.
  Vec4 at(const Vec2& uv) const;
};

/// A texture's use: which one, which coordinates, and its transform (KHR_texture_transform).
struct TextureUse {
  std::int32_t texture = -1;  ///< -1: none
  std::uint8_t set = 0;       ///< TEXCOORD_0 or _1
  Vec2 offset{0, 0}, scale{1, 1};
  float rotation_rad = 0;
  bool used() const { return texture >= 0; }
};

/// Reflection models. extras.phos of a glTF material gives the exact one; else metallic-roughness. Nothing
/// but the table in scene/material/models.h tells them apart: others ask it for properties.
enum class Model : std::uint8_t {
  metallic_roughness,  ///< glTF 2.0: Lambert + GGX, Schlick Fresnel
  lambert,             ///< kd
  phong,               ///< kd, ks, exponent; normalised lobe (n+2)/(2 pi) cos^n about the mirror direction
  ward,                ///< kd, ks, ax, ay
  plastic,             ///< kd under a rough dielectric coat: alpha (or ax, ay), ior
  conductor,           ///< f0, alpha (or ax, ay; 0: mirror-like)
  dielectric,          ///< smooth glass: ior
  thin_dielectric,     ///< smooth pane: ior, no bending
  mirror,              ///< ks
  measured,            ///< isotropic table in MERL layout
  oren_nayar,          ///< kd, sigma: rough matt surface (scene/material/oren_nayar.h)
};

struct Material {
  std::string name;
  Model model = Model::lambert;
  Rgb kd{
      0};  ///< diffuse reflectance, or base colour of metallic_roughness; multiplied by base_colour texture
  Rgb ks{0};  ///< specular reflectance (phong, ward, mirror) or f0 (conductor)
  float exponent = 1;
  float alpha_x = 0, alpha_y = 0;  ///< GGX or Ward roughness (alpha, not its root)
  float sigma_rad = 0;             ///< oren_nayar: standard deviation of the facets' slope angle
  float roughness = 1, metallic = 0;
  float ior = 1.5f;
  float specular = 1;      ///< KHR_materials_specular
  Rgb specular_colour{1};  ///< KHR_materials_specular
  float transmission = 0;  ///< KHR_materials_transmission; multiplied by the red of transmission_map
  /// Glass: factor on the light that passes a thin pane, or each face of a solid; multiplied by the
  /// base_colour texture.
  Rgb tint{1};
  /// thin_dielectric: internal transmittance of one passage along the normal; its transmittance is the
  /// pane's (scene/material/pane.h), or `curve` where there is one, times `tint`.
  Rgb inside{1};
  std::shared_ptr<const TransmittanceCurve> curve;
  /// dielectric: absorption inside, per m: light falls as exp(-absorption length); infinity: none
  /// passes.
  Rgb absorption_per_m{0};
  float thickness_m = 0;  ///< dielectric of KHR_materials_volume: of a sheet that encloses nothing
  /// Diffuse transmission of a thin sheet, Lambert's (KHR_materials_diffuse_transmission): share of the base
  /// that does not reflect but passes, and its colour; multiplied by the alpha of diffuse_transmission_map
  /// and by diffuse_transmission_colour_map. lambert: share times colour passes, and kd reflects whole.
  float diffuse_transmission = 0;
  Rgb diffuse_transmission_colour{1};
  /// KHR_materials_anisotropy: alpha along the tangent, turned by `anisotropy_rad` towards the bitangent, is
  /// mix(alpha, 1, anisotropy^2). The map's red and green hold a direction, its blue a factor of
  /// `anisotropy`.
  float anisotropy = 0, anisotropy_rad = 0;
  std::int32_t measured = -1;  ///< of Scene::measured
  TextureUse base_colour, metallic_roughness, normal, emissive, anisotropy_map, transmission_map,
      diffuse_transmission_map, diffuse_transmission_colour_map;
  float normal_scale = 1;
  Rgb emission{0};            ///< luminance, cd/m2; multiplied by the emissive texture
  bool double_sided = false;  ///< emission from both sides; reflection is two-sided always
  /// blend: alpha is the share of the surface that is there; the rest of the light passes straight.
  enum class Alpha : std::uint8_t { opaque, mask, blend };
  Alpha alpha_mode = Alpha::opaque;
  float alpha = 1, alpha_cutoff = 0.5f;
  std::string spectrum;  ///< file that extras.phos.spectrum names; read where light is computed in bands

  bool emits() const { return max_component(emission) > 0; }
  bool diffuse_alone() const;  ///< is it Lambert's, without any other lobe?
  bool anisotropic() const;    ///< does its reflection depend on where the tangent points?
  /// All that it may look up.
  std::array<TextureUse*, 8> texture_uses() {
    return {&base_colour,
            &metallic_roughness,
            &normal,
            &emissive,
            &anisotropy_map,
            &transmission_map,
            &diffuse_transmission_map,
            &diffuse_transmission_colour_map};
  }
  std::array<const TextureUse*, 8> texture_uses() const {
    return {&base_colour,
            &metallic_roughness,
            &normal,
            &emissive,
            &anisotropy_map,
            &transmission_map,
            &diffuse_transmission_map,
            &diffuse_transmission_colour_map};
  }
};

/// One placed mesh primitive: a contiguous run of triangles with one material.
struct Instance {
  std::string node;  ///< name of the glTF node ("node 7" where it has none), or OBJ group
  std::uint32_t material = 0;
  std::uint32_t first_triangle = 0, triangle_count = 0;
  Mat4 to_world{1};
  /// Of Scene::fitting: the luminous opening of a luminaire, which shines as its distribution says, not
  /// evenly. Its material is its own. -1: none.
  std::int32_t fitting = -1;
};

struct Triangle {
  std::uint32_t v[3];
};

/// A luminaire: the unit of power sharing. Angles in radians, directions point the way light travels.
struct Light {
  /// measured: from a point, by the distribution of a luminaire (fitting). One with an opening is an area.
  enum class Kind : std::uint8_t { area, point, spot, directional, environment, measured };
  Kind kind = Kind::point;
  std::string name;
  Vec3 position{0};
  Vec3 direction{0, 0, -1};  ///< measured: where the luminaire's down points
  /// point, spot: cd (on the axis). measured: cd in the brightest direction (filled by finalize).
  /// directional: lx on a plane facing it. Others: unused
  Rgb intensity{0};
  /// Spot cone, cosines of the half angles; glTF's smooth falloff. In double: in float no cone is thinner
  /// than 3e-4 rad.
  double cos_inner = 1, cos_outer = 0;
  std::uint32_t instance = 0;  ///< area: which instance shines
  float area_m2 = 0;           ///< area: one side
  std::int32_t fitting = -1;   ///< of Scene::fitting: measured, or area (then its instance's); -1: none
  Rgb flux_lm{0};  ///< total emitted; directional, environment: through the scene's bounding disc (filled by
                   ///< finalize)
  /// Has an extent as seen from a point, so that more than one sample is worth while; else it lights
  /// from a single direction.
  bool extended() const { return kind == Kind::area || kind == Kind::environment; }
};

struct Camera {
  std::string name;
  Mat4 to_world{1};  ///< looks along -z, +y up (glTF)
  bool perspective = true;
  float yfov_rad = 0.8f;  ///< vertical
  float ymag_m = 1;       ///< orthographic: half the height
  float aspect = 1;       ///< of the file; an image's own width/height wins
  /// World ray through image coordinates in [0,1]^2, (0,0) = top left. Direction is unit.
  struct Ray {
    Vec3 origin, direction;
  };
  Ray ray(const Vec2& st, float image_aspect) const;
  /// Clip-space matrix for GL (depth range from near_m to far_m).
  Mat4 view_projection(float image_aspect, float near_m, float far_m) const;
};

struct Animation {
  std::string name;
  double start_s = 0, end_s = 0;
  std::vector<std::string> targets;  ///< "node lamp translation", ...
};

/// What the components of Rgb are: red, green and blue (number 0), or one of the triplets of so many bands
/// of wavelength (scene/spectral/bands.h).
struct BandTriplet {
  int number = 0, triplet = 0;
  bool operator==(const BandTriplet&) const = default;
};

class PortalSight;

struct Scene {
  std::string path;
  /// Place in the world that all coordinates here, and in files made from them, are counted from, m. Zero for
  /// scenes near the world's origin (core/origin.h); loaders choose it, the same at every time of an
  /// animation.
  DVec3 origin_m{0};
  // Per vertex, world axes, from origin_m.
  std::vector<Vec3> position;
  std::vector<Vec3> normal;    ///< unit shading normals
  std::vector<Vec2> uv0, uv1;  ///< empty, or one per vertex
  std::vector<Vec4> tangent;   ///< empty, or xyz + handedness
  std::vector<Vec4> colour;    ///< COLOR_0, linear; empty where no vertex has one
  // Per triangle.
  std::vector<Triangle> triangle;
  std::vector<std::uint32_t> triangle_instance;
  std::vector<Instance> instance;
  std::vector<Material> material;
  std::vector<Texture> texture;
  std::vector<std::shared_ptr<const MerlBrdf>> measured;
  std::vector<Light> light;
  std::vector<Fitting> fitting;
  std::shared_ptr<const Environment> environment;  ///< null: black. One of the lights stands for it
  std::vector<Portal> portal;  ///< openings through which its light is looked for and sent
  std::shared_ptr<const PortalSight> portal_sight;  ///< of them; null: not known
  std::vector<Blind> blind;                         ///< before the sky, found where portals are looked for
  std::vector<Camera> camera;
  std::vector<Animation> animation;
  double time_s = 0;
  double frames_per_s = 24;
  BandTriplet bands;
  std::map<std::string, std::string> light_spectrum;  ///< as Material::spectrum, by the light's name
  std::int64_t frames = 0;     ///< of scenes[0].extras.animation, or from the longest animation
  std::vector<Note> warnings;  ///< parts that the loader mended, ignored or replaced
  std::map<std::string, std::uint64_t> events;  ///< degenerate triangles dropped, normals made, ...
  // Filled by finalize().
  Bounds bounds;
  std::string hash;  ///< of everything that changes the light (not cameras, not names)
  Json parts;        ///< {"geometry":hash,"materials":hash,"lights":hash,"time":s,"nodes":{name:hash}};
               ///< "environment":hash, "luminaires":hash (of their distributions), "origin_m":[x,y,z] and
               ///< "bands":{"number":n,"triplet":k} where there are any

  const Material& material_of(std::uint32_t tri) const {
    return material[instance[triangle_instance[tri]].material];
  }
};

/// Completes a scene whose geometry, materials, punctual lights and cameras are set: makes absent normals,
/// area lights from emitting instances, fluxes, surfaces of luminous openings and their mean luminance,
/// bounds, hash and parts. Throws Error(bad_input) for indices out of range or non-finite positions. Loader
/// and tests use it alike.
void finalize(Scene& scene);

/// Geometric normal by winding (unit; zero for a degenerate triangle) and area in m2.
Vec3 geometric_normal(const Scene& scene, std::uint32_t tri);
float area_m2(const Scene& scene, std::uint32_t tri);
/// Radius of the smallest sphere about the centre of the bounds, m.
float bounding_radius_m(const Scene& scene);

}  // namespace phos::inline scene
