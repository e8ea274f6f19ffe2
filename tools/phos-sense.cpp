// phos-sense: illuminance at sensor points.
#include "stage/sense.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-sense"),
            "Direct light comes from shadow rays, indirect light from irradiance and radiance caches. Where "
            "the caches have no record, as on a workplane in free air, a record is made by rays that read "
            "the caches. Writes CSV to -o or stdout: id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx. "
            "With --bands these columns count the light in the triplet's bands, and columns band_K_of_N_lx "
            "follow, which phos-bands joins.",
            stage::kSenseAlgorithm, Tool::Output::optional);
  tool.takes_strict();
  tool.output_has_no_key();
  stage::SenseCommand asked;
  Options& options = tool.options();
  options.inputs("SCENE [CACHE]", asked.inputs,
                 "scene (.glb, .gltf, .obj), and its irradiance and radiance caches");
  declare_options(options, asked.scene);
  tool.takes_frames(asked.scene.frame);
  options.section("Sensors");
  options.file("points", asked.points,
               "sensors: CSV with the columns x,y,z,nx,ny,nz in metres, and id where wanted, or six numbers "
               "a line; - is stdin");
  declare_options(options, asked.grid);
  options.text("part", asked.part, "K/N",
               "read only part K of N of the sensors, for several machines: with the lines of the parts one "
               "after another, the file is the one of the whole run. The caches must have a record for each "
               "sensor (phos-irradiance --place every)",
               Recorded::no);
  options.section("Light");
  declare_options(options, asked.sense);
  options.flag("exact", asked.exact, "trace paths at each sensor instead of reading caches");
  options.integer("samples", asked.exactly.samples, "N",
                  "with --exact: largest number of paths for each sensor", {2, 1e12});
  options.number("error", asked.exactly.relative_error, "SHARE",
                 "standard error to reach, as a share of the illuminance: direct light takes as many shadow "
                 "rays as needed, at most 4096 to each lamp (default: 0.01); with --exact, a sensor takes no "
                 "more paths once its illuminance reaches it (default: all --samples are taken)",
                 kPositive);
  declare_method(options, asked.method,
                 "with --exact: path: paths from the sensor alone, which miss light that comes from small "
                 "lamps by mirrors and glass; bidirectional: paths from sensor and lamps; auto: "
                 "bidirectional where the scene has mirrors, smooth glass or sharp gloss, else path");
  declare_isa(options, asked.isa);
  options.flag(
      "daylight-factor", asked.factors,
      "add two columns: the daylight factor, which is E_lx in percent of the illuminance in the open under "
      "the same sky, and its standard error. Give --sky overcast; sun and lamps are refused",
      Recorded::if_given);
  options.file("summary", asked.summary,
               "also write mean, least and greatest illuminance and uniformity to this file, as JSON",
               FileUse::written);
  options.flag("allow-mismatch", asked.allow_mismatch,
               "accept caches of another scene, or of another version of the scene");
  options.example("phos-sense room.glb room.irradiance --grid 0.5 --height 0.8 --margin 0.5 -o desk.csv",
                  "a workplane");
  options.example("phos-sense room.glb room.irradiance --points sensors.csv", "given points, to stdout");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
