// What a container says, for people and for programs: what phos-info prints.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "file/container.h"

namespace phos::inline file {

/// Receives text piece by piece.
using Sink = std::function<void(std::string_view)>;

/// Header, and of each tensor dtype, shape, unit, meaning as the table of the kind says it, and the least,
/// greatest and mean finite value, with the number of non-finite ones. Tensors of 2 to 4 columns have one
/// value per column. Octahedral codes and bytes of opaque blocks
/// ("kdtree") have none: as numbers they mean nothing. Same numbers on any number of threads.
Json describe(const Container& file);

/// describe() as text for people.
std::string describe_text(const Container& file);

/// Only what a difference in rounding does not change: kinds, commands, parameters, names, shapes, dtypes,
/// units, counters, whole numbers of the extra values. For golden files.
std::string canonical_text(const Container& file);

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

/// Is this tensor a column of octahedral directions?
bool is_octahedral(const Tensor& tensor);

}  // namespace phos::inline file
