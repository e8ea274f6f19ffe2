// Rows of the tensors of a container as text: tables and clouds of points.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "file/container.h"

namespace phos::inline file {

/// Receives text piece by piece.
using Sink = std::function<void(std::string_view)>;

/// The tensors side by side as comma-separated values with a header line. Rows are the first dimension, which
/// all must share; the others become columns named by colour (r, g, b), axis (x, y, z) or number. With
/// `decode`, octahedral directions become x, y, z. Throws Error(usage) for an unknown name or other numbers
/// of rows.
void dump_csv(const Container& file, const std::vector<std::string>& names, bool decode, const Sink& sink);

enum class PlyFormat { ascii, binary };

/// Points of "position", coloured by "irradiance" or "flux" (99th percentile of the luminance is white,
/// sRGB), with that luminance as scalar field and the normals if there are any. Throws Error(bad_input) if
/// there are no positions.
void write_ply(const Container& file, PlyFormat format, const Sink& sink);

}  // namespace phos::inline file
