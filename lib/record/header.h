// What the header of a file of records says about them.
#pragma once

#include <optional>

#include "file/container.h"

namespace phos::inline record {

/// Which light is in records.
enum class Quantity {
  indirect,  ///< all but the light that comes straight from the lights
  all,
};
/// As headers name it: "indirect", "all".
const char* name_of(Quantity quantity);

/// The entries of Provenance::extra.
inline constexpr const char *kAccuracyEntry = "accuracy", *kQuantityEntry = "quantity";

/// The accuracy that placed the records. Nothing where the header does not say one above 0.
std::optional<double> accuracy_of(const Container& file);
/// Nothing where the header does not say it.
std::optional<Quantity> quantity_of(const Container& file);

}  // namespace phos::inline record
