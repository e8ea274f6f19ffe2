// By which paths a reference is computed.
#pragma once

#include <cstdint>
#include <string>

#include "core/options.h"
#include "scene/scene.h"

namespace phos {

enum class ReferenceMethod : std::uint8_t {
  automatic,      ///< bidirectional where has_caustic_ways(), else path
  path,           ///< from the eye or sensor (path_tracer.h)
  bidirectional,  ///< from both ends (bidirectional.h)
};

/// The option --method.
void declare_method(Options& options, ReferenceMethod& method, const std::string& help);

/// Is the method, `automatic` resolved, bidirectional?
bool is_bidirectional(ReferenceMethod method, const Scene& scene);

}  // namespace phos
