#include "image/image_provenance.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "core/error.h"

namespace phos::inline image {

namespace {

const std::string kPrefix = "phos.";

}  // namespace

void set_provenance(Image& image, const Provenance& provenance) {
  for (const auto& [key, value] : to_metadata(provenance)) image.attributes[kPrefix + key] = value;
}

std::optional<Provenance> read_image_provenance(const std::string& path) {
  Metadata metadata;
  try {
    const Imf::MultiPartInputFile file(path.c_str(), 0, false);
    const Imf::Header& header = file.header(0);
    for (auto a = header.begin(); a != header.end(); ++a) {
      const auto* s = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
      const std::string name = a.name();
      if (s != nullptr && name.starts_with(kPrefix)) metadata[name.substr(kPrefix.size())] = s->value();
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    throw Error(ExitCode::bad_input, path, "not a readable OpenEXR file; make it again");
  }
  if (!metadata.contains("key")) return std::nullopt;
  return from_metadata(metadata, path);
}

}  // namespace phos::inline image
