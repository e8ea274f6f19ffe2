#include "record/header.h"

namespace phos::inline record {

const char* name_of(Quantity quantity) { return quantity == Quantity::all ? "all" : "indirect"; }

std::optional<double> accuracy_of(const Container& file) {
  const Json* accuracy = file.provenance().extra.find(kAccuracyEntry);
  if (!accuracy || !accuracy->is_number() || !(accuracy->as_number() > 0)) return std::nullopt;
  return accuracy->as_number();
}

std::optional<Quantity> quantity_of(const Container& file) {
  const Json* said = file.provenance().extra.find(kQuantityEntry);
  for (const Quantity quantity : {Quantity::indirect, Quantity::all})
    if (said && *said == Json(name_of(quantity))) return quantity;
  return std::nullopt;
}

}  // namespace phos::inline record
