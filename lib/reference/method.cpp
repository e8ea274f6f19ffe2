#include "reference/method.h"

#include "scene/light_ways.h"

namespace phos {

void declare_method(Options& options, ReferenceMethod& method, const std::string& help) {
  options.choice<ReferenceMethod>("method", method,
                                  {{"auto", ReferenceMethod::automatic},
                                   {"path", ReferenceMethod::path},
                                   {"bidirectional", ReferenceMethod::bidirectional}},
                                  help);
}

bool is_bidirectional(ReferenceMethod method, const Scene& scene) {
  return method == ReferenceMethod::bidirectional ||
         (method == ReferenceMethod::automatic && has_caustic_ways(scene));
}

}  // namespace phos
