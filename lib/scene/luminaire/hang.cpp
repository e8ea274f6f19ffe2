#include "scene/luminaire/hang.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/text/named_files.h"

namespace phos::inline scene {
namespace {

glm::dmat4 matrix(const DVec3& x, const DVec3& y, const DVec3& z, const DVec3& position) {
  return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(position, 1)};
}

/// z kept, x as near as can be; mirrored where the matrix is.
Mat3 unit_axes(const glm::dmat4& m) {
  const auto unit = [](const DVec3& v, const DVec3& otherwise) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : otherwise;
  };
  const DVec3 z = unit(DVec3(m[2]), {0, 0, 1});
  const DVec3 aside = std::fabs(z.x) < 0.9 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
  const DVec3 level = unit(aside - glm::dot(aside, z) * z, {1, 0, 0});
  const DVec3 along = unit(DVec3(m[0]), level);
  const DVec3 x = unit(along - glm::dot(along, z) * z, level);
  const double side = glm::determinant(glm::dmat3(m)) < 0 ? -1 : 1;
  return Mat3(Vec3(x), Vec3(side * glm::cross(z, x)), Vec3(z));
}

}  // namespace

GivenLuminaires::GivenLuminaires(const LuminaireOptions& options) {
  std::map<std::string, std::shared_ptr<const PhotometricFile>> read;
  for (const NamedFile& w : named_files(options.of_lights, "--luminaire")) {
    if (file_.count(w.name))
      throw Error(ExitCode::usage, "--luminaire",
                  text("is given twice for the light \"", w.name, "\"; give it once"));
    std::shared_ptr<const PhotometricFile>& file = read[w.file];
    if (!file) file = std::make_shared<const PhotometricFile>(read_photometry(w.file));
    file_[w.name] = file;
  }
}

std::shared_ptr<const PhotometricFile> GivenLuminaires::find(const std::string& light) {
  const auto it = file_.find(light);
  asked_[light] = true;
  return it == file_.end() ? nullptr : it->second;
}

void GivenLuminaires::require_all_found() const {
  for (const auto& [name, file] : file_) {
    if (asked_.count(name)) continue;
    std::string names;
    for (const auto& [light, yes] : asked_) names += (names.empty() ? "\"" : ", \"") + light + "\"";
    throw Error(ExitCode::usage, "--luminaire",
                text("there is no point, spot or IES light \"", name, "\"; the scene has ",
                     names.empty() ? "none" : names));
  }
}

Rgb hue(const Rgb& colour) {
  const float y = luminance(colour);
  return y > 0 && is_finite(colour / y) ? colour / y : Rgb(1);
}

glm::dmat4 hanging_down(const DVec3& position, const DVec3& across, double scale) {
  const DVec3 level(across.x, 0, across.z);
  const double length = glm::length(level);
  const DVec3 z(0, 1, 0), x = length > 1e-6 * glm::length(across) ? level / length : DVec3(1, 0, 0);
  return matrix(scale * x, scale * glm::cross(z, x), scale * z, position);
}

glm::dmat4 aimed(const DVec3& position, const DVec3& direction, const DVec3& across) {
  const Mat3 axes = unit_axes(matrix(across, DVec3(0), -direction, position));
  return matrix(DVec3(axes[0]), DVec3(axes[1]), DVec3(axes[2]), position);
}

void hang_luminaire(Scene& scene, std::shared_ptr<const PhotometricFile> file, const LuminairePlace& place,
                    LuminairesAs as) {
  const Mat3 axes = unit_axes(place.to_world);
  for (const std::string& warning : file->warnings)
    scene.warnings.emplace_back(Note::Level::info, "loader", "luminaire", place.name, warning);
  const double tilt_deg = glm::degrees(std::acos(std::clamp(static_cast<double>(axes[2].y), -1.0, 1.0)));
  const Rgb colour = place.colour * static_cast<float>(file->tilt.factor(tilt_deg));
  const auto index = static_cast<std::int32_t>(scene.fitting.size());
  const bool point = as == LuminairesAs::points || file->opening.form == LuminousOpening::Form::point;
  if (!point && file->photometry->flux_lm() > 0) {
    Material material;  // black, but for its light: measured light holds the light that falls in
    material.name = place.name + " opening";
    MeshData mesh = opening_mesh(file->opening, *file->photometry, material.double_sided);
    const std::size_t before = scene.instance.size();
    add_instance(scene, std::move(mesh), place.to_world, place.name,
                 static_cast<std::uint32_t>(scene.material.size()), false,
                 text("luminaire \"", place.name, "\""));
    if (scene.instance.size() > before) {
      scene.material.push_back(material);
      scene.instance.back().fitting = index;
      scene.fitting.emplace_back(std::move(file), axes, colour);
      return;
    }
    scene.warnings.emplace_back(Note::Level::warning, "loader", "luminaire", place.name,
                                "its opening has no size here; a point shines");
  }
  Light light;
  light.kind = Light::Kind::measured;
  light.name = place.name;
  light.position = Vec3(DVec3(place.to_world[3]));
  light.fitting = index;
  scene.fitting.emplace_back(std::move(file), axes, colour);
  scene.light.push_back(light);
}

}  // namespace phos::inline scene
