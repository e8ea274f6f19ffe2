// phos-info: shows the contents and the origin of a phos file.
#include "stage/info.h"

#include "file/inspect/rows.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(
      program("phos-info"),
      "Prints the kind of the file, the command, parameters and inputs that made it, and the shape, unit and "
      "range of each tensor. It also prints rows as CSV, points as PLY, and checks the file for damage.",
      stage::kInfoAlgorithm, Tool::Output::none);
  stage::InfoCommand asked;
  Options& options = tool.options();
  options.input("FILE", asked.path, "any phos file");
  options.section("What to print");
  options.flag("json", asked.json, "print the description as JSON");
  options.flag("canonical", asked.canonical,
               "print only facts that differences in rounding do not change (for comparing)");
  options.list("dump", asked.dump, "TENSOR",
               "print the rows of the tensor as CSV with a header line; several tensors stand side by side");
  options.flag("decode", asked.decode, "with --dump: print octahedral directions as x, y, z");
  options.flag("points", asked.points,
               "print positions as a PLY point cloud, coloured by irradiance or flux, with normals");
  options.choice<PlyFormat>("ply", asked.ply, {{"ascii", PlyFormat::ascii}, {"binary", PlyFormat::binary}},
                            "encoding of --points");
  options.flag("verify", asked.verify,
               "print nothing: exit code 0 if every checksum holds and every tensor fits its kind, 3 if not "
               "(--verbose names the fault)");
  options.file("output,o", asked.output, "print to this file (default: standard output)", FileUse::written);
  options.example("phos-info room.irradiance", "kind and origin of a file, and the range of each quantity");
  options.example("phos-info room.photons --dump position,flux > photons.csv",
                  "two columns for a spreadsheet");
  options.example("phos-info room.irradiance --points -o records.ply",
                  "the records for a point-cloud viewer");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
