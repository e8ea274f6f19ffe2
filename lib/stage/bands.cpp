#include "stage/bands.h"

#include <charconv>

#include "core/error.h"
#include "file/atomic_file.h"
#include "file/mapped_file.h"
#include "image/image.h"
#include "image/image_provenance.h"
#include "scene/spectral/join_parts.h"
#include "scene/spectral/join_pictures.h"
#include "scene/spectral/join_readings.h"

namespace phos::stage {
namespace {

void join_to_picture(Tool& tool, const BandParts& parts) {
  if (tool.output().empty())
    throw Error(ExitCode::usage, "-o", "a picture needs an output file: -o room.exr");
  tool.set_provenance_reader(read_image_provenance);
  if (tool.up_to_date()) return;
  JoinedPicture joined = join_pictures(parts);
  set_provenance(joined.image, tool.provenance(FileKind::image, "", Json()));
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

void run(Tool& tool, const BandsCommand& asked) {
  BandParts parts;
  parts.paths = asked.parts;
  for (const std::string& word : asked.dark) {
    int k = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), k);
    if (error != std::errc() || end != word.data() + word.size() || k < 1)
      throw Error(ExitCode::usage, "--dark", text("\"", word, "\" is no triplet; they count from 1"));
    parts.dark.push_back(k);
  }
  join(tool, parts);
}

}  // namespace phos::stage
