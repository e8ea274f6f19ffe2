#include "scene/obj/lights.h"

#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/origin.h"
#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "scene/gltf/document.h"
#include "scene/lamp/spot_cone.h"

namespace phos::inline scene {
namespace {

class Reader {
 public:
  Reader(std::string path, Scene& scene, GivenLuminaires& given, LuminairesAs as)
      : path_(std::move(path)), scene_(scene), given_(given), luminaires_as_(as) {}

  void read() {
    const Json document = parse_json(read_text(path_), path_);
    if (!document.is_object())
      throw Error(ExitCode::bad_input, path_, "must hold an object with lights and cameras");
    for (const char* key : {"lights", "cameras"}) {
      const Json* list = document.find(key);
      if (list && !list->is_array()) throw Error(ExitCode::bad_input, path_, text(key, " must be an array"));
    }
    for (std::size_t i = 0; i < count_at(document, "lights"); ++i) {
      place_ = text("lights[", i, "]");
      read_light(element(document, "lights", i), i);
    }
    for (std::size_t i = 0; i < count_at(document, "cameras"); ++i) {
      place_ = text("cameras[", i, "]");
      read_camera(element(document, "cameras", i), i);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ExitCode::bad_input, path_, place_ + ": " + message);
  }

  Vec3 vector(const Json& from, const char* key, const Vec3* absent = nullptr) const {
    const Json* v = from.find(key);
    if (!v && absent) return *absent;
    if (!v) fail(text("\"", key, "\" is missing"));
    if (!v->is_array() || v->as_array().size() != 3) fail(text("\"", key, "\" must be three numbers"));
    const std::optional<Rgb> value = rgb_at(from, key);
    if (!value || !is_finite(*value)) fail(text("\"", key, "\" must be three numbers"));
    return *value;
  }

  /// A place in the world, from the scene's origin.
  Vec3 place(const Json& from, const char* key) const {
    vector(from, key);  // three finite numbers
    const Json::Array& v = from.find(key)->as_array();
    return from_world({v[0].as_number(), v[1].as_number(), v[2].as_number()}, scene_.origin_m);
  }

  float number(const Json& from, const char* key, double absent, double lo, double hi) const {
    const double v = number_at(from, key, absent);
    if (!(v > lo && v <= hi)) fail(text("\"", key, "\" must be above ", lo, " and at most ", hi));
    return static_cast<float>(v);
  }

  Vec3 direction(const Json& from, const char* key) const {
    const Vec3 unit = normalized_or_zero(vector(from, key));
    if (unit == Vec3(0)) fail(text("\"", key, "\" must not be zero"));
    return unit;
  }

  void read_light(const Json& from, std::size_t index) {
    if (!from.is_object()) fail("must be an object");
    Light light;
    light.name = text_at(from, "name", text("light ", index));
    const std::string kind = text_at(from, "kind", "");
    if (kind != "point" && kind != "spot" && kind != "directional")
      fail("\"kind\" must be point, spot or directional");
    const std::optional<Rgb> intensity = rgb_at(from, "intensity");
    if (!intensity) fail("\"intensity\" is missing");
    light.intensity = *intensity;
    if (!is_finite(light.intensity) || light.intensity.x < 0 || light.intensity.y < 0 ||
        light.intensity.z < 0) {
      fail("\"intensity\" must not be negative");
    }
    light.kind = kind == "point"  ? Light::Kind::point
                 : kind == "spot" ? Light::Kind::spot
                                  : Light::Kind::directional;
    if (kind != "directional") light.position = place(from, "position");
    if (kind != "point") light.direction = direction(from, "direction");
    if (kind == "spot") {
      const double outer = number_at(from, "outer_deg", 45), inner = number_at(from, "inner_deg", 0);
      if (!set_spot_cone(light, glm::radians(inner), glm::radians(outer)))
        fail("the half angles must satisfy 0 <= \"inner_deg\" <= \"outer_deg\" <= 90, \"outer_deg\" above 0");
    }
    if (light.kind != Light::Kind::directional) {
      if (std::shared_ptr<const PhotometricFile> file = given_.find(light.name)) {
        const DVec3 position(light.position), x(1, 0, 0);
        const bool point = light.kind == Light::Kind::point;
        const glm::dmat4 to_world =
            point ? hanging_down(position, x, 1) : aimed(position, DVec3(light.direction), x);
        return hang_luminaire(scene_, std::move(file), {light.name, to_world, hue(light.intensity)},
                              luminaires_as_);
      }
    }
    scene_.light.push_back(light);
  }

  void read_camera(const Json& from, std::size_t index) {
    if (!from.is_object()) fail("must be an object");
    const Vec3 up(0, 1, 0);
    const Vec3 eye = place(from, "eye"), target = place(from, "target"), y = vector(from, "up", &up);
    const Vec3 back = normalized_or_zero(eye - target), right = normalized_or_zero(glm::cross(y, back));
    if (back == Vec3(0) || right == Vec3(0)) fail("eye, target and up must not lie on one line");
    Camera camera;
    camera.name = text_at(from, "name", text("camera ", index));
    camera.to_world = Mat4(Vec4(right, 0), Vec4(glm::cross(back, right), 0), Vec4(back, 0), Vec4(eye, 1));
    camera.yfov_rad = glm::radians(number(from, "yfov_deg", 45, 0, 179));
    camera.aspect = number(from, "aspect", 1, 0, 1e6);
    scene_.camera.push_back(camera);
  }

  std::string path_, place_;
  Scene& scene_;
  GivenLuminaires& given_;
  LuminairesAs luminaires_as_;
};

}  // namespace

std::string obj_lights_path(const std::string& obj_path) {
  return std::filesystem::path(obj_path).replace_extension(".lights.json").string();
}

void read_obj_lights(const std::string& obj_path, GivenLuminaires& given, LuminairesAs as, Scene& scene) {
  const std::string path = obj_lights_path(obj_path);
  std::error_code ignored;
  if (path == obj_path || !std::filesystem::exists(path, ignored)) return;
  try {
    Reader(path, scene, given, as).read();
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw Error(ExitCode::bad_input, path, text("malformed: ", e.what()));
  }
}

}  // namespace phos::inline scene
