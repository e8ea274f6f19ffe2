#include "estimate/zone/path_squares.h"

#include <algorithm>

namespace phos::inline estimate {

void ZonePaths::set(std::span<const std::uint32_t> family) {
  std::vector<std::uint32_t> each(family.begin(), family.end());
  std::sort(each.begin(), each.end());
  each.erase(std::unique(each.begin(), each.end()), each.end());
  paths = each.size(), path.clear();
  for (const std::uint32_t f : family)
    path.push_back(static_cast<std::uint32_t>(std::lower_bound(each.begin(), each.end(), f) - each.begin()));
}

DVec3 PathSquares::squares() const {
  DVec3 sum = alone_;
  for (const DVec3& of_path : sum_of_path_) sum += of_path * of_path;
  return sum;
}

double PathSquares::grey_squares() const {
  if (!of_.known()) return grey_alone_;
  double sum = 0;
  for (const DVec3& of_path : sum_of_path_) sum += grey(of_path) * grey(of_path);
  return sum;
}

double PathSquares::spread() const { return grey_alone_ > 0 ? grey_squares() / grey_alone_ : 1; }

}  // namespace phos::inline estimate
