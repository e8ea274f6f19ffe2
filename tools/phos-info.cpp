// phos-info: what a phos file holds and how it was made.
#include <cstdio>
#include <memory>

#include "file/atomic_file.h"
#include "file/inspect.h"
#include "file/tool.h"

using namespace phos;

namespace {

struct Request {
  std::string path, output;
  std::vector<std::string> dump;
  bool json = false, canonical = false, points = false, verify = false, decode = false;
  PlyFormat ply = PlyFormat::ascii;
};

void declare(Options& o, Request& r) {
  o.input("FILE", r.path, "any phos file");
  o.section("What to print");
  o.flag("json", r.json, "the description as JSON");
  o.flag("canonical", r.canonical, "only what a difference in rounding leaves as it is (for comparing)");
  o.list("dump", r.dump, "TENSOR", "the tensor's rows as CSV with a header line; several side by side");
  o.flag("decode", r.decode, "with --dump: octahedral directions as x, y, z");
  o.flag("points", r.points, "positions as a PLY point cloud, coloured by irradiance or flux, with normals");
  o.choice<PlyFormat>("ply", r.ply, {{"ascii", PlyFormat::ascii}, {"binary", PlyFormat::binary}},
                      "encoding of --points");
  o.flag("verify", r.verify,
         "print nothing: exit 0 if every checksum holds, 3 if not (--verbose says which)");
  o.file("output,o", r.output, "print there instead of on standard output", FileUse::written);
  o.example("phos-info room.irradiance", "what it is, how it was made, and the range of each quantity");
  o.example("phos-info room.photons --dump position,flux > photons.csv", "two columns for a spreadsheet");
  o.example("phos-info room.irradiance --points -o records.ply", "the records for a point-cloud viewer");
}

void verify(Tool& tool, const Request& r) {
  try {
    Container::open(r.path).verify();
  } catch (const Error& e) {
    if (e.code() != ExitCode::bad_input) throw;
    if (tool.verbose()) tool.say(e.where() + ": " + e.what());
    tool.set_exit(ExitCode::bad_input);
  }
}

void print(const Request& r, const Sink& sink) {
  const Container file = Container::open(r.path);
  if (!r.dump.empty()) {
    dump_csv(file, r.dump, r.decode, sink);
  } else if (r.points) {
    write_ply(file, r.ply, sink);
  } else if (r.json) {
    sink(describe(file).dump(2) + "\n");
  } else {
    sink(r.canonical ? canonical_text(file) : describe_text(file));
  }
}

void run(Tool& tool, const Request& r) {
  const int wanted = r.json + r.canonical + r.points + r.verify + !r.dump.empty();
  if (wanted > 1)
    throw Error(ExitCode::usage, "",
                "--json, --canonical, --dump, --points and --verify exclude each other; give one");
  if (r.verify) return verify(tool, r);
  AtomicFile file(r.output.empty() ? "/dev/stdout" : r.output);
  print(r, [&](std::string_view s) { file.write(s); });
  file.commit();
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("phos-info", "says what a phos file holds and how it was made",
            "Prints the kind of the file, the command, parameters and inputs that made it, and of each "
            "tensor its shape, "
            "unit and range. Also its rows as CSV, its points as PLY, and whether it is undamaged.",
            1, Tool::Output::none);
  Request request;
  declare(tool.options(), request);
  return tool.run(argc, argv, [&] { run(tool, request); });
}
