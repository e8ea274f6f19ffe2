// phos-sense: illuminance at sensor points.
#include "stage/sense.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-sense"),
            "Direct light comes from shadow rays, indirect light from irradiance and radiance caches; where "
            "these have no "
            "record (a workplane in free air) records are made by rays that read the caches. Writes CSV: "
            "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx, to -o or stdout. With --bands all these "
            "are of "
            "the light in the triplet's bands, and band_K_of_N_lx follow, for phos-bands to join.",
            stage::kSenseAlgorithm, Tool::Output::optional);
  tool.takes_strict();
  tool.output_has_no_key();
  stage::SenseCommand asked;
  Options& options = tool.options();
  options.inputs("SCENE [CACHE]", asked.inputs,
                 "scene (.glb, .gltf, .obj), irradiance and radiance caches of it");
  declare_options(options, asked.scene);
  tool.takes_frames(asked.scene.frame);
  options.section("Sensors");
  options.file(
      "points", asked.points,
      "sensors: CSV with the columns x,y,z,nx,ny,nz and perhaps id, or six numbers a line; - is stdin");
  declare_options(options, asked.grid);
  options.section("Light");
  declare_options(options, asked.sense);
  options.flag("exact", asked.exact, "path tracing at each sensor instead of caches");
  options.integer("samples", asked.exactly.samples, "N", "paths for each sensor with --exact, at most",
                  {2, 1e12});
  options.number(
      "error", asked.exactly.relative_error, "SHARE",
      "standard error to reach, relative to the illuminance: of direct light, by as many shadow rays as that "
      "takes, at most 4096 to each lamp (default: 0.01); with --exact of all light, where paths end before "
      "--samples (default: all of them)",
      kPositive);
  declare_method(
      options, asked.method,
      "with --exact: path: from the sensor alone, which does not find what comes from small lamps by "
      "mirrors and glass; bidirectional: from sensor and lamps; auto: bidirectional where the scene "
      "has mirrors, smooth glass or sharp gloss");
  declare_isa(options, asked.isa);
  options.flag(
      "daylight-factor", asked.factors,
      "two more columns: E_lx and its standard error in percent of the illuminance in the open under "
      "the same sky (--sky overcast, by the norm; no sun, no lamps)",
      Recorded::if_given);
  options.file("summary", asked.summary, "also write mean, least, greatest and uniformity there, as JSON",
               FileUse::written);
  options.flag("allow-mismatch", asked.allow_mismatch,
               "use caches of another scene or another version of it");
  options.example("phos-sense room.glb room.irradiance --grid 0.5 --height 0.8 --margin 0.5 -o desk.csv",
                  "a workplane");
  options.example("phos-sense room.glb room.irradiance --points sensors.csv", "given points, to stdout");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
