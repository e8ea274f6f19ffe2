#include "image/pixel_table.h"

#include <span>
#include <vector>

#include "core/error.h"
#include "core/json.h"
#include "image/metrics.h"

namespace phos::inline image {

std::string pixel_csv(const Image& image, const std::string& layer) {
  std::string out = "x,y";
  std::vector<std::span<const float>> channels;
  for (const std::string& component : components_of(image, layer)) {
    const std::string name = component.empty() ? layer : channel_name(layer, component);
    out.append(",").append(name);
    channels.push_back(image.channel(name));
  }
  if (channels.empty())
    throw Error(ExitCode::bad_input, "", text("the image has no layer \"", layer_label(layer), "\""));
  out.append("\n");
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const auto width = static_cast<std::size_t>(image.width());
    out.append(text(i % width, ",", i / width));
    for (const std::span<const float> channel : channels) out.append(",").append(shortest(channel[i]));
    out.append("\n");
  }
  return out;
}

}  // namespace phos::inline image
