// phos-reference: scene -> converged OpenEXR picture, or lux at points, by path tracing.
#include <cstdio>

#include "file/atomic_file.h"
#include "file/container.h"
#include "file/tool.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "image/without_errors.h"
#include "reference/measure_points.h"
#include "reference/render.h"
#include "scene/inside_solid.h"
#include "scene/load.h"
#include "scene/motion/film.h"

namespace {

using namespace phos;

void write_text(Tool& tool, const std::string& csv) {
  if (tool.output().empty()) {
    std::fwrite(csv.data(), 1, csv.size(), stdout);
    return;
  }
  AtomicFile file(tool.output());
  file.write(csv);
  file.commit();
}

bool direct_alone(const PathOptions& path) { return path.bounces == 0 || path.bounces == 1; }

/// By which light can come, of that which is asked for: directly it comes straight.
std::vector<LightWay> ways_of(const RayScene& rays, const Luminaires& luminaires, const PathOptions& path) {
  return direct_alone(path) ? std::vector<LightWay>() : light_ways(rays, luminaires);
}

/// Light that comes straight, and --adaptive, which shares out paths from the eye, need no other paths.
ReferenceMethod method_of(const ReferenceOptions& reference) {
  const bool from_eye = direct_alone(reference.path) || reference.adaptive;
  return reference.method == ReferenceMethod::automatic && from_eye ? ReferenceMethod::path
                                                                    : reference.method;
}

/// Warns of what the picture's error does not hold. Is it to be stated?
bool can_state_error(Tool& tool, const std::vector<LightWay>& ways, const ReferencePicture& picture) {
  const auto samples = static_cast<double>(picture.image.pixels()) * static_cast<double>(picture.samples);
  const std::vector<LightWay> missed = unsampled(ways, Sampler::path_tracing, samples);
  tell_unsampled(tool, missed, Sampler::path_tracing, samples);
  if (!picture.trusted) {
    tool.stat("untrusted", picture.image.pixels());
    tool.doubt("too few bright paths make the picture's standard error; raise --samples");
  }
  return missed.empty();
}

void measure_points(Tool& tool, const RayScene& rays, const Luminaires& luminaires,
                    const ReferenceOptions& reference, const std::vector<SensorPoint>& points) {
  PointOptions options;
  options.samples = reference.samples, options.relative_error = reference.error;
  options.seed = reference.seed, options.path = reference.path;
  const MeasuredPoints measured = measure_points(rays, luminaires, points, method_of(reference),
                                                 ways_of(rays, luminaires, reference.path), options);
  tool.stat("samples", measured.samples);
  if (measured.rejected > 0) tool.counters().count("non-finite sample", measured.rejected);
  tool.counters().require_allowed("non-finite sample", measured.samples);
  measured.doubts.tell(tool);
  write_text(tool, sensor_csv(points, measured.light, rays.scene().origin_m));
}

std::string error_text(double error) {
  return text(", standard error ", shortest(static_cast<float>(100 * error)),
              " % of the mean luminance (RMS)");
}

void render(Tool& tool, const Scene& scene, const RayScene& rays, const Luminaires& luminaires,
            ReferenceOptions reference) {
  const std::vector<LightWay> ways = ways_of(rays, luminaires, reference.path);
  const double pixels = static_cast<double>(reference.width) * static_cast<double>(reference.height);
  const bool both_ends =
      is_bidirectional(method_of(reference), scene, ways, pixels * static_cast<double>(reference.samples));
  if (const auto inside = camera_inside_solid(rays, find_camera(scene, reference.camera))) tool.warn(*inside);
  reference.method = both_ends ? ReferenceMethod::bidirectional : ReferenceMethod::path;
  ReferencePicture picture = [&] {
    const auto timer = tool.time("trace");
    return render_reference(rays, luminaires, find_camera(scene, reference.camera), reference);
  }();
  tool.counters().merge(picture.counters);
  tool.stat("samples", picture.image.pixels() * static_cast<std::uint64_t>(picture.samples));
  tool.stat("samples a pixel", picture.samples);
  const bool stated = can_state_error(tool, both_ends ? std::vector<LightWay>() : ways, picture);
  if (!stated) picture.image = without_errors(picture.image);
  if (!scene.animation.empty()) picture.image.attributes[kFramesPerSecond] = shortest(scene.frames_per_s);
  set_provenance(picture.image, tool.provenance("image", scene.hash, scene.parts));
  picture.image.attributes["phos.samples"] = std::to_string(picture.samples);
  if (stated) picture.image.attributes["phos.error"] = shortest(picture.error);
  if (stated) tool.stat("error", picture.error);
  const auto timer = tool.time("write");
  write_exr(tool.output(), picture.image);
  tool.say(text(tool.output(), ": ", reference.width, " x ", reference.height, ", ", picture.samples,
                " samples a pixel", stated ? error_text(picture.error) : ""));
  if (reference.error && picture.error > *reference.error)
    tool.warn(text("--error ", shortest(*reference.error), " was not reached within --samples ",
                   reference.samples, "; raise --samples"));
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "phos-reference", "renders a scene by path tracing, to judge other stages by",
      "Unbiased path tracing with next-event estimation, multiple importance sampling and Russian "
      "roulette; it "
      "shares no estimator with the caches. --method bidirectional follows paths from the lamps too, and "
      "so finds light that comes by mirrors, glass and sharp gloss; it blurs what nothing else can make, "
      "and the estimated bias is part of the standard error. Writes an OpenEXR image with the layers beauty "
      "(R G B), "
      "emission, "
      "direct, indirect and, where there is any, glossy and specular in cd/m2, their standard errors "
      "stderr and "
      "indirect_stderr, albedo, normal, position and Z; or, with --points, a CSV of illuminance (lx) "
      "with its "
      "standard error.",
      4, Tool::Output::optional);
  tool.takes_strict();
  Options& options = tool.options();
  std::string scene_path, points_path;
  ReferenceOptions reference;
  SceneOptions scene_options;
  options.input("SCENE", scene_path, "glTF or OBJ scene");
  declare_options(options, reference);
  declare_options(options, scene_options);
  tool.takes_frames(scene_options.frame);
  tool.fresh_each_frame(reference);
  options.section("Points");
  options.file("points", points_path,
               "measure illuminance at these points instead (CSV with columns x,y,z,nx,ny,nz, or six numbers "
               "a line; the side that the normal faces); the "
               "result goes to -o or stdout");
  options.example("phos-reference room.glb --error 0.01 --samples 4096 -o room.exr",
                  "until the noise is 1 %");
  options.example("phos-reference room.glb --samples 256 --adaptive -o room.exr",
                  "most samples where most noise is: for scenes with small bright spots");
  options.example("phos-reference room.glb --bounces 1 -o direct.exr", "direct light only");
  options.example("phos-reference room.glb --points desk.csv --samples 65536",
                  "lux at sensor points, to stdout");
  options.example("phos-reference film.glb --frames 0:99 --samples 256 --reuse -o film/%04d.exr",
                  "an animation; frames that are there already are left");

  return tool.run(argc, argv, [&] {
    if (points_path.empty() && tool.output().empty())
      throw Error(ExitCode::usage, "-o", "a picture needs an output file: -o room.exr (or give --points)");
    if (!points_path.empty() && reference.adaptive)
      throw Error(ExitCode::usage, "--adaptive",
                  "shares samples out among pixels; each of --points has its own");
    tool.add_input("scene", scene_files(scene_path, scene_options));
    if (!points_path.empty()) tool.add_input("points", points_path);
    reference.seed = tool.seed();
    if (points_path.empty()) {
      tool.set_provenance_reader(read_image_provenance);
      if (tool.up_to_date()) return;
    }
    const Scene scene = [&] {
      const auto timer = tool.time("load scene");
      return load_scene(scene_path, scene_options);
    }();
    tell_losses(tool, scene);
    if (reference.adaptive && reference.method == ReferenceMethod::bidirectional)
      throw Error(ExitCode::usage, "--adaptive",
                  "shares out paths from the eye alone; leave it out, or give --method path");
    std::vector<SensorPoint> points;
    if (!points_path.empty())
      points = parse_sensor_points(read_text(points_path), points_path, scene.origin_m);
    if (const auto frames = tool.frames()) require_frames(scene, *frames);
    if (points_path.empty()) resolve_size(reference, find_camera(scene, reference.camera));
    if (scene.light.empty()) tool.warn("the scene has no light: everything will be black");
    const RayScene rays(scene);
    const Luminaires luminaires(scene);
    if (points_path.empty())
      render(tool, scene, rays, luminaires, reference);
    else
      measure_points(tool, rays, luminaires, reference, points);
  });
}
