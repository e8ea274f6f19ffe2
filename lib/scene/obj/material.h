// Materials of Wavefront .mtl.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/obj/coverage_texture.h"
#include "scene/obj/mtl_statements.h"
#include "scene/scene.h"
#include "scene/texture/load_textures.h"

namespace tinyobj {
struct material_t;
struct texture_option_t;
}  // namespace tinyobj

namespace phos::inline scene {

/// Path of a file that an .obj or its .mtl names; names may hold backslashes from other systems.
std::string obj_file(const std::string& obj_path, std::string name);
/// Its bytes, nothing where it cannot be read.
std::optional<std::string> read_if_there(const std::string& path);

/// How statements are read. Ke is a luminance in cd/m2.
///
///   illum 4, 6, 7, 9 with Ni above 1 (6, 7, 9: or with a Tf), and d absent, 1 or 0: smooth glass. A sheet is
///   a
///     thin pane that passes Tf times the light that a pane of index Ni passes; a closed solid refracts, and
///     each face passes the root of Tf. Kd, Ks and map_Kd are not used. (Some modellers write Ni 1 beside
///     illum 4 for every opaque material.)
///   d, 1 - Tr, map_d: the share of the surface that is there; the rest of the light passes straight,
///   untinted.
///     map_d is the image's alpha where it has one, else its luminance (or the channel that -imfchan names),
///     times d.
///   illum 3, 5, 8 with Ks, and Ns absent or from 900 on: Kd beside a mirror of reflectance Ks at every
///   angle. illum 2 and above with Ks and Ns: a normalised Phong lobe; else Lambert.
///
/// Ka and map_Ka stand for light from all around, which phos computes. What is not modelled is said in
/// scene.warnings, once for each statement.
class ObjMaterials {
 public:
  explicit ObjMaterials(Scene& scene) : scene_(scene) {}

  /// Appends one to scene.material.
  void add(const tinyobj::material_t& from, const MtlStatements& said);
  /// After the last: reads the textures, and tells of statements that are not modelled.
  void finish();

  /// Is it glass, whose sheets and solids differ? As added, a solid.
  bool is_glass(std::uint32_t material) const { return glass_.contains(material); }
  /// Makes a thin pane of a glass.
  static void make_thin(Material& glass);

 private:
  struct Coverage {
    std::uint32_t material;
    std::int32_t texture;  ///< index of the pool
    CoverageOf channel;
    TextureUse use;
  };

  void warn(const std::string& material, const std::string& what);
  TextureUse texture(const std::string& name, const tinyobj::texture_option_t& option, bool srgb);
  void read_reflection(const tinyobj::material_t& from, const MtlStatements& said, Material& m);
  void read_transparency(const tinyobj::material_t& from, const MtlStatements& said, Material& m);
  bool read_glass(const MtlStatements& said, double share, Material& m);
  void note_unread(const MtlStatements& said);
  void join_coverage(const std::vector<std::int32_t>& place);

  Scene& scene_;
  TexturePool textures_;
  std::vector<Coverage> coverage_;
  std::set<std::uint32_t> glass_;
  std::map<std::string, std::vector<std::string>> unread_;  ///< faults, by statement: materials
};

}  // namespace phos::inline scene
