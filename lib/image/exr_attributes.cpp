// The text attributes of an OpenEXR file, without its pixels.
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "core/error.h"
#include "image/image.h"

namespace phos {

std::map<std::string, std::string> read_exr_attributes(const std::string& path) {
  std::map<std::string, std::string> attributes;
  try {
    const Imf::MultiPartInputFile file(path.c_str(), 0, false);
    const Imf::Header& header = file.header(0);
    for (auto a = header.begin(); a != header.end(); ++a)
      if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
        attributes[a.name()] = s->value();
  } catch (const std::exception&) {
    throw Error(ExitCode::bad_input, path, "not a readable OpenEXR file; make it again");
  }
  return attributes;
}

}  // namespace phos
