#include <gtest/gtest.h>

#include "core/error.h"
#include "place/placement.h"
#include "place/read_points.h"
#include "sense/sensor_points.h"
#include "sense/sensors.h"
#include "support/complaint.h"
#include "support/run.h"

namespace phos {
namespace {

std::string file_with(const std::string& content) {
  const std::string path = test::scratch("points") + "/p.csv";
  test::spill(path, content);
  return path;
}

std::string error_of(const std::string& content) {
  return test::complaint_of([&] { read_points(file_with(content)); });
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
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3\n").find(":2:"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3,0,0,1\n1,nan,3,0,0,1\n").find(":3: column y"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3,0,0,0\n").find("normal is zero"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,2,3b,0,0,1\n").find("column z"), std::string::npos);
}

TEST(Points, SixNumbersALineAsRadianceHasThem) {
  const Sensors s = parse_sensors("\xef\xbb\xbf# desk\n 1 2\t3  0 0 -2\r\n+4 5e-1 6 0 1 0\n", "p");
  ASSERT_EQ(s.points.size(), 2u);
  EXPECT_EQ(s.points[0].normal, Vec3(0, 0, -1));
  EXPECT_EQ(s.points[1].position, Vec3(4, 0.5f, 6));
  EXPECT_TRUE(s.ids.empty());
  EXPECT_EQ(parse_sensors("1,2,3,0,0,1\n4,5,6,0,1,0", "p").points.size(), 2u);
  EXPECT_NE(error_of("1 2 3 0 0 1\n1 2 3 0 0\n").find(":2: has 5 columns"), std::string::npos);
  EXPECT_NE(error_of("1 2 3 0 0 1\n1 2 3 0 0 1 7\n").find(":2: has 7 columns"), std::string::npos);
  EXPECT_NE(error_of("1 2 3e30 0 0 1\n").find(":1: column z is farther off"), std::string::npos);
  EXPECT_NE(error_of("1 2 3 0 0 1\n1 2 3 0 inf 1\n").find(":2: column ny"), std::string::npos);
}

TEST(Points, NamesMayHoldCommasAndQuotes) {
  const Sensors s = parse_sensors(
      "\"id\",x,y,z,nx,ny,nz\r\n\"desk, left\",1,2,3,0,0,1\n\"the \"\"big\"\" one\" "
      ",1,\"2\",3,0,0,1\n,1,2,3,0,0,1",
      "p");
  ASSERT_EQ(s.ids.size(), 3u);
  EXPECT_EQ(s.ids[0], "desk, left");
  EXPECT_EQ(s.ids[1], "the \"big\" one");
  EXPECT_EQ(s.ids[2], "");
  EXPECT_EQ(s.points[1].position, Vec3(1, 2, 3));
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,\"2,3,0,0,1\n").find(":2: a quote"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz\n1,\"2\"2,3,0,0,1\n").find("column 2 goes on"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz,x_m\n").find("column x twice"), std::string::npos);
  EXPECT_NE(error_of("x,y,z,nx,ny,nz,id\n1,2,3,0,0,1\n").find("column id is missing"), std::string::npos);
}

}  // namespace
}  // namespace phos
