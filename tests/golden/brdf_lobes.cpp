// Tables of glossy reflection, an isotropic and an anisotropic one: what the file says of itself, exactly,
// and the range of each column.
#include "support/golden_cornell.h"

namespace phos::test {
namespace {

class GoldenBrdf : public GoldenCornell {
 protected:
  /// Of the anisotropic lobe, some directions keep fewer bands than others, and some are traced.
  static void make() {
    if (std::filesystem::exists(path("brdf"))) return;
    const test::Run run = run_tool({"brdf", data("lobes.gltf"), "--resolution", "8", "--max-order", "6",
                                    "--error", "0.05", "--quiet", "-o", path("brdf")});
    ASSERT_EQ(run.code, 0) << run.err;
  }
};

TEST_F(GoldenBrdf, SaysWhatItIs) {
  make();
  expect_golden_text("brdf-lobes.txt", canonical(path("brdf")));
}

TEST_F(GoldenBrdf, HoldsTheLobesItHeld) {
  make();
  expect_golden_numbers("brdf-lobes.json", ranges_of(path("brdf")), 1e-4);
}

}  // namespace
}  // namespace phos::test
