// Sensors where none can be meant: no standard error is stated for them.
#include <gtest/gtest.h>

#include "support/run.h"

namespace phos::test {
namespace {

TEST(Sense, StatesNoErrorInsideOfSolids) {
  const std::string folder = scratch("sense_inside"), scene = folder + "/room.obj",
                    points = folder + "/points.csv";
  // A block of a metre stands on a floor, under a lamp of a square metre that faces down.
  spill(folder + "/room.mtl", "newmtl grey\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 1000 1000 1000\n");
  spill(scene,
        "mtllib room.mtl\n"
        "v -3 0 -3\nv 3 0 -3\nv 3 0 3\nv -3 0 3\n"
        "v -.5 0 -.5\nv .5 0 -.5\nv .5 0 .5\nv -.5 0 .5\nv -.5 1 -.5\nv .5 1 -.5\nv .5 1 .5\nv -.5 1 .5\n"
        "v -.5 3 -.5\nv .5 3 -.5\nv .5 3 .5\nv -.5 3 .5\n"
        "usemtl grey\nf 1 4 3 2\n"
        "f 9 12 11 10\nf 5 6 7 8\nf 5 9 10 6\nf 6 10 11 7\nf 7 11 12 8\nf 8 12 9 5\n"
        "usemtl lamp\nf 13 14 15 16\n");
  spill(points, "x,y,z,nx,ny,nz\n2,0.1,2,0,1,0\n0,0.5,0,0,1,0\n");
  const auto r = run_tool({"sense", scene, "--exact", "--samples", "256", "--points", points});
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("1 sensors are inside of solids or behind walls (the first is number 1)"),
            std::string::npos)
      << r.err;
  EXPECT_NE(r.out.find("\n1,0,0.5,0,0,1,0,0,,"), std::string::npos) << r.out;
  EXPECT_EQ(r.out.substr(0, r.out.find("\n1,")).find(",,"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace phos::test
