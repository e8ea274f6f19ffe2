#include "reference/method.h"

#include "scene/unsampled.h"

namespace phos {

void declare_method(Options& options, ReferenceMethod& method, const std::string& help) {
  options.choice<ReferenceMethod>("method", method,
                                  {{"auto", ReferenceMethod::automatic},
                                   {"path", ReferenceMethod::path},
                                   {"bidirectional", ReferenceMethod::bidirectional}},
                                  help);
}

bool is_bidirectional(ReferenceMethod method, const std::vector<LightWay>& ways, double samples) {
  return method == ReferenceMethod::bidirectional ||
         (method == ReferenceMethod::automatic && !unsampled(ways, Sampler::path_tracing, samples).empty());
}

}  // namespace phos
