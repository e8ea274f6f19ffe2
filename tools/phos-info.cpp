// phos-info: says what a phos file holds and how it was made.
#include "stage/info.h"

#include "file/inspect/rows.h"

int main(int argc, char** argv) {
  using namespace phos;
  Tool tool(program("phos-info"),
            "Prints the kind of the file, the command, parameters and inputs that made it, and of each "
            "tensor its shape, "
            "unit and range. Also its rows as CSV, its points as PLY, and whether it is undamaged.",
            stage::kInfoAlgorithm, Tool::Output::none);
  stage::InfoCommand asked;
  Options& options = tool.options();
  options.input("FILE", asked.path, "any phos file");
  options.section("What to print");
  options.flag("json", asked.json, "the description as JSON");
  options.flag("canonical", asked.canonical,
               "only what a difference in rounding leaves as it is (for comparing)");
  options.list("dump", asked.dump, "TENSOR",
               "the tensor's rows as CSV with a header line; several side by side");
  options.flag("decode", asked.decode, "with --dump: octahedral directions as x, y, z");
  options.flag("points", asked.points,
               "positions as a PLY point cloud, coloured by irradiance or flux, with normals");
  options.choice<PlyFormat>("ply", asked.ply, {{"ascii", PlyFormat::ascii}, {"binary", PlyFormat::binary}},
                            "encoding of --points");
  options.flag("verify", asked.verify,
               "print nothing: exit 0 if every checksum holds and every tensor is what its kind says, 3 if "
               "not (--verbose says which)");
  options.file("output,o", asked.output, "print there instead of on standard output", FileUse::written);
  options.example("phos-info room.irradiance", "what it is, how it was made, and the range of each quantity");
  options.example("phos-info room.photons --dump position,flux > photons.csv",
                  "two columns for a spreadsheet");
  options.example("phos-info room.irradiance --points -o records.ply",
                  "the records for a point-cloud viewer");

  return tool.run(argc, argv, [&] { stage::run(tool, asked); });
}
