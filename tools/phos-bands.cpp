// phos-bands: joins results that were computed in bands of wavelength.
#include "stage/bands.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-bands"),
            "Takes the results of every triplet of --bands N. Pictures of phos-splat or phos-reference "
            "become one picture in linear Rec.709, cd/m2, with the same layers. Tables of phos-sense become "
            "one table: lux and its standard error (at most the sum of the triplets' errors), CIE 1931 X, Y, "
            "Z in lx, correlated colour temperature (CCT), Duv (CIE 1960), the colour rendering index Ra of "
            "the light at each sensor (CIE 13.3-1995, in the bands), and the spectrum as each band's share "
            "of the lux. CCT, Duv and Ra are empty where the light is unlike any Planckian light (Duv beyond "
            "0.05, or CCT beyond 1000 to 25000 K). Other columns are left out.",
            stage::kBandsAlgorithm, Tool::Output::optional);
  stage::BandsCommand asked;
  Options& options = tool.options();
  options.inputs("PART", asked.parts, "the pictures (.exr) of all triplets, or their tables (.csv)");
  options.list(
      "dark", asked.dark, "K",
      "number of a triplet in which no lamp shines, so that its part is missing; several may be given");
  options.example("phos-bands room-*.exr -o room.exr", "a picture");
  options.example("phos-bands lux-*.csv --dark 1,13 -o lux.csv", "readings of sensors");
  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
