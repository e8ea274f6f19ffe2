// phos-temporal: places records that live through the frames of an animation.
#include "stage/temporal.h"

#include "splat/gl/choice.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-temporal"),
            "Objects, lamps and the camera may move: records are anchored to the surfaces that they lie on, "
            "and the light at each record is computed at as few frames as its change allows, with the same "
            "random numbers at all of these frames. Between these frames phos-splat --frames (or --frame) "
            "interpolates. Photons are traced here, for the frames that need them. Records are given up at "
            "places that the camera no longer sees. A scene in which no light changes gives an ordinary "
            "cache. Inputs, in any order: a scene; for radiance records its .brdf file (without one, lobes "
            "are projected here); and for irradiance records the radiance film of the same frames: surfaces "
            "that its records cover get no irradiance records.",
            stage::kTemporalAlgorithm);
  stage::TemporalCommand asked;
  Options& options = tool.options();
  options.inputs("SCENE [BRDF] [RADIANCE]", asked.inputs,
                 "animated scene (.glb, .gltf), its .brdf file, and a radiance film");
  declare_frames(options, asked.frames);
  options.choice<stage::RecordKind>(
      "kind", asked.kind,
      {{"irradiance", stage::RecordKind::irradiance}, {"radiance", stage::RecordKind::radiance}},
      "kind of the records: irradiance: for diffuse surfaces; radiance: for glossy surfaces");
  declare_options(options, asked.job.options);
  declare_light_options(options, asked.scene);
  declare_options(options, asked.gloss);
  declare_options(options, asked.store);
  declare_options(options, asked.job.light.records);
  declare_footprint_options(options, asked.job.light.records);
  declare_raster_options(options, asked.job.light.records, Recorded::unless_default);
  declare_place_options(options, asked.job.placement);
  declare_isa(options, asked.isa);
  declare_gl(options, asked.gl);
  tool.takes_strict();
  options.example("phos-temporal room.glb --frames 0:199 -o room.irradiance",
                  "200 frames of the view of the first camera");
  options.example("phos-splat room.glb room.irradiance --frames 0:199 -o room/%04d.exr", "their pictures");
  options.example("phos-temporal room.glb --frames 0:199 --kind radiance -o room.radiance",
                  "the same on glossy surfaces");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
