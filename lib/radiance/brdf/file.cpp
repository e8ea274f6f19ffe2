#include "radiance/brdf/file.h"

#include "core/error.h"
#include "file/kinds/tensor_io.h"
#include "hsh/basis.h"
#include "radiance/brdf/report.h"
#include "radiance/brdf/table.h"

namespace phos::inline radiance {

namespace {

/// "0.orders", "0.error", "0.coefficients" of table 0. There are no coefficients where all is traced.
std::string name_of(std::size_t table, const char* column) { return text(table, '.', column); }

/// Calls visit(row of the file, index in the table) for the coefficients that an entry stores: all, or the
/// coefficients of cosines (0 <= m <= l) where the others are 0.
template <class Visit>
void for_each_stored(const BrdfTable& table, const Visit& visit) {
  std::size_t row = 0;
  for (int l = 0; l < table.order; ++l)
    for (int m = table.isotropic ? 0 : -l; m <= l; ++m)
      visit(row++, static_cast<std::size_t>(harmonic_index(l, m)));
}

std::size_t stored_per_entry(const BrdfTable& table) {
  const auto order = static_cast<std::size_t>(table.order);
  return table.isotropic ? order * (order + 1) / 2 : order * order;
}

std::size_t entries_of(const BrdfTable& table) {
  const auto side = static_cast<std::size_t>(table.resolution);
  return table.isotropic ? side : side * side;
}

/// What a header says of one table; it is text from outside, so every look-up may fail.
struct HeaderReader {
  const Json& object;
  const std::string& path;

  std::int64_t integer(const char* name, std::int64_t least, std::int64_t most) const {
    const Json* v = object.find(name);
    if (!v || !v->is_integer() || v->as_integer() < least || v->as_integer() > most) fail(name);
    return v->as_integer();
  }
  std::string string(const char* name, bool required) const {
    const Json* v = object.find(name);
    if (!v && !required) return "";
    if (!v || !v->is_string()) fail(name);
    return v->as_string();
  }
  bool boolean(const char* name) const {
    const Json* v = object.find(name);
    if (!v || !v->is_bool()) fail(name);
    return v->as_bool();
  }
  float number(const char* name) const {
    const Json* v = object.find(name);
    if (!v || !v->is_number()) fail(name);
    return static_cast<float>(v->as_number());
  }
  [[noreturn]] void fail(const char* name) const {
    throw Error(ExitCode::bad_input, path,
                text("the header of a material lacks a valid \"", name, "\"; make the file again"));
  }
};

BrdfTable read_table(const Container& container, std::size_t index, const Json& header) {
  const HeaderReader h{header, container.path()};
  BrdfTable table;
  table.material = h.string("material", true), table.note = h.string("note", false);
  table.material_index = static_cast<std::uint32_t>(h.integer("index", 0, 0xffffffff));
  table.isotropic = h.boolean("isotropic");
  table.resolution = static_cast<int>(h.integer("resolution", 2, 1024));
  table.order = static_cast<int>(h.integer("order", 0, 30));
  table.albedo = h.number("albedo");
  const TensorReader file(container);
  const std::size_t entries = entries_of(table), stored = stored_per_entry(table);
  const auto refuse = [&](const std::string& what) {
    throw Error(ExitCode::bad_input, container.path(),
                text("material \"", table.material, "\": ", what, "; make the file again"));
  };
  const auto orders = file.values<std::uint8_t>(name_of(index, "orders"));
  const auto error = file.values<float>(name_of(index, "error"));
  if (orders.size() != entries)
    refuse(text("tensor \"", name_of(index, "orders"), "\" has ", orders.size(), " rows, not ", entries));
  table.orders.assign(orders.begin(), orders.end());
  table.error.assign(error.begin(), error.end());
  for (std::size_t e = 0; e < entries; ++e)
    if (table.orders[e] > table.order) refuse(text("entry ", e, " is of order ", int{table.orders[e]}));
  if (table.order == 0) return table;
  const auto values = file.values<float>(name_of(index, "coefficients"));
  if (values.size() != 3 * entries * stored)
    refuse(text("tensor \"", name_of(index, "coefficients"), "\" has ", file.extent(name_of(index, "i")),
                " numbers a row and colour, not ", stored));
  const auto stride = 3 * static_cast<std::size_t>(harmonic_count(table.order));
  table.coefficients.assign(entries * stride, 0.f);
  for (std::size_t e = 0; e < entries; ++e) {
    for_each_stored(table, [&](std::size_t row, std::size_t i) {
      for (std::size_t c = 0; c < 3; ++c)
        table.coefficients[e * stride + 3 * i + c] = values[3 * (e * stored + row) + c];
    });
  }
  return table;
}

}  // namespace

void write_brdf(const std::string& path, std::span<const BrdfTable> tables, Provenance provenance) {
  TensorWriter file(FileKind::brdf);
  Json headers = Json::Array{};
  std::vector<std::vector<float>> stored(tables.size());  // alive until written
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const BrdfTable& table = tables[t];
    const std::size_t entries = table.entries(), rows = stored_per_entry(table);
    PHOS_CHECK(entries == entries_of(table), entries, " entries, resolution ", table.resolution);
    headers.push_back(header_of(table));
    file.add<std::uint8_t>(name_of(t, "orders"), table.orders);
    file.add<float>(name_of(t, "error"), table.error);
    if (table.order == 0) continue;
    const auto stride = 3 * static_cast<std::size_t>(harmonic_count(table.order));
    stored[t].resize(3 * entries * rows);
    for (std::size_t e = 0; e < entries; ++e) {
      for_each_stored(table, [&](std::size_t row, std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c)
          stored[t][3 * (e * rows + row) + c] = table.coefficients[e * stride + 3 * i + c];
      });
    }
    file.add<float>(name_of(t, "coefficients"), stored[t]);
  }
  provenance.extra["materials"] = headers;
  provenance.extra["basis"] = "hsh, orthonormal, Condon-Shortley phase, index l*l+l+m, z = shading normal";
  file.write(path, provenance);
}

std::vector<BrdfTable> read_brdf(const Container& file) {
  if (file.kind() != FileKind::brdf) {
    throw Error(ExitCode::bad_input, file.path(),
                text("is a ", name_of(file.kind()), " file, not one of phos-brdf"));
  }
  file.require_sound();
  const Json* headers = file.provenance().extra.find("materials");
  if (!headers || !headers->is_array()) {
    throw Error(ExitCode::bad_input, file.path(),
                "the header has no list of materials; make the file again with phos-brdf");
  }
  std::vector<BrdfTable> tables;
  for (const Json& header : headers->as_array()) tables.push_back(read_table(file, tables.size(), header));
  return tables;
}

}  // namespace phos::inline radiance
