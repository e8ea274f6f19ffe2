// Tables of glossy reflection, and the functions that hold them, as discs over the hemisphere of directions.
#pragma once

#include <span>

#include "image/plot/disc_plot.h"
#include "radiance/brdf/table.h"

namespace phos::inline radiance {

enum class BrdfDiscs {
  none,
  error,      ///< per direction of view: energy of the lobe that its harmonics leave out, relative
  order,      ///< per direction of view: n of its harmonics
  harmonics,  ///< per direction: HSH of the bands that the tables have
};

struct BrdfDiscsRow {
  BrdfDiscs which;
  const char *name, *title;  ///< the option's value; words of the legend
};
inline constexpr BrdfDiscsRow kBrdfDiscs[] = {
    {BrdfDiscs::error, "error", "energy left out"},
    {BrdfDiscs::order, "order", "order of HSH"},
    {BrdfDiscs::harmonics, "harmonics", "HSH l, m"},
};

void declare_options(Options& options, BrdfDiscs& discs);

/// A disc for each table or function: direction w at x/(1+z), y/(1+z) (docs/methods.md#j5), the pole in the
/// middle, the horizon at the rim. Tables are shown as they are, each place by the entry next to it; without
/// a value where a direction is traced. Harmonics: a row for each band l, m from -l to l. `which` is not
/// none. Throws Error(bad_input) without tables, or for harmonics of tables that have none.
DiscPlot discs_of(std::span<const BrdfTable> tables, BrdfDiscs which);

}  // namespace phos::inline radiance
