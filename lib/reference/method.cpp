#include "reference/method.h"

#include "scene/material/sharp_materials.h"
#include "scene/report/unsampled.h"

namespace phos::inline reference {

void declare_method(Options& options, ReferenceMethod& method, const std::string& help) {
  options.choice<ReferenceMethod>("method", method,
                                  {{"auto", ReferenceMethod::automatic},
                                   {"path", ReferenceMethod::path},
                                   {"bidirectional", ReferenceMethod::bidirectional}},
                                  help);
}

bool is_bidirectional(ReferenceMethod method, const Scene& scene, const std::vector<LightWay>& ways,
                      double samples) {
  if (method != ReferenceMethod::automatic) return method == ReferenceMethod::bidirectional;
  return (!scene.light.empty() && gathers_light(scene)) ||
         !unsampled(ways, Sampler::path_tracing, samples).empty();
}

}  // namespace phos::inline reference
