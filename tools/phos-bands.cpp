// phos-bands: joins what was computed in bands of wavelength.
#include "stage/bands.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-bands"),
      "Takes the results of every triplet of --bands N. Pictures (of phos-splat or phos-reference) become "
      "one "
      "in linear Rec.709, cd/m2, with the same layers. Tables of phos-sense become one: lux and its "
      "standard error (at most the sum of the triplets'), CIE 1931 X, Y, Z in lx, correlated colour "
      "temperature, Duv (CIE 1960), the colour rendering index Ra of the light at each sensor (CIE "
      "13.3-1995, in the bands), and its spectrum: each band's share of the lux. CCT, Duv and Ra are empty "
      "where the light is unlike any Planckian one (Duv beyond 0.05, or beyond 1000 to 25000 K). Other "
      "columns "
      "are left out.",
      stage::kBandsAlgorithm, Tool::Output::optional);
  stage::BandsCommand asked;
  Options& options = tool.options();
  options.inputs("PART", asked.parts, "the pictures (.exr) of all triplets, or their tables (.csv)");
  options.list("dark", asked.dark, "K", "triplets in which no lamp shines, so that there is no part");
  options.example("phos-bands room-*.exr -o room.exr", "a picture");
  options.example("phos-bands lux-*.csv --dark 1,13 -o lux.csv", "readings of sensors");
  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
