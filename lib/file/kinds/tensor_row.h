// The contents of each kind of file: one row for each tensor, which drives writing, reading, phos-info and
// the manual.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "file/dtype.h"
#include "file/kinds/kind.h"

namespace phos::inline file {

/// The condition that every number of a sound tensor meets.
struct NumberCheck {
  enum class Rule {
    any,
    finite,
    within,    ///< least <= x <= most; the greatest may be infinite
    positive,  ///< finite and above 0
    unit,      ///< rows are vectors of length 1, to 1e-3
    frame,     ///< rows are two such vectors at right angles
  };
  Rule rule;
  std::string_view words;  ///< the condition, after "is": "finite"; "" for `any`
  double least = 0, most = 0;
};

/// Units of codes: of direction codes, and of bytes that another library reads.
inline constexpr std::string_view kOctahedralUnit = "octahedral", kOpaqueUnit = "FLANN index";

/// A shorter type that a tensor may have, with numbers in units of another tensor.
struct CompactType {
  Dtype dtype;
  std::string_view unit;  ///< "light_scale": the numbers times that tensor are in the unit of the row
};

struct TensorRow {
  std::string_view name;  ///< "K.orders" stands for 0.orders, 1.orders, ... of the tables of lobes
  Dtype dtype;
  /// Extents, separated by commas: a number, "rgb" or "xyz" (3, with these names), or a symbol, which is the
  /// same number in the whole file. "s+1" and "s^2" follow from the extent s. A symbol that begins with "K."
  /// has a number for each table.
  std::string_view shape;
  std::string_view unit;  ///< "1": none
  NumberCheck check;
  std::string_view meaning;  ///< one line without a full stop
  /// Anchors of docs/methods.md, separated by spaces.
  std::string_view methods = "";
  std::optional<CompactType> compact = {};

  /// Is this one of the types of its numbers?
  bool has_type(Dtype d) const { return d == dtype || (compact && d == compact->dtype); }
};

/// "F32"; with a shorter type "F32 or F16".
std::string type_words(const TensorRow& row);

/// Tensors that are in a file together.
struct TensorGroup {
  enum class Present {
    always,
    optional,  ///< all or none of them
  };
  Present present;
  /// Line over the table of these tensors in the manual; "": they continue the table before.
  std::string_view title;
  std::span<const TensorRow> rows;
  /// The only form of file that can hold them; whole: any form.
  FileForm only_of = FileForm::whole;
  /// No file of this form holds them; whole: there is no such form.
  FileForm not_of = FileForm::whole;
  bool can_be_in(FileForm form) const {
    return (only_of == FileForm::whole || only_of == form) && (not_of == FileForm::whole || not_of != form);
  }
};

struct KindRow {
  FileKind kind;
  int version;                   ///< version of the layout; other versions are refused
  std::string_view ending;       ///< usual ending of a file's name
  std::string_view programs;     ///< the programs that write it, separated by spaces
  std::string_view holds;        ///< its contents in a few words
  std::string_view heading;      ///< heading of its section in the manual
  std::string_view explanation;  ///< text with which the section begins
  std::span<const TensorGroup> groups;
};

const KindRow& row_of(FileKind kind);

/// A tensor's row in the table of its kind; null: there is none.
const TensorRow* find_row(FileKind kind, std::string_view tensor);
/// The number of the table in the name of a tensor ("12" in "12.orders"); "" in names of tensors that are of
/// no table.
std::string_view table_of(std::string_view tensor);
/// The name of this row's tensor for a table: "12.orders". A row that is not of tables keeps its own name.
std::string tensor_name(const TensorRow& row, std::string_view table);
/// Does each table have a tensor of this row?
bool is_of_tables(const TensorRow& row);

}  // namespace phos::inline file
