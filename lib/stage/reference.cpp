#include "stage/reference.h"

#include <cstdio>

#include "core/memory.h"
#include "file/atomic_file.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "image/without_errors.h"
#include "reference/events.h"
#include "reference/measure_points.h"
#include "reference/render.h"
#include "scene/inside_solid.h"
#include "scene/motion/film.h"

namespace phos::stage {
namespace {

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

/// Warns of light that the picture's error does not hold. Is the error to be stated?
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
  if (measured.rejected > 0) tool.counters().count(kNonFiniteSampleEvent, measured.rejected);
  tool.counters().require_allowed(kNonFiniteSampleEvent, measured.samples);
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
  const std::string takes = require_memory(text("a picture of ", reference.width, " x ", reference.height),
                                           reference_bytes(reference), "give a smaller --width");
  if (!takes.empty()) tool.say(takes);
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
  set_provenance(picture.image, tool.provenance(FileKind::image, scene.hash, scene.parts));
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

void run(Tool& tool, ReferenceCommand& asked) {
  ReferenceOptions& reference = asked.reference;
  if (asked.points.empty() && tool.output().empty())
    throw Error(ExitCode::usage, "-o", "a picture needs an output file: -o room.exr (or give --points)");
  if (!asked.points.empty() && reference.adaptive)
    throw Error(ExitCode::usage, "--adaptive",
                "shares samples out among pixels; each of --points has its own");
  tool.add_input("scene", scene_files(asked.scene_path, asked.scene));
  if (!asked.points.empty()) tool.add_input("points", asked.points);
  reference.seed = tool.seed();
  if (asked.points.empty()) {
    tool.set_provenance_reader(read_image_provenance);
    if (tool.up_to_date()) return;
  }
  const Scene scene = [&] {
    const auto timer = tool.time("load scene");
    return load_scene(asked.scene_path, asked.scene);
  }();
  tell_losses(tool, scene);
  if (reference.adaptive && reference.method == ReferenceMethod::bidirectional)
    throw Error(ExitCode::usage, "--adaptive",
                "shares out paths from the eye alone; leave it out, or give --method path");
  std::vector<SensorPoint> points;
  if (!asked.points.empty())
    points = parse_sensor_points(read_text(asked.points), asked.points, scene.origin_m);
  if (const auto frames = tool.frames()) require_frames(scene, *frames);
  if (asked.points.empty()) resolve_size(reference, find_camera(scene, reference.camera));
  if (scene.light.empty()) tool.warn("the scene has no light: everything will be black");
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  if (asked.points.empty())
    render(tool, scene, rays, luminaires, reference);
  else
    measure_points(tool, rays, luminaires, reference, points);
}

}  // namespace phos::stage
