#include "scene/spectral/join_parts.h"

#include <algorithm>

#include "core/error.h"

namespace phos::inline scene {
namespace {

[[noreturn]] void mismatch(const std::string& path, const std::string& message) {
  throw Error(ExitCode::mismatch, path, message);
}

std::string list_of(const std::vector<int>& numbers) {
  std::string out;
  for (const int n : numbers) {
    if (!out.empty()) out += ',';
    out += std::to_string(n);
  }
  return out;
}

}  // namespace

std::vector<int> order_of(const BandParts& parts, const std::function<BandTriplet(std::size_t)>& triplet_of) {
  if (parts.paths.empty())
    throw Error(ExitCode::usage, "", "no part is given; give the files of all triplets");
  const int number = triplet_of(0).number, triplets = (number + 2) / 3;
  std::vector<int> order(static_cast<std::size_t>(triplets), -2);
  const auto at = [&](int triplet) -> int& { return order[static_cast<std::size_t>(triplet - 1)]; };
  for (const int dark : parts.dark) {
    if (dark < 1 || dark > triplets)
      throw Error(
          ExitCode::usage, "--dark",
          text("is ", dark, ", but ", number, " bands have ", triplets, " triplets; give 1 to ", triplets));
    at(dark) = -1;
  }
  for (std::size_t i = 0; i < parts.paths.size(); ++i) {
    const BandTriplet t = triplet_of(i);
    if (t.number != number)
      mismatch(parts.paths[i], text("is of ", t.number, " bands, ", parts.paths[0], " of ", number,
                                    "; give parts of one run"));
    if (t.triplet < 1 || t.triplet > triplets)
      mismatch(parts.paths[i], text("says it is triplet ", t.triplet, " of ", triplets, "; make it again"));
    if (at(t.triplet) == -1)
      mismatch(parts.paths[i],
               text("is triplet ", t.triplet, ", which --dark calls dark; leave one of the two out"));
    if (at(t.triplet) >= 0)
      mismatch(parts.paths[i],
               text("is triplet ", t.triplet, ", and so is ",
                    parts.paths[static_cast<std::size_t>(at(t.triplet))], "; give each once"));
    at(t.triplet) = static_cast<int>(i);
  }
  std::vector<int> missing;
  for (int k = 1; k <= triplets; ++k)
    if (at(k) == -2) missing.push_back(k);
  if (!missing.empty())
    mismatch(parts.paths[0],
             text(missing.size() == 1 ? "triplet " : "triplets ", list_of(missing), " of ", triplets,
                  missing.size() == 1 ? " is" : " are", " missing; give them, or --dark ", list_of(missing),
                  " where no lamp shines in them"));
  return order;
}

}  // namespace phos::inline scene
