#include "scene/obj/load.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/origin.h"
#include "core/text/line.h"
#include "file/atomic_file.h"
#include "file/lfs_pointer.h"
#include "scene/gltf/uri.h"
#include "scene/load_mesh.h"
#include "scene/obj/lights.h"
#include "scene/obj/material.h"
#include "scene/obj/solid_parts.h"

namespace phos::inline scene {
namespace {

/// What tinyobjloader does not tell of a file.
struct ObjText {
  std::vector<DVec3> vertices;                ///< their places as the file states them
  std::map<std::string, std::size_t> unread;  ///< how often statements stand there that are not read
};

/// tinyobjloader reads a number it cannot parse, "nan" among them, as 0; such a vertex must not pass for a
/// good one.
ObjText check_text(const std::string& path, std::string_view bytes) {
  static const std::set<std::string_view> kRead = {"f", "l",  "p",  "g",      "o",     "s",
                                                   "v", "vt", "vn", "usemtl", "mtllib"};
  constexpr std::size_t kMostKeywords = 16;
  ObjText found;
  std::vector<DVec3>& vertices = found.vertices;
  constexpr std::string_view kBlank = " \t\r";
  for (std::size_t line = 1; !bytes.empty(); ++line) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    std::string_view rest = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    const auto next_word = [&] {
      rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size()));
      const std::string_view word = rest.substr(0, rest.find_first_of(kBlank));
      rest.remove_prefix(word.size());
      return word;
    };
    const std::string_view keyword = next_word();
    const bool named = !keyword.empty() && std::isalpha(static_cast<unsigned char>(keyword[0])) != 0;
    if (named && !kRead.contains(keyword)) {
      const std::string name(keyword);
      if (found.unread.size() < kMostKeywords || found.unread.contains(name)) ++found.unread[name];
    }
    if (keyword != "v") continue;
    DVec3& vertex = vertices.emplace_back(0);
    for (int k = 0; k < 3; ++k) {
      std::string_view word = next_word();
      if (!word.empty() && word.front() == '+') word.remove_prefix(1);
      double& value = vertex[k];
      const auto [stop, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
      const bool whole = stop == word.data() + word.size();
      if (problem == std::errc() && whole && std::isfinite(static_cast<float>(value))) continue;
      throw Error(ExitCode::bad_input, path,
                  text("line ", line, ": a vertex needs three finite numbers; mend it in the modeller"));
    }
  }
  return found;
}

/// Hands tinyobjloader the text of each mtllib, from beside the .obj only.
class MtlReader : public tinyobj::MaterialReader {
 public:
  explicit MtlReader(std::string obj_path) : obj_path_(std::move(obj_path)) {}
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* map, std::string* warning, std::string* error) override {
    const std::optional<std::string> bytes = read_if_there(obj_file(obj_path_, name));
    if (!bytes) {
      missing.push_back(name);
      return false;
    }
    if (is_lfs_pointer(*bytes)) {
      missing.push_back(text(name, " is ", kLfsPointer));
      return false;
    }
    std::istringstream stream(*bytes);
    stream.exceptions(std::ios::badbit);  // for want of memory
    tinyobj::LoadMtl(map, materials, &stream, warning, error);
    for (MtlStatements& s : mtl_statements(*bytes)) said.push_back(std::move(s));
    said.resize(materials->size());  // a library without any newmtl gives one without a name
    return true;
  }
  std::vector<std::string> missing;
  std::vector<MtlStatements> said;  ///< by material

 private:
  std::string obj_path_;
};

class ObjReader {
 public:
  explicit ObjReader(Scene& scene) : scene_(scene), obj_materials_(scene) {}

  void read(std::string_view bytes) {
    ObjText obj = check_text(scene_.path, bytes);
    MtlReader mtl(scene_.path);
    std::istringstream stream{std::string(bytes)};
    stream.exceptions(std::ios::badbit);  // for want of memory
    std::string warning, error;
    const bool read =
        tinyobj::LoadObj(&attrib_, &shapes_, &materials_, &warning, &error, &stream, &mtl, true, false);
    if (!read || attrib_.vertices.empty()) {
      const std::string why = one_line(error);
      throw Error(ExitCode::bad_input, scene_.path,
                  why.empty()
                      ? "is neither glTF nor OBJ: it holds no vertices; give a .glb, .gltf or .obj scene"
                      : text("is not a valid OBJ: ", why, "; export it again"));
    }
    for (const std::string& name : mtl.missing)
      scene_.warnings.emplace_back("material file not found: " + name);
    for (const auto& [keyword, n] : obj.unread)
      scene_.warnings.emplace_back(text("statement \"", keyword, "\", ", n, " times, is not read"));
    choose_origin(std::move(obj.vertices));
    mtl.said.resize(materials_.size());
    for (std::size_t i = 0; i < materials_.size(); ++i) obj_materials_.add(materials_[i], mtl.said[i]);
    obj_materials_.finish();
    tell_sheets_from_solids();
    for (std::size_t i = 0; i < shapes_.size(); ++i) add_shape(shapes_[i], i);
    if (skipped_)
      scene_.warnings.emplace_back(Note::Level::info, "loader", "", "",
                                   text(skipped_, " lines and points are left out: they have no surface"));
  }

 private:
  enum class GlassFace : std::uint8_t { sheet, solid, inside_out };

  /// Far from the world's origin floats of tinyobjloader are coarse: the file's own numbers stand in.
  void choose_origin(std::vector<DVec3> vertices) {
    if (3 * vertices.size() != attrib_.vertices.size()) return;
    DBounds world;
    for (const DVec3& p : vertices) world.include(p);
    scene_.origin_m = suitable_origin_m(world);
    for (std::size_t i = 0; i < vertices.size() && scene_.origin_m != DVec3(0); ++i) {
      const Vec3 p = from_world(vertices[i], scene_.origin_m);
      for (int c = 0; c < 3; ++c) attrib_.vertices[3 * i + static_cast<std::size_t>(c)] = p[c];
    }
  }

  /// Sheets of glass are thin panes; closed parts are solid, wherever the file splits them.
  void tell_sheets_from_solids() {
    for (std::size_t m = 0; m < materials_.size(); ++m) {
      const auto index = static_cast<std::uint32_t>(m);
      if (!obj_materials_.is_glass(index)) continue;
      std::vector<std::pair<std::size_t, std::size_t>> faces;  // shape, face
      std::vector<Vec3> corners;
      for (std::size_t s = 0; s < shapes_.size(); ++s)
        for (std::size_t f = 0; f < shapes_[s].mesh.material_ids.size(); ++f)
          if (shapes_[s].mesh.material_ids[f] == static_cast<int>(m) && add_corners(shapes_[s], f, corners))
            faces.emplace_back(s, f);
      const SolidParts parts = find_solid_parts(corners);
      bool sheets = false, solids = false;
      for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto& [s, f] = faces[i];
        std::vector<GlassFace>& kinds = glass_face_[s];
        kinds.resize(shapes_[s].mesh.material_ids.size());
        kinds[f] = !parts.closed[i]      ? GlassFace::sheet
                   : parts.inside_out[i] ? GlassFace::inside_out
                                         : GlassFace::solid;
        (parts.closed[i] ? solids : sheets) = true;
      }
      if (!sheets) continue;
      sheet_of_[index] = index;
      if (solids) {
        sheet_of_[index] = static_cast<std::uint32_t>(scene_.material.size());
        scene_.material.push_back(Material(scene_.material[m]));
      }
      ObjMaterials::make_thin(scene_.material[sheet_of_[index]]);
    }
  }

  /// False, and nothing added: an index is out of range, which add_vertex tells of.
  bool add_corners(const tinyobj::shape_t& shape, std::size_t face, std::vector<Vec3>& corners) const {
    if (3 * face + 3 > shape.mesh.indices.size()) return false;
    Vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = shape.mesh.indices[3 * face + k].vertex_index;
      if (v < 0 || static_cast<std::size_t>(v) >= attrib_.vertices.size() / 3) return false;
      for (int c = 0; c < 3; ++c)
        p[k][c] = static_cast<float>(
            attrib_.vertices[3 * static_cast<std::size_t>(v) + static_cast<std::size_t>(c)]);
    }
    corners.insert(corners.end(), p, p + 3);
    return true;
  }

  GlassFace glass_face(std::size_t shape, std::size_t face) const {
    const auto found = glass_face_.find(shape);
    return found == glass_face_.end() || face >= found->second.size() ? GlassFace::sheet
                                                                      : found->second[face];
  }

  std::uint32_t material_of(int index) {
    if (index >= 0 && static_cast<std::size_t>(index) < materials_.size())
      return static_cast<std::uint32_t>(index);
    if (!default_material_) {
      default_material_ = static_cast<std::uint32_t>(scene_.material.size());
      Material m;
      m.name = "default";
      m.kd = Rgb(0.5f);
      scene_.material.push_back(m);
      scene_.warnings.emplace_back(Note::Level::info, "loader", "", "",
                                   "some faces have no material: they are read as grey Lambert, kd 0.5");
    }
    return *default_material_;
  }

  /// One instance per material of a shape (two of glass, where some parts are solid); vertices joined where
  /// position, normal and texture coordinates agree.
  void add_shape(const tinyobj::shape_t& shape, std::size_t index) {
    skipped_ += shape.lines.num_line_vertices.size() + shape.points.indices.size();
    std::map<std::pair<int, bool>, std::vector<std::size_t>> faces;  // by material; is it solid glass?
    const std::size_t n = shape.mesh.indices.size() / 3;
    for (std::size_t f = 0; f < n; ++f) {
      const int material = f < shape.mesh.material_ids.size() ? shape.mesh.material_ids[f] : -1;
      faces[{material, glass_face(index, f) != GlassFace::sheet}].push_back(f);
    }
    const std::string name = shape.name.empty() ? text("shape ", index) : shape.name;
    for (const auto& [key, list] : faces) {
      std::uint32_t m = material_of(key.first);
      if (const auto sheet = sheet_of_.find(m); sheet != sheet_of_.end() && !key.second) m = sheet->second;
      add_instance(scene_, mesh_of(shape, index, list, name), glm::dmat4(1), name, m,
                   scene_.material[m].normal.used(), "group \"" + name + "\"");
    }
  }

  MeshData mesh_of(const tinyobj::shape_t& shape, std::size_t index, const std::vector<std::size_t>& faces,
                   const std::string& name) {
    MeshData mesh;
    std::map<std::array<int, 4>, std::uint32_t> known;
    bool has_normals = false, has_uv = false, smooth = false;
    const auto group = [&](std::size_t f) {
      const auto& groups = shape.mesh.smoothing_group_ids;
      return f < groups.size() ? groups[f] : 0u;
    };
    for (const std::size_t f : faces) {
      smooth |= group(f) != 0;
      for (std::size_t k = 0; k < 3; ++k) {
        has_normals |= shape.mesh.indices[3 * f + k].normal_index >= 0;
        has_uv |= shape.mesh.indices[3 * f + k].texcoord_index >= 0;
      }
    }
    for (const std::size_t f : faces) {
      Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) {
        const tinyobj::index_t& i = shape.mesh.indices[3 * f + k];
        // Faces of a smoothing group share normals; a face of none keeps its own.
        const unsigned shared_by = has_normals || !smooth ? 0
                                   : group(f)             ? 2 * group(f)
                                                          : 2 * static_cast<unsigned>(f) + 1;
        const auto [it, fresh] =
            known.try_emplace({i.vertex_index, i.normal_index, i.texcoord_index, static_cast<int>(shared_by)},
                              static_cast<std::uint32_t>(mesh.position.size()));
        if (fresh) add_vertex(mesh, i, has_normals || smooth, has_uv, name);
        t.v[k] = it->second;
      }
      if (glass_face(index, f) == GlassFace::inside_out) std::swap(t.v[1], t.v[2]);
      mesh.triangle.push_back(t);
    }
    return mesh;
  }

  void add_vertex(MeshData& mesh, const tinyobj::index_t& i, bool has_normals, bool has_uv,
                  const std::string& name) {
    const auto in = [&](int index, std::size_t floats, std::size_t width, const char* what) {
      if (index < 0 || static_cast<std::size_t>(index) >= floats / width) {
        throw Error(ExitCode::bad_input, scene_.path,
                    text("group \"", name, "\": ", what, " index ", index + 1, " is out of range; there are ",
                         floats / width, "; export the scene again"));
      }
      return width * static_cast<std::size_t>(index);
    };
    const std::size_t p = in(i.vertex_index, attrib_.vertices.size(), 3, "vertex");
    const auto at = [](const std::vector<tinyobj::real_t>& v, std::size_t k) {
      return static_cast<float>(v[k]);
    };
    mesh.position.emplace_back(at(attrib_.vertices, p), at(attrib_.vertices, p + 1),
                               at(attrib_.vertices, p + 2));
    if (has_normals) {
      Vec3 normal(0);  // made from the faces later
      if (i.normal_index >= 0) {
        const std::size_t k = in(i.normal_index, attrib_.normals.size(), 3, "normal");
        normal = {at(attrib_.normals, k), at(attrib_.normals, k + 1), at(attrib_.normals, k + 2)};
      }
      mesh.normal.push_back(normal);
    }
    if (has_uv) {
      Vec2 uv(0);
      if (i.texcoord_index >= 0) {
        const std::size_t k = in(i.texcoord_index, attrib_.texcoords.size(), 2, "texture");
        uv = {at(attrib_.texcoords, k), 1 - at(attrib_.texcoords, k + 1)};  // OBJ counts rows from below
      }
      mesh.uv0.push_back(uv);
    }
    if (!attrib_.colors.empty() && attrib_.colors.size() == attrib_.vertices.size()) {
      mesh.colour.emplace_back(at(attrib_.colors, p), at(attrib_.colors, p + 1), at(attrib_.colors, p + 2),
                               1.0f);
    }
  }

  Scene& scene_;
  ObjMaterials obj_materials_;
  std::map<std::uint32_t, std::uint32_t> sheet_of_;  ///< the thin pane of a glass that has solids too
  std::map<std::size_t, std::vector<GlassFace>> glass_face_;  ///< by shape that has any: of each of its faces
  tinyobj::attrib_t attrib_;
  std::vector<tinyobj::shape_t> shapes_;
  std::vector<tinyobj::material_t> materials_;
  std::optional<std::uint32_t> default_material_;
  std::uint64_t skipped_ = 0;
};

/// Words after `keyword` on each line that starts with it; the whole rest of the line first.
void names_after(const std::string& bytes, const std::string& keyword, std::vector<std::string>& names) {
  std::istringstream lines(bytes);
  lines.exceptions(std::ios::badbit);  // for want of memory
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != keyword) continue;
    std::string rest;
    std::getline(words >> std::ws, rest);
    while (!rest.empty() && (rest.back() == '\r' || rest.back() == ' ')) rest.pop_back();
    names.push_back(rest);
    std::istringstream parts(rest);
    while (parts >> word) names.push_back(word);
  }
}

}  // namespace

Scene load_obj(const std::string& path, std::string_view bytes, const SceneOptions& options) {
  Scene scene;
  scene.path = path;
  if (options.time_s) scene.time_s = *options.time_s;
  if (options.frame) scene.time_s = *options.frame / scene.frames_per_s;
  ObjReader(scene).read(bytes);
  GivenLuminaires given(options.luminaires);
  read_obj_lights(path, given, options.luminaires.as, scene);
  given.require_all_found();
  return scene;
}

std::vector<std::string> obj_external_files(const std::string& path, std::string_view bytes) {
  std::vector<std::string> libraries, textures, files;
  names_after(std::string(bytes), "mtllib", libraries);
  for (const std::string& name : libraries) {
    files.push_back(beside(path, name));
    const std::optional<std::string> mtl = read_if_there(files.back());
    if (!mtl) continue;
    for (const char* keyword : {"map_Kd", "map_Ke", "map_d", "norm"}) names_after(*mtl, keyword, textures);
  }
  for (const std::string& name : textures) files.push_back(obj_file(path, name));
  files.push_back(obj_lights_path(path));
  return files;
}

}  // namespace phos::inline scene
