#include "study/spec/check.h"

#include <cstdlib>

#include "core/error.h"
#include "file/hash.h"
#include "image/image_provenance.h"
#include "image/metrics.h"
#include "scene/load.h"
#include "sense/sensor_points.h"
#include "sense/sensors.h"
#include "study/measure_lux.h"

namespace phos::inline study {

namespace {

[[noreturn]] void mismatch(const std::string& path, const std::string& why) {
  throw Error(ExitCode::mismatch, path, why);
}

/// The reference was made of this scene and camera, if it says of which.
void require_scene(const std::string& file, const std::string& scene, const std::string& hash,
                   const std::string& camera) {
  const auto made = read_image_provenance(file);
  if (!made) return;
  if (!made->scene_hash.empty() && made->scene_hash != hash)
    mismatch(file, text("was made from another scene than ", scene,
                        ", or from another version of it; make it anew with phos-reference"));
  const Json* seen = made->parameters.find("camera");
  if (seen && seen->is_string() && !seen->as_string().empty() && !camera.empty() &&
      seen->as_string() != camera)
    mismatch(file, text("is what the camera \"", seen->as_string(), "\" sees, and \"", camera,
                        "\" is asked for; make it anew with phos-reference --camera"));
}

void require_two(const std::vector<std::string>& files) {
  if (files.size() == 2 && hash_file(files[0]) == hash_file(files[1]))
    mismatch(files[1], text("is the same picture as ", files[0],
                            ", so that its noise cannot be told; make it with another --seed"));
}

void check_picture(const StudyFile& study, const std::string& file, int width, int height,
                   const std::string& scene, const std::string& hash, const std::string& camera) {
  const Image image = read_image(file);
  const auto is = [&](int w, int h) {
    mismatch(file, text("is ", image.width(), " x ", image.height(), " pixels, and ", w, " x ", h,
                        " are asked for; leave the size out of [study], or make the reference anew"));
  };
  if (image.width() != width || image.height() != height) is(width, height);
  if (study.width.value_or(width) != width || study.height.value_or(height) != height)
    is(static_cast<int>(study.width.value_or(width)), static_cast<int>(study.height.value_or(height)));
  const std::string layer = layer_from_label(study.layer);
  if (components_of(image, layer).empty()) {
    std::string all;
    for (const std::string& l : all_layers(image)) all.append(all.empty() ? "" : ", ").append(layer_label(l));
    mismatch(file, text("has no layer ", study.layer, "; it has ", all));
  }
  require_scene(file, scene, hash, camera);
}

void check_pictures(const StudyFile& study, const std::vector<std::string>& files, const std::string& scene,
                    const std::string& hash, const std::string& camera) {
  if (files.empty()) return;
  const Image first = read_image(files[0]);
  for (const std::string& file : files)
    check_picture(study, file, first.width(), first.height(), scene, hash, camera);
  require_two(files);
}

void check_lux(const StudyFile& study, const std::vector<std::string>& files) {
  const Sensors sensors = read_sensors(study.sensors);
  for (const std::string& file : files) {
    const LuxTable table = read_lux(file);
    if (table.position.size() != sensors.points.size())
      mismatch(file, text("has ", table.position.size(), " sensors, and ", study.sensors, " has ",
                          sensors.points.size(), "; make it anew with phos-reference --points"));
    for (std::size_t i = 0; i < table.position.size(); ++i)
      if (table.position[i] != sensors.points[i].position)
        mismatch(file, text("its sensor ", i, " is not where that of ", study.sensors,
                            " is; make it anew with phos-reference --points"));
  }
  require_two(files);
}

/// How scenes are loaded, by the words that the reference gets.
SceneOptions scene_options(const std::vector<std::string>& words) {
  SceneOptions options;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const auto number = [&] { return std::strtod(words[i + 1].c_str(), nullptr); };
    if (words[i] == "--environment") options.environment = words[i + 1];
    if (words[i] == "--environment-rotation") options.environment_rotation_deg = number();
    if (words[i] == "--environment-scale") options.environment_scale = number();
    read_daylight_word(words[i], words[i + 1], options.daylight);
    read_band_word(words[i], words[i + 1], options.bands);
    if (words[i] == "--luminaire") options.luminaires.of_lights.push_back(words[i + 1]);
    if (words[i] == "--luminaires-as" && words[i + 1] == "points")
      options.luminaires.as = LuminairesAs::points;
    if (words[i] == "--time") options.time_s = number();
    if (words[i] == "--frame") options.frame = number();
  }
  return options;
}

}  // namespace

const std::vector<std::string>& given(const StudyFile& study, const std::string& scene,
                                      const std::string& camera,
                                      std::vector<std::string> GivenReference::*which) {
  static const std::vector<std::string> none;
  for (const GivenReference& g : study.given) {
    const bool here =
        (g.scene.empty() || g.scene == scene) && (g.camera.empty() || camera.empty() || g.camera == camera);
    if (here && !(g.*which).empty()) return g.*which;
  }
  return none;
}

std::vector<SceneLoss> check_against_scenes(const StudyFile& study) {
  if (study.reads_sensors() && read_sensors(study.sensors).points.empty())
    throw Error(ExitCode::bad_input, study.sensors, "has no sensor; give points");
  std::vector<SceneLoss> out;
  for (const std::string& path : study.scenes) {
    const Scene scene = load_scene(path, scene_options(study.reference));
    for (const Note& loss : losses(scene)) out.push_back({path, loss.line(), refused({loss})});
    if (scene.light.empty())
      throw Error(
          ExitCode::bad_input, path,
          "has no light: everything is black, and no error means anything; add a lamp or an environment");
    if (study.makes_pictures())
      for (const std::string& camera : study.cameras) {
        find_camera(scene, camera);
        check_pictures(study, given(study, path, camera, &GivenReference::pictures), path, scene.hash,
                       camera);
      }
    if (study.reads_sensors()) check_lux(study, given(study, path, "", &GivenReference::lux));
  }
  return out;
}

}  // namespace phos::inline study
