#include "scene/report/lint.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>

#include "core/error.h"
#include "scene/finalize/lights.h"
#include "scene/inside_solid.h"
#include "scene/lamp/spot_cone.h"
#include "scene/load.h"
#include "scene/material/merl.h"
#include "scene/material/models.h"
#include "scene/nested_glass.h"
#include "scene/report/describe.h"
#include "scene/sky/access.h"
#include "scene/sky/daylight.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {
namespace {

constexpr double kLargestDiagonal_m = 300, kSmallestDiagonal_m = 0.01;
constexpr double kDarkest_lx = 1, kBrightest_lx = 200000;
constexpr double kHighReflectance = 0.95, kAllReflectance = 0.99995, kBackwardShare = 0.01;

constexpr const char *kAboveOne = "reflectance-above-one", *kAbsorbsNothing = "absorbs-nothing",
                     *kReflectsMuch = "reflectance-high";

struct Mend {
  const char *code, *mend;
};
/// By the code of a note.
constexpr Mend kMends[] = {
    {kTextureNotFound, "put the image beside the scene, or pack it into a .glb"},
    {kLightTooFaint, "give it more power, or remove it"},
    {kSunTooBright, "irradiances are in W/m2, illuminances in lx"},
    {kLightIgnored, "give it an area and an intensity, or remove it"},
    {kAboveOne, "lower kd or ks until kd + ks is at most 1"},
    {kAbsorbsNothing, "lower kd or ks; white paint reflects 0.8"},
    {kReflectsMuch, "lower the reflectance, unless it is intended"},
    {kMetalByDefault, "give paint, plaster, wood and stone a metallicFactor of 0"},
};

class Linter {
 public:
  explicit Linter(const Scene& scene) : scene_(scene) {}

  std::vector<Finding> run() {
    check_size();
    check_light();
    const auto& materials = scene_.material;
    const bool glass = std::any_of(materials.begin(), materials.end(), is_solid_glass);
    if (glass || !scene_.camera.empty()) {
      const RayScene rays(scene_);
      check_cameras(rays);
      check_nested_glass(rays);
      if (!scene_.camera.empty()) check_sky(rays);
    }
    check_lamps();
    check_materials();
    check_tangents();
    check_geometry();
    check_warnings();
    check_names();
    std::stable_sort(findings_.begin(), findings_.end(),
                     [](const Finding& a, const Finding& b) { return a.level > b.level; });
    return std::move(findings_);
  }

 private:
  using Level = Finding::Level;
  void add(Level level, const std::string& code, const std::string& message, const std::string& mend) {
    findings_.push_back({level, code, message, mend});
  }

  void check_size() {
    const double d = scene_.bounds.diagonal_m();
    if (d > kLargestDiagonal_m) {
      add(Level::warning, "too-large", text("the scene is ", shortest(static_cast<float>(d)), " m across"),
          "glTF counts in metres: if this is in millimetres or centimetres, scale it by 0.001 or 0.01");
    }
    if (d < kSmallestDiagonal_m) {
      add(Level::warning, "too-small", text("the scene is ", shortest(static_cast<float>(d)), " m across"),
          "glTF counts in metres: if this is in kilometres, or was scaled down twice, scale it by 1000");
    }
  }

  void check_light() {
    if (scene_.light.empty()) {
      add(Level::error, "no-light", "the scene has no light",
          how_to_add_to(scene_).ends_with("modeller")
              ? "give a material an emissiveFactor with KHR_materials_emissive_strength (cd/m2), or add a "
                "KHR_lights_punctual light, or give --environment"
              : text("give a material Ke (cd/m2), or ", how_to_add_to(scene_), ", or give --environment"));
      return;
    }
    // A surface turned any way receives a quarter of the light that an environment sends from all sides.
    double lumens = 0, area = 0, mean_lx = 0;
    for (const Light& light : scene_.light) {
      if (light.kind == Light::Kind::environment) {
        mean_lx = 0.25 * static_cast<double>(luminance(Rgb(scene_.environment->integral_lx())));
      } else {
        lumens += luminance(light.flux_lm);
      }
    }
    for (std::uint32_t t = 0; t < scene_.triangle.size(); ++t) area += area_m2(scene_, t);
    if (area > 0) mean_lx += lumens / area;
    const std::string figure =
        text("all lights together give ", shortest(static_cast<float>(lumens)), " lm, ",
             shortest(static_cast<float>(mean_lx)), " lx if spread over every surface");
    if (mean_lx < kDarkest_lx) {
      add(Level::warning, "watts", figure + ": far too dark for a lit room",
          "if the values are in W or W/(m2 sr), multiply them by 179 lm/W; glTF counts in cd, lx and cd/m2");
    }
    if (mean_lx > kBrightest_lx) {
      add(Level::warning, "too-bright", figure + ": brighter than noon",
          "glTF counts in cd, lx and cd/m2; lamps given in millicandela, or emission scaled for display, are "
          "too bright");
    }
  }

  void check_cameras(const RayScene& rays) {
    for (const Camera& camera : scene_.camera)
      if (const std::optional<std::string> inside = camera_inside_solid(rays, camera))
        add(Level::warning, "camera-inside", *inside, "put it where there is air");
  }

  void check_nested_glass(const RayScene& rays) {
    if (const std::optional<std::string> nested = nested_glass(rays))
      add(Level::warning, "nested-glass", *nested, "an index of 1 is a part that is not there");
  }

  void check_sky(const RayScene& rays) {
    if (!scene_.environment) return;
    if (const std::optional<std::string> closed = closed_to_the_sky(rays))
      add(Level::warning, "no-opening", *closed,
          "a window needs a hole in the wall, or a pane of glass (transmission, or dielectric) in it");
  }

  void check_lamps() {
    for (const Light& light : scene_.light) {
      if (light.kind == Light::Kind::area && light.fitting < 0) check_lamp(light);
      if (light.fitting >= 0) check_luminaire(light);
      if (has_hard_edge(light))
        add(Level::info, "hard-edge",
            text("light \"", light.name, "\": the inner angle of its cone is the outer one: a hard edge"),
            "give it a smaller inner angle if its beam should fade");
    }
  }

  /// A luminaire hangs within the room that it lights.
  void check_luminaire(const Light& light) {
    Bounds room, lamp;
    for (const Instance& instance : scene_.instance) {
      if (instance.fitting < 0) include(instance, room);
    }
    if (light.kind == Light::Kind::area)
      include(scene_.instance[light.instance], lamp);
    else
      lamp.include(light.position);
    if (room.empty()) return;
    const float slack = 1e-3f * room.diagonal_m();
    const Vec3 size = lamp.size(), space = room.size();
    const std::string name = "luminaire \"" + light.name + "\"";
    if (size.x > space.x + slack || size.z > space.z + slack || size.y > space.y + slack) {
      add(Level::warning, "luminaire-too-large",
          text(name, " is ", shortest(size.x), " x ", shortest(size.y), " x ", shortest(size.z),
               " m, larger than everything else together: ", shortest(space.x), " x ", shortest(space.y),
               " x ", shortest(space.z), " m"),
          "check the units of its file (feet taken for metres?) and of the scene, or pass --luminaires-as "
          "points");
    } else if (glm::any(glm::lessThan(lamp.lo, room.lo - slack)) ||
               glm::any(glm::greaterThan(lamp.hi, room.hi + slack))) {
      add(Level::warning, "luminaire-outside", name + " reaches out of everything else in the scene",
          "move it, if it should hang in a room; else it is fine");
    }
  }

  void include(const Instance& instance, Bounds& bounds) const {
    for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
         ++t)
      for (const std::uint32_t v : scene_.triangle[t].v) bounds.include(scene_.position[v]);
  }

  /// Edges by the places of their ends: a closed surface has each one once in each direction.
  void check_lamp(const Light& light) {
    using Place = std::array<float, 3>;
    const auto place = [&](std::uint32_t v) {
      const Vec3 p = scene_.position[v] + 0.0f;
      return Place{p.x, p.y, p.z};
    };
    const Instance& instance = scene_.instance[light.instance];
    std::map<std::pair<Place, Place>, std::pair<int, int>> edges;
    double volume = 0;
    const DVec3 origin = scene_.position[scene_.triangle[instance.first_triangle].v[0]];
    for (std::uint32_t t = instance.first_triangle; t < instance.first_triangle + instance.triangle_count;
         ++t) {
      const Triangle& tri = scene_.triangle[t];
      DVec3 p[3];
      for (int k = 0; k < 3; ++k) {
        p[k] = DVec3(scene_.position[tri.v[k]]) - origin;
        const Place a = place(tri.v[k]), b = place(tri.v[(k + 1) % 3]);
        auto& [forth, back] = edges[std::minmax(a, b)];
        ++(a < b ? forth : back);
      }
      volume += glm::dot(p[0], glm::cross(p[1], p[2]));
    }
    bool closed = true, manifold = true;
    for (const auto& [edge, uses] : edges) {
      closed &= uses.first == 1 && uses.second == 1;
      manifold &= uses.first <= 1 && uses.second <= 1;
    }
    const std::string name = "light \"" + light.name + "\"";
    const bool two_sided = scene_.material[instance.material].double_sided;
    if (!manifold) {
      add(Level::warning, "light-not-manifold",
          name + " has edges with more than two triangles, or triangles turned against each other",
          "make its surface consistent, or part of it shines inwards");
    } else if (closed && volume < 0 && !two_sided) {
      add(Level::error, "light-inside-out",
          name + " is a closed surface whose fronts face inwards: no light leaves it",
          "flip its faces; light leaves the counter-clockwise side");
    } else if (!closed && !two_sided && faces_nothing(instance)) {
      add(Level::warning, "light-faces-away", name + " shines away from everything in the scene",
          "flip its faces; light leaves the counter-clockwise side");
    }
  }

  /// Is no vertex of the scene in front of any triangle of the lamp?
  bool faces_nothing(const Instance& lamp) const {
    const double slack = 1e-6 * scene_.bounds.diagonal_m();
    const std::uint32_t step = std::max(1u, lamp.triangle_count / 16);  // a few planes tell
    for (std::uint32_t t = 0; t < lamp.triangle_count; t += step) {
      const Vec3 n = geometric_normal(scene_, lamp.first_triangle + t);
      const Vec3 p = scene_.position[scene_.triangle[lamp.first_triangle + t].v[0]];
      const bool seen = std::any_of(scene_.position.begin(), scene_.position.end(),
                                    [&](const Vec3& q) { return glm::dot(n, q - p) > slack; });
      if (seen) return false;
    }
    return true;
  }

  void check_materials() {
    std::vector<Note> notes;
    for (const MaterialSummary& m : summarize_materials(scene_)) {
      if (m.triangles == 0) continue;
      const std::string& name = m.material->name;
      const std::string figure =
          text("reflects ", shortest(static_cast<float>(m.reflectance)), " of the light");
      const auto note = [&](Note::Level level, const char* code, const char* what) {
        notes.emplace_back(level, code, "material", name, figure + what);
      };
      if (row_of(*m.material).measured) {
        check_measured("material \"" + name + "\"",
                       *scene_.measured[static_cast<std::size_t>(m.material->measured)]);
      } else if (m.reflectance > 1.0001) {
        note(Note::Level::warning, kAboveOne, ", more than it receives");
      } else if (m.reflectance > kAllReflectance && m.diffuse) {
        note(Note::Level::warning, kAbsorbsNothing,
             ": in a closed room of this material light never ends, and has no finite mean");
      } else if (m.reflectance > kHighReflectance && m.diffuse) {
        note(Note::Level::info, kReflectsMuch, "; white paint reflects 0.8");
      }
    }
    add_merged(notes);
  }

  void check_measured(const std::string& name, const MerlBrdf& measured) {
    if (const std::string gain = measured.energy_gain(); !gain.empty()) {
      add(Level::warning, "gains-energy", name + " " + gain,
          "the measurement is off there, or is in other units; light is not scaled down");
    }
    if (const std::uint64_t n = measured.empty_reachable_cells(); n > 0) {
      add(Level::info, "measured-without-data",
          text(name, " has ", n, " cells without data that light can reach; the nearest ones stand in"),
          "measure them, if it matters");
    }
  }

  /// Stretched highlights need a direction.
  void check_tangents() {
    for (const Instance& instance : scene_.instance) {
      const Material& m = scene_.material[instance.material];
      if (!m.anisotropic()) continue;
      const std::uint32_t v = scene_.triangle[instance.first_triangle].v[0];
      const bool tangent = !scene_.tangent.empty() && Vec3(scene_.tangent[v]) != Vec3(0);
      if (tangent || !scene_.uv0.empty()) continue;
      add(Level::warning, "anisotropic-without-tangents",
          text("\"", instance.node, "\" has the anisotropic material \"", m.name,
               "\", but neither tangents nor texture coordinates; horizontal stands in"),
          "export tangents or texture coordinates");
    }
  }

  void check_geometry() {
    const auto event = [&](const char* name, const char* code, const char* what, const char* mend) {
      const auto it = scene_.events.find(name);
      if (it != scene_.events.end()) add(Level::warning, code, text(it->second, " ", what), mend);
    };
    event("triangles given flat normals", "normals-missing", "triangles have no normals and are shaded flat",
          "export normals if the surface is meant to be smooth");
    event("normals repaired", "normals-bad",
          "normals were zero or not finite, and were made from their triangles", "export the normals again");
    event("degenerate triangles dropped", "degenerate", "triangles have no area and were left out",
          "remove them in the modeller (merge by distance)");
    event("vertex attributes not finite, set to zero", "attributes-bad",
          "texture coordinates or colours are not finite", "export them again");
    std::uint64_t backward = 0;
    for (std::uint32_t t = 0; t < scene_.triangle.size(); ++t) {
      Vec3 sum(0);
      for (const std::uint32_t v : scene_.triangle[t].v) sum += scene_.normal[v];
      backward += glm::dot(sum, geometric_normal(scene_, t)) < 0;
    }
    const double share = static_cast<double>(backward) / static_cast<double>(scene_.triangle.size());
    if (share > kBackwardShare) {
      add(Level::warning, "normals-backwards",
          text(backward, " triangles (", shortest(static_cast<float>(std::round(1000 * share) / 10)),
               " %) have normals that point to their back"),
          "make winding and normals agree (recalculate normals)");
    }
  }

  /// Of the loader.
  void check_warnings() { add_merged(scene_.warnings); }

  void add_merged(const std::vector<Note>& notes) {
    for (const Note& note : merged(notes)) {
      if (note.code == kSaidByLint) continue;
      const auto mend = std::find_if(std::begin(kMends), std::end(kMends),
                                     [&](const Mend& m) { return note.code == m.code; });
      const bool warning =
          note.level == Note::Level::warning || note.code == kLightIgnored || note.code == kSunTooBright;
      add(warning ? Level::warning : Level::info, note.code, note.message,
          mend == std::end(kMends) ? "change it in the modeller if it matters" : mend->mend);
    }
  }

  void check_names() {
    if (scene_.camera.empty()) {
      add(Level::warning, "no-camera", "the scene has no camera",
          how_to_add_to(scene_) + "; pictures need it");
    }
    std::map<std::string, int> cameras, materials;
    for (const Camera& c : scene_.camera) ++cameras[c.name];
    for (const Material& m : scene_.material) ++materials[m.name];
    for (const auto& [name, n] : cameras) {
      if (n > 1)
        add(Level::warning, "camera-name-twice", text(n, " cameras are called \"", name, "\""),
            "rename them: --camera finds only the first");
    }
    for (const auto& [name, n] : materials) {
      if (n > 1)
        add(Level::info, "material-name-twice", text(n, " materials are called \"", name, "\""),
            "rename them");
    }
  }

  const Scene& scene_;
  std::vector<Finding> findings_;
};

}  // namespace

const char* level_name(Finding::Level level) {
  constexpr const char* kNames[] = {"info", "warning", "error"};
  return kNames[static_cast<int>(level)];
}

std::vector<Finding> lint_scene(const Scene& scene) { return Linter(scene).run(); }

}  // namespace phos::inline scene
