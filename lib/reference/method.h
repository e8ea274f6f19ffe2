// By which paths a reference is computed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/options.h"
#include "scene/report/light_ways.h"

namespace phos::inline reference {

enum class ReferenceMethod : std::uint8_t {
  automatic,      ///< bidirectional where path tracing leaves light out, else path
  path,           ///< from the eye or sensor (path_tracer.h)
  bidirectional,  ///< from both ends (bidirectional.h)
};

/// The option --method.
void declare_method(Options& options, ReferenceMethod& method, const std::string& help);

/// Is the method bidirectional, `automatic` resolved: where something casts caustics, or path tracing with so
/// many samples leaves out one of these ways?
bool is_bidirectional(ReferenceMethod method, const Scene& scene, const std::vector<LightWay>& ways,
                      double samples);

}  // namespace phos::inline reference
