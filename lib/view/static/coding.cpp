#include "view/static/coding.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.h"

namespace phos::inline view {
namespace {

using enum Coding;

constexpr unsigned kExact = 23;  // bits of a float after the leading one

constexpr CodedField kCoded[] = {
    {MessageKind::scene, "vertex", "position", {box, 21}},
    {MessageKind::scene, "vertex", "normal", {octahedral}},
    {MessageKind::scene, "vertex", "uv", {box, 21}},
    {MessageKind::scene, "vertex", "colour", {rounded, 11}},
    {MessageKind::scene, "distribution", "share", {rounded, 11}},
    {MessageKind::scene, "sky", "luminance", {rounded, 11}},
    {MessageKind::records, "record", "position", {box, 21}},
    {MessageKind::records, "record", "inverse_radius", {rounded, 13}},
    {MessageKind::records, "record", "normal", {octahedral}},
    {MessageKind::records, "record", "front_limit", {rounded, 13}},
    {MessageKind::records, "record", "irradiance", {rounded, 12}},
    {MessageKind::records, "record", "weight", {rounded, 11}},
    {MessageKind::records, "record", "stderr", {rounded, 7}},
    {MessageKind::records, "record", "over_limit", {rounded, 13}},
    {MessageKind::records, "record", "turn", {rounded, 10}},
    {MessageKind::records, "record", "translation", {rounded, 10}},
    {MessageKind::gloss, "lobe_number", "value", {rounded, 12}},
    {MessageKind::gloss, "record", "position", {box, 21}},
    {MessageKind::gloss, "record", "inverse_radius", {rounded, 13}},
    {MessageKind::gloss, "record", "normal", {octahedral}},
    {MessageKind::gloss, "record", "front_limit", {rounded, 13}},
    {MessageKind::gloss, "record", "axis_x", {octahedral}},
    {MessageKind::gloss, "record", "over_limit", {rounded, 13}},
    {MessageKind::gloss, "record", "weight", {rounded, 11}},
    {MessageKind::gloss, "number", "value", {rounded, 12}},
};

}  // namespace

std::span<const CodedField> coded_fields() { return kCoded; }

FieldCoding coding_of(MessageKind kind, const MessageField& field) {
  for (const CodedField& coded : kCoded)
    if (coded.kind == kind && coded.table == field.table && coded.name == field.name) return coded.coding;
  switch (field.type) {
    case FieldType::u8:
      return {bytes};
    case FieldType::u32:
      return {numbers};
    case FieldType::f32:
      return {rounded, kExact};
  }
  PHOS_CHECK(false, "type ", static_cast<int>(field.type));
}

float rounded_to(float value, unsigned bits) {
  if (bits >= kExact || std::isnan(value)) return value;
  const std::uint32_t step = 1u << (kExact - bits), cut = ~(step - 1);
  const auto pattern = std::bit_cast<std::uint32_t>(value);
  const auto nearest = std::bit_cast<float>((pattern + step / 2) & cut);
  return std::isfinite(nearest) ? nearest : std::bit_cast<float>(pattern & cut);
}

std::uint32_t step_of(float value, float lo, float hi, unsigned bits) {
  if (!(hi > lo)) return 0;
  const double most = static_cast<double>((1u << bits) - 1), from = static_cast<double>(lo);
  const double share = (static_cast<double>(value) - from) / (static_cast<double>(hi) - from);
  return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0., 1.) * most));
}

}  // namespace phos::inline view
