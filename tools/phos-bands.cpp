// phos-bands: the results of all triplets of bands -> one picture or one table.
#include <charconv>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/mapped_file.h"
#include "file/tool.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "scene/spectral/join_bands.h"

using namespace phos;

namespace {

void join_to_picture(Tool& tool, const BandParts& parts) {
  if (tool.output().empty())
    throw Error(ExitCode::usage, "-o", "a picture needs an output file: -o room.exr");
  tool.set_provenance_reader(read_image_provenance);
  if (tool.up_to_date()) return;
  JoinedPicture joined = join_pictures(parts);
  set_provenance(joined.image, tool.provenance("image", "", Json()));
  write_exr(tool.output(), joined.image);
  tool.stat("pixels_beyond_rec709", joined.beyond);
  tool.say(text(tool.output(), ": ", joined.image.width(), " x ", joined.image.height(), " from ",
                joined.bands, " bands"));
  if (joined.beyond > 0)
    tool.say(text(joined.beyond, " pixels have colours beyond Rec.709, as negative components"));
}

void join_to_table(Tool& tool, const BandParts& parts) {
  const std::string table = join_readings(parts);
  AtomicFile file(tool.output().empty() ? "/dev/stdout" : tool.output());
  file.write(table);
  file.commit();
}

void join(Tool& tool, const BandParts& parts) {
  bool pictures = false, tables = false;
  for (const std::string& path : parts.paths) {
    require_bytes(path);
    tool.add_input("part", path);
    (is_image(read_text(path)) ? pictures : tables) = true;
  }
  if (pictures && tables)
    throw Error(ExitCode::usage, parts.paths.back(), "pictures and tables are joined each on their own");
  if (pictures)
    join_to_picture(tool, parts);
  else
    join_to_table(tool, parts);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      "phos-bands", "joins what was computed in bands of wavelength",
      "Takes the results of every triplet of --bands N. Pictures (of phos-splat or phos-reference) become "
      "one "
      "in linear Rec.709, cd/m2, with the same layers. Tables of phos-sense become one: lux and its "
      "standard error (at most the sum of the triplets'), CIE 1931 X, Y, Z in lx, correlated colour "
      "temperature, Duv (CIE 1960), the colour rendering index Ra of the light at each sensor (CIE "
      "13.3-1995, in the bands), and its spectrum: each band's share of the lux. CCT, Duv and Ra are empty "
      "where the light is unlike any Planckian one (Duv beyond 0.05, or beyond 1000 to 25000 K). Other "
      "columns "
      "are left out.",
      1, Tool::Output::optional);
  BandParts parts;
  std::vector<std::string> dark;
  Options& options = tool.options();
  options.inputs("PART", parts.paths, "the pictures (.exr) of all triplets, or their tables (.csv)");
  options.list("dark", dark, "K", "triplets in which no lamp shines, so that there is no part");
  options.example("phos-bands room-*.exr -o room.exr", "a picture");
  options.example("phos-bands lux-*.csv --dark 1,13 -o lux.csv", "readings of sensors");
  return tool.run(argc, argv, [&] {
    for (const std::string& word : dark) {
      int k = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), k);
      if (error != std::errc() || end != word.data() + word.size() || k < 1)
        throw Error(ExitCode::usage, "--dark", text("\"", word, "\" is no triplet; they count from 1"));
      parts.dark.push_back(k);
    }
    join(tool, parts);
  });
}
