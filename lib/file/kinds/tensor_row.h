// What each kind of file holds: one row a tensor, which drives writing, reading, phos-info and the manual.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "file/dtype.h"
#include "file/kinds/kind.h"

namespace phos::inline file {

/// What every number of a sound tensor is.
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
  std::string_view words;  ///< what follows "is": "finite"; "" of `any`
  double least = 0, most = 0;
};

/// Units of numbers that are codes: of directions, and of bytes that another library reads.
inline constexpr std::string_view kOctahedralUnit = "octahedral", kOpaqueUnit = "FLANN index";

struct TensorRow {
  std::string_view name;  ///< "K.orders" of each table of lobes: 0.orders, 1.orders, ...
  Dtype dtype;
  /// Extents, separated by commas: a number, "rgb" or "xyz" (3, with these names), or a symbol, which is the
  /// same number in the whole file. "s+1" and "s^2" are made of the extent s. A symbol that begins with "K."
  /// is one of each table.
  std::string_view shape;
  std::string_view unit;  ///< "1": none
  NumberCheck check;
  std::string_view meaning;  ///< one line without a full stop
  /// Anchors of docs/methods.md, separated by spaces.
  std::string_view methods = "";
};

/// Tensors that are in a file all together.
struct TensorGroup {
  enum class Present {
    always,
    optional,  ///< or none of them is
  };
  Present present;
  /// Of the manual: stands over a table of these; "": they continue the table before.
  std::string_view title;
  std::span<const TensorRow> rows;
  /// The form that a file has in which they can be; whole: any form.
  FileForm only_of = FileForm::whole;
  /// They are in no file of this form; whole: there is no such form.
  FileForm not_of = FileForm::whole;
  bool can_be_in(FileForm form) const {
    return (only_of == FileForm::whole || only_of == form) && (not_of == FileForm::whole || not_of != form);
  }
};

struct KindRow {
  FileKind kind;
  int version;                   ///< of the layout; another one is refused
  std::string_view ending;       ///< usual end of a file's name
  std::string_view programs;     ///< that write it, separated by spaces
  std::string_view holds;        ///< in a few words
  std::string_view heading;      ///< of its section in the manual
  std::string_view explanation;  ///< that the section begins with
  std::span<const TensorGroup> groups;
};

const KindRow& row_of(FileKind kind);

/// A tensor's row in the table of its kind; null: there is none.
const TensorRow* find_row(FileKind kind, std::string_view tensor);
/// The number before the point in the name of a tensor of which there is one for each table ("12" of
/// "12.orders"); "" in other names.
std::string_view table_of(std::string_view tensor);
/// The name of this row's tensor of a table: "12.orders". Rows that are no such row have their own.
std::string tensor_name(const TensorRow& row, std::string_view table);
/// Is there one for each table?
bool is_of_tables(const TensorRow& row);

}  // namespace phos::inline file
