#include "scene/gltf/stated_pane.h"

#include <algorithm>
#include <stdexcept>

#include "core/error.h"
#include "scene/material/pane.h"

namespace phos::inline scene {
namespace {

std::shared_ptr<const TransmittanceCurve> read_curve(const StatedBrdf& stated, const Json& table) {
  std::vector<TransmittanceCurve::Point> points;
  const auto malformed = [&]() {
    stated.fail("extras.phos.transmittance_by_angle must be pairs [degrees, share]");
  };
  if (!table.is_array()) malformed();
  for (const Json& pair : table.as_array()) {
    if (!pair.is_array() || pair.as_array().size() != 2 || !pair.as_array()[0].is_number() ||
        !pair.as_array()[1].is_number())
      malformed();
    points.push_back({pair.as_array()[0].as_number(), pair.as_array()[1].as_number()});
  }
  try {
    return std::make_shared<const TransmittanceCurve>(std::move(points));
  } catch (const std::runtime_error& e) {
    stated.fail(text("extras.phos.transmittance_by_angle ", e.what()));
  }
}

}  // namespace

void read_glass(const StatedBrdf& stated, Material& material) {
  if (material.alpha_x > 0 || material.alpha_y > 0)
    stated.warn("rough glass is not modelled: it is read as smooth");
  material.alpha_x = material.alpha_y = 0;
  material.tint = stated.colour("tint").value_or(Rgb(1));
  if (max_component(material.tint) > 1) stated.fail("extras.phos.tint must be at most 1");
  if (material.alpha_mode != Material::Alpha::blend) material.base_colour = TextureUse();
}

void read_pane(const StatedBrdf& stated, Material& material) {
  read_glass(stated, material);
  const Json* normal = stated.find("transmittance");
  const Json* by_angle = stated.find("transmittance_by_angle");
  if (normal && by_angle)
    stated.fail("extras.phos has both transmittance and transmittance_by_angle; give one of them");
  if (by_angle) material.curve = read_curve(stated, *by_angle);
  if (!normal) return;
  const Rgb t = normal->is_number() ? Rgb(stated.number("transmittance", 1))
                                    : stated.colour("transmittance").value_or(Rgb(1));
  for (int c = 0; c < 3; ++c) {
    const auto ior = static_cast<double>(material.ior), given = static_cast<double>(t[c]);
    const double most = static_cast<double>(pane_layer(1, material.ior, Rgb(1)).transmittance().x);
    if (given > most * (1 + 1e-6))
      stated.fail(text("extras.phos.transmittance ", shortest(t[c]), " cannot be: a pane of ior ",
                       shortest(ior), " without absorption has ", shortest(static_cast<float>(most))));
    material.inside[c] = static_cast<float>(std::min(internal_transmittance(given, ior), 1.0));
  }
}

}  // namespace phos::inline scene
