#include "stage/reference.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "core/memory.h"
#include "file/atomic_file.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "image/without_errors.h"
#include "reference/events.h"
#include "reference/map/map_light.h"
#include "reference/map/map_points.h"
#include "reference/measure_points.h"
#include "reference/render.h"
#include "scene/inside_solid.h"
#include "scene/material/bsdf.h"
#include "scene/material/sharp_materials.h"
#include "scene/motion/film.h"
#include "scene/nested_glass.h"
#include "stage/inputs.h"
#include "stage/site.h"

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

/// What a method that reads a photon map works with; of others nothing.
struct MapInput {
  std::optional<PhotonMap> photons;
  std::unique_ptr<MapLight> light;
};

MapInput open_map(Tool& tool, const InputFiles& files, const Scene& scene, const RayScene& rays,
                  const Luminaires& luminaires, const ReferenceCommand& asked) {
  const ReferenceMethodRow& method = row_of(asked.reference.method);
  MapInput map;
  if (!method.reads_map()) return map;
  map.photons = PhotonMap::open(files.phos.front());
  require_together(*map.photons->container(), files.scene, scene, asked.allow_mismatch);
  const auto wanted = static_cast<std::uint64_t>(asked.reference.map.photons_in_disc);
  if (map.photons->size() < wanted)
    tool.warn(text(files.phos.front(), ": holds ", map.photons->size(),
                   " photons, fewer than --photons-in-disc ", wanted, ": every disc holds all of them"));
  map.light = method.map_light({rays, luminaires, *map.photons}, asked.reference.map);
  return map;
}

/// Says which errors a stated standard error holds.
void tell_error(Tool& tool, const ReferenceMethodRow& method) {
  if (*method.error_of)
    tool.warn(text("the standard error of --method ", method.name, " is ", method.error_of));
}

/// Refuses inputs and options that the method cannot use.
void check_method(const Options& given, const InputFiles& files, const ReferenceCommand& asked,
                  bool sequence) {
  const ReferenceMethodRow& method = row_of(asked.reference.method);
  const std::string option = text("--method ", method.name);
  if (files.phos.size() > 1)
    throw Error(ExitCode::usage, files.phos[1],
                text("is a second file beside ", files.phos[0], "; give one"));
  if (!method.reads_map()) {
    if (!files.phos.empty())
      throw Error(
          ExitCode::usage, files.phos[0],
          text("is not read by ", option, "; leave it out, or give --method final-gather or photons"));
    if (const std::string other = given.first_given({"photons-in-disc", "gather-rays"}); !other.empty())
      throw Error(ExitCode::usage, other, text("belongs to methods that read photons, not to ", option));
    return;
  }
  if (files.phos.empty())
    throw Error(ExitCode::usage, option,
                "reads photons of the scene; give the file too (phos-photons makes it)");
  if (asked.reference.method != ReferenceMethod::final_gather && given.given("gather-rays"))
    throw Error(ExitCode::usage, "--gather-rays", "belongs to --method final-gather; leave it out");
  if (const std::string other = given.first_given({"bounces", "black-emitters"}); !other.empty())
    throw Error(ExitCode::usage, other,
                text("is of paths, and photons hold light of all bounces: leave it out with ", option));
  if (asked.reference.error && !method.error_by_samples)
    throw Error(
        ExitCode::usage, "--error",
        text("is not reached by samples with ", option,
             ": more photons (phos-photons --photons), or more of them in a disc, make its noise less"));
  if (sequence)
    throw Error(ExitCode::usage, "--frames",
                text("has photons of each frame: run ", option, " for one --frame after another"));
}

/// Values that were left to the program are recorded for the methods that read them.
void record_map_options(Options& options, const ReferenceOptions& reference) {
  if (!row_of(reference.method).reads_map()) return;
  options.adopt("photons-in-disc", Json(reference.map.photons_in_disc));
  if (reference.method == ReferenceMethod::final_gather)
    options.adopt("gather-rays", Json(reference.map.gather_rays));
}

/// On mirrors and glass no photon is stored, of which the layer of illuminance could be made.
void require_photons_everywhere(const Scene& scene) {
  for (std::uint32_t m = 0; m < scene.material.size(); ++m)
    if (!Bsdf(scene, m).takes_light())
      throw Error(ExitCode::usage, "--illuminance",
                  text("is made of photons, and none is stored on material \"", scene.material[m].name,
                       "\", a mirror or glass: leave it out, or give --method path or bidirectional"));
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

/// Gloss whose lobe takes too few of the photons of a disc for an error (kExpectedHits), as a cosine-weighted
/// ray would find it. Warns of it, and whether errors are to be stated.
bool sees_gloss(Tool& tool, const Scene& scene, const MapOptions& map) {
  const auto photons = static_cast<double>(map.photons_in_disc);
  const auto dark = std::find_if(scene.material.begin(), scene.material.end(), [&](const Material& m) {
    return !reflects_as_mirror(m) && photons * lobe_hit_share(scene, m) < kExpectedHits;
  });
  if (dark == scene.material.end()) return true;
  tool.doubt(
      text("the gloss of material \"", dark->name, "\" is so sharp that few of the ", map.photons_in_disc,
           " photons of a disc are in its lobe: stderr is not stated; raise --photons-in-disc, or give "
           "--method final-gather"));
  return false;
}

/// Warns of light that the picture's error does not hold. Is the error to be stated?
bool can_state_error(Tool& tool, const std::vector<LightWay>& ways, const ReferencePicture& picture) {
  const auto samples = static_cast<double>(picture.image.pixels()) * static_cast<double>(picture.samples);
  const std::vector<LightWay> missed = unsampled(ways, Sampler::path_tracing, samples);
  tell_unsampled(tool, missed, Sampler::path_tracing, samples);
  if (!picture.trusted) {
    tool.stat("untrusted", picture.image.pixels());
    tool.doubt("the picture's standard error rests on too few bright paths; raise --samples");
  }
  return missed.empty();
}

void measure_points(Tool& tool, const RayScene& rays, const Luminaires& luminaires,
                    const ReferenceCommand& asked, const MapLight* map,
                    const std::vector<SensorPoint>& points) {
  const ReferenceOptions& reference = asked.reference;
  PointOptions options;
  options.samples = reference.samples, options.relative_error = reference.error;
  options.seed = reference.seed, options.path = reference.path;
  const MeasuredPoints measured =
      map ? measure_map_points(*map, rays, luminaires.size() > 0, points, asked.points, options)
          : measure_points(rays, luminaires, points, method_of(reference),
                           ways_of(rays, luminaires, reference.path), options);
  tool.stat("samples", measured.samples);
  if (measured.rejected > 0) tool.counters().count(kNonFiniteSampleEvent, measured.rejected);
  tool.counters().require_allowed(kNonFiniteSampleEvent, measured.samples);
  measured.doubts.tell(tool);
  tell_error(tool, row_of(reference.method));
  write_text(tool, sensor_csv(points, measured.light, rays.scene().origin_m));
}

std::string error_text(double error) {
  return text(", standard error ", shortest(static_cast<float>(100 * error)),
              " % of the mean luminance (RMS)");
}

void render(Tool& tool, const Scene& scene, const RayScene& rays, const Luminaires& luminaires,
            ReferenceOptions reference, const MapLight* map) {
  const std::vector<LightWay> ways =
      map ? std::vector<LightWay>() : ways_of(rays, luminaires, reference.path);
  const double pixels = static_cast<double>(reference.width) * static_cast<double>(reference.height);
  const bool both_ends =
      is_bidirectional(method_of(reference), scene, ways, pixels * static_cast<double>(reference.samples));
  if (const auto inside = camera_inside_solid(rays, find_camera(scene, reference.camera))) tool.warn(*inside);
  if (!map) reference.method = both_ends ? ReferenceMethod::bidirectional : ReferenceMethod::path;
  const std::string takes = require_memory(text("a picture of ", reference.width, " x ", reference.height),
                                           reference_bytes(reference), "give a smaller --width");
  if (!takes.empty()) tool.say(takes);
  ReferencePicture picture = [&] {
    const auto timer = tool.time("trace");
    return render_reference(rays, luminaires, find_camera(scene, reference.camera), reference, map);
  }();
  tool.counters().merge(picture.counters);
  tool.stat("samples", picture.image.pixels() * static_cast<std::uint64_t>(picture.samples));
  tool.stat("samples a pixel", picture.samples);
  bool stated = can_state_error(tool, both_ends ? std::vector<LightWay>() : ways, picture);
  if (row_of(reference.method).gloss_by_photons) stated = sees_gloss(tool, scene, reference.map) && stated;
  if (stated)
    tell_error(tool, row_of(reference.method));
  else
    picture.image = without_errors(picture.image);
  if (!scene.animation.empty()) picture.image.attributes[kFramesPerSecond] = shortest(scene.frames_per_s);
  set_provenance(picture.image, tool.provenance(FileKind::image, scene.hash, scene.parts));
  picture.image.attributes["phos.samples"] = std::to_string(picture.samples);
  if (stated) picture.image.attributes["phos.error"] = shortest(picture.error);
  if (stated && map) picture.image.attributes["phos.error_of"] = row_of(reference.method).error_of;
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
  const InputFiles files = sort_inputs(asked.inputs, Beside::files);
  check_method(tool.options(), files, asked, tool.frames().has_value());
  record_map_options(tool.options(), reference);
  take_site(tool, files.phos, asked.allow_mismatch);
  tool.add_input("scene", scene_files(files.scene, asked.scene));
  if (!files.phos.empty()) tool.add_input("photons", files.phos.front());
  if (!asked.points.empty()) tool.add_input("points", asked.points);
  reference.seed = tool.seed();
  if (asked.points.empty()) {
    tool.set_provenance_reader(read_image_provenance);
    if (tool.up_to_date()) return;
  }
  const Scene scene = [&] {
    const auto timer = tool.time("load scene");
    return load_scene(files.scene, asked.scene);
  }();
  tell_losses(tool, scene);
  if (reference.adaptive && !row_of(reference.method).shares_samples)
    throw Error(ExitCode::usage, "--adaptive",
                "shares out paths from the eye alone; leave it out, or give --method path");
  std::vector<SensorPoint> points;
  if (!asked.points.empty())
    points = parse_sensor_points(read_text(asked.points), asked.points, scene.origin_m);
  if (const auto frames = tool.frames()) require_frames(scene, *frames);
  if (asked.points.empty()) resolve_size(reference, find_camera(scene, reference.camera));
  if (scene.light.empty()) tool.warn("the scene has no light: everything will be black");
  const RayScene rays(scene);
  if (const auto nested = nested_glass(rays)) tool.warn(*nested);
  for (const SensorPoint& p : points) require_in_air(rays, p.position, p.normal, asked.points);
  const Luminaires luminaires(scene);
  if (row_of(reference.method).reads_map() && reference.illuminance && asked.points.empty())
    require_photons_everywhere(scene);
  const MapInput map = open_map(tool, files, scene, rays, luminaires, asked);
  if (asked.points.empty())
    render(tool, scene, rays, luminaires, reference, map.light.get());
  else
    measure_points(tool, rays, luminaires, asked, map.light.get(), points);
}

}  // namespace phos::stage
