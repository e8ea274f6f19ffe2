// For tests that draw by OpenGL.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

namespace phos::test {

/// Mesa keeps no cache of shaders: each run compiles them.
class GlEnvironment : public ::testing::Environment {
 public:
  void SetUp() override { setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); }
};
inline const auto* const kGlEnvironment = ::testing::AddGlobalTestEnvironment(new GlEnvironment);

}  // namespace phos::test
