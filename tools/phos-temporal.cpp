// phos-temporal: places records that live through the frames of an animation.
#include "stage/temporal.h"

#include "splat/gl/choice.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-temporal"),
            "Objects, lamps and the camera move: records are anchored to the surfaces that they lie on, and "
            "the light at "
            "each is computed at as few frames as its change allows, with the same random numbers at all of "
            "them. Between "
            "these frames phos-splat --frames (or --frame) interpolates. Photons are traced here, where they "
            "are needed, for "
            "the frames that need them. Places that the camera no longer sees are given up. A scene in which "
            "no light "
            "changes gives an ordinary cache. Inputs, in any order: a scene; for radiance records its .brdf "
            "file (else "
            "lobes are projected here); and for irradiance records the radiance film of the same frames, "
            "whose surfaces then "
            "get none of their own.",
            stage::kTemporalAlgorithm);
  stage::TemporalCommand asked;
  Options& options = tool.options();
  options.inputs("SCENE [BRDF] [RADIANCE]", asked.inputs,
                 "animated scene (.glb, .gltf); its .brdf file; a radiance film");
  declare_frames(options, asked.frames);
  options.choice<stage::RecordKind>(
      "kind", asked.kind,
      {{"irradiance", stage::RecordKind::irradiance}, {"radiance", stage::RecordKind::radiance}},
      "of records: irradiance for diffuse surfaces, radiance for glossy ones");
  declare_options(options, asked.job.options);
  declare_light_options(options, asked.scene);
  declare_options(options, asked.gloss);
  declare_options(options, asked.job.light.records);
  declare_raster_options(options, asked.job.light.records, Recorded::unless_default);
  declare_place_options(options, asked.job.placement);
  declare_isa(options, asked.isa);
  declare_gl(options, asked.gl);
  tool.takes_strict();
  options.example("phos-temporal room.glb --frames 0:199 -o room.irradiance",
                  "200 frames of what the first camera sees");
  options.example("phos-splat room.glb room.irradiance --frames 0:199 -o room/%04d.exr", "their pictures");
  options.example("phos-temporal room.glb --frames 0:199 --kind radiance -o room.radiance",
                  "the same for what is glossy there");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
