// The error of every way of rotating HSH, by order and angle, as CSV; with --update written to
// data/golden/hsh/rotation_accuracy.csv.
//   build/tests/hsh_rotation_table > rotation.csv
#include <fstream>
#include <iostream>
#include <string_view>

#include "support/rotation_accuracy.h"

int main(int argc, char** argv) {
  std::string table = phos::test::kRotationHeader;
  for (const int order : {5, 7, 10})
    for (const double degrees : {1., 5., 10., 20., 45.}) table += phos::test::rotation_rows(order, degrees);
  if (argc > 1 && std::string_view(argv[1]) == "--update") {
    std::ofstream(std::string(PHOS_SOURCE) + "/data/golden/hsh/rotation_accuracy.csv") << table;
  } else {
    std::cout << table;
  }
}
