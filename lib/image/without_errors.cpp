#include "image/without_errors.h"

#include <algorithm>

namespace phos::inline image {

Image without_errors(const Image& image) {
  Image out(image.width(), image.height());
  out.attributes = image.attributes;
  for (const auto& [name, values] : image.channels()) {
    const std::string layer = name.substr(0, name.rfind('.'));
    if (layer == "stderr" || layer.ends_with("_stderr")) continue;
    std::copy(values.begin(), values.end(), out.channel(name).begin());
  }
  return out;
}

}  // namespace phos::inline image
