// Photons of the Cornell box, traced by the program.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/run.h"

namespace phos::test {

/// A folder of this name that holds c.photons, of so many paths.
inline std::string folder_with_photons(const std::string& name, const std::string& paths) {
  const std::string folder = scratch(name);
  const Run run =
      run_tool({"photons", data("cornell-measured.glb"), "--photons", paths, "-o", folder + "/c.photons"});
  EXPECT_EQ(run.code, 0) << run.err;
  return folder;
}

}  // namespace phos::test
