// phos-picture: image of light, table or luminaire -> a picture for people.
#pragma once

#include "file/tool.h"
#include "image/plot/csv_plot.h"
#include "image/show.h"
#include "radiance/brdf/discs.h"

namespace phos::stage {

/// Raised whenever the same command would give other numbers.
inline constexpr int kPictureAlgorithm = 2;

struct PictureCommand {
  PictureSequence sequence;  ///< with the input
  LayerPictureOptions picture;
  CsvPlotOptions plot;
  bool goniometric = false;
  BrdfDiscs discs = BrdfDiscs::none;
};

/// The body of the program: `asked` holds the values that the options of `tool` are declared to set.
void run(Tool& tool, const PictureCommand& asked);

}  // namespace phos::stage
