#include <gtest/gtest.h>

#include "cache/placement.h"
#include "core/error.h"
#include "support/run.h"

namespace phos {
namespace {

std::string file_with(const std::string& content) {
  const std::string path = test::scratch("points") + "/p.csv";
  test::spill(path, content);
  return path;
}

std::string error_of(const std::string& content) {
  try {
    read_points(file_with(content));
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    return e.what();
  }
  return "";
}

TEST(Points, ColumnsInAnyOrderWithUnitsAndComments) {
  const auto points = read_points(
      file_with("# made by hand\nid,nx,ny,nz,x [m],y_m,\"z\"\r\n7,0,0,2,1,2,3\n\n8,1,0,0,-1e-3,0,0"));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(points[0].normal, Vec3(0, 0, 1));
  EXPECT_EQ(points[1].position, Vec3(-1e-3f, 0, 0));
}

TEST(Points, HeaderAloneIsNoPoint) { EXPECT_TRUE(read_points(file_with("x,y,z,nx,ny,nz\n")).empty()); }

TEST(Points, FaultsAreNamed) {
  EXPECT_NE(error_of("").find("empty"), std::string::npos);
  EXPECT_NE(error_of("x,y,nx,ny,nz\n").find("no column z"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3\n").find("line 2"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3,0,0,1\n1,nan,3,0,0,1\n").find("line 3: column y"),
            std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3,0,0,0\n").find("normal is zero"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3b,0,0,1\n").find("column z"), std::string::npos);
}

}  // namespace
}  // namespace phos
