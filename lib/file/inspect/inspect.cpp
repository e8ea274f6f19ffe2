#include "file/inspect/inspect.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "core/text/append_item.h"
#include "file/kinds/tensor_row.h"

namespace phos::inline file {

namespace {

constexpr std::size_t kMostColumns = 4;  // with statistics of their own
constexpr std::size_t kChunkRows = 1 << 16;

struct Summary {
  double least = std::numeric_limits<double>::infinity(), greatest = -least, sum = 0;
  std::uint64_t finite = 0, not_finite = 0;

  void add(double v) {
    if (!std::isfinite(v)) {
      ++not_finite;
      return;
    }
    least = std::min(least, v), greatest = std::max(greatest, v), sum += v;
    ++finite;
  }
  void add(const Summary& other) {
    least = std::min(least, other.least), greatest = std::max(greatest, other.greatest), sum += other.sum;
    finite += other.finite, not_finite += other.not_finite;
  }
};

template <class T>
std::vector<Summary> summarise_as(const Tensor& tensor, std::size_t columns) {
  const std::span<const T> v{reinterpret_cast<const T*>(tensor.bytes.data()),
                             tensor.bytes.size() / sizeof(T)};
  return parallel_reduce(
      v.size() / columns, kChunkRows, std::vector<Summary>(columns),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Summary> part(columns);
        for (std::size_t i = begin * columns; i < end * columns; ++i)
          part[i % columns].add(static_cast<double>(v[i]));
        return part;
      },
      [](std::vector<Summary>& total, const std::vector<Summary>& part) {
        for (std::size_t c = 0; c < total.size(); ++c) total[c].add(part[c]);
      });
}

std::vector<Summary> summarise(const Tensor& tensor, std::size_t columns) {
  return with_type_of(tensor.dtype, [&]<class T>(T) { return summarise_as<T>(tensor, columns); });
}

/// Bytes of another program, and codes: as numbers they mean nothing.
bool is_opaque(const Tensor& tensor) { return is_octahedral(tensor) || tensor.unit == kOpaqueUnit; }

/// One value per column. `narrow` values came from floats and print with a float's digits.
Json per_column(const std::vector<Summary>& summaries, bool narrow, double (*value)(const Summary&)) {
  Json::Array all;
  for (const Summary& s : summaries) {
    if (s.finite == 0) {
      all.emplace_back();
    } else if (narrow) {
      all.emplace_back(static_cast<float>(value(s)));
    } else {
      all.emplace_back(value(s));
    }
  }
  return all.size() == 1 ? all[0] : Json(all);
}

/// `row`: null for a tensor that the table of the kind does not have.
Json describe_tensor(const Tensor& tensor, const TensorRow* row) {
  Json out(Json::Object{});
  Json shape(Json::Array{});
  for (const std::uint64_t n : tensor.shape) shape.push_back(n);
  out["dtype"] = dtype_name(tensor.dtype);
  out["shape"] = shape;
  out["unit"] = tensor.unit;
  out["bytes"] = tensor.bytes.size();
  if (row != nullptr) out["meaning"] = std::string(row->meaning);
  if (is_opaque(tensor) || tensor.bytes.empty()) return out;
  const bool by_column = tensor.shape.size() == 2 && tensor.shape[1] <= kMostColumns;
  const std::vector<Summary> summaries =
      summarise(tensor, by_column ? static_cast<std::size_t>(tensor.shape[1]) : 1);
  const bool narrow = tensor.dtype == Dtype::f32 || tensor.dtype == Dtype::f16;
  out["min"] = per_column(summaries, narrow, [](const Summary& s) { return s.least; });
  out["max"] = per_column(summaries, narrow, [](const Summary& s) { return s.greatest; });
  out["mean"] =
      per_column(summaries, false, [](const Summary& s) { return s.sum / static_cast<double>(s.finite); });
  if (is_float(tensor.dtype)) {
    std::uint64_t not_finite = 0;
    for (const Summary& s : summaries) not_finite += s.not_finite;
    out["non_finite"] = not_finite;
  }
  return out;
}

Json counts_of(const Counters& counters) {
  Json out(Json::Object{});
  for (const auto& [event, n] : counters.counts()) out[event] = n;
  return out;
}

std::string shape_text(const Json& shape) {
  std::string out;
  for (const Json& n : shape.as_array()) {
    if (!out.empty()) out += " x ";
    out += n.dump();
  }
  return out.empty() ? "scalar" : out;
}

/// 6 significant digits: enough to read; --json has them all.
std::string brief(const Json& v) {
  if (v.is_integer()) return v.dump();
  if (v.is_number()) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", v.as_number());
    return buffer;
  }
  if (v.is_array()) {
    std::string out;
    for (const Json& item : v.as_array()) {
      if (!out.empty()) out += ' ';
      out += brief(item);
    }
    return text('(', out, ')');
  }
  return v.is_string() ? v.as_string() : v.is_null() ? "-" : v.dump();
}

void line(std::string& out, const std::string& name, const std::string& value) {
  if (value.empty()) return;
  out += name;
  out.append(name.size() < 12 ? 12 - name.size() : 1, ' ');
  out += value + '\n';
}

/// "name:" and one indented line per member.
void block(std::string& out, const std::string& name, const Json& object,
           const std::function<std::string(const Json&)>& show) {
  if (!object.is_object() || object.as_object().empty()) return;
  std::size_t width = 0;
  for (const auto& [key, value] : object.as_object()) width = std::max(width, key.size());
  out += name + ":\n";
  for (const auto& [key, value] : object.as_object()) {
    out += "  " + key;
    const std::string shown = show(value);
    if (!shown.empty() && shown.front() != '\n') out.append(width + 2 - key.size(), ' ');
    out += shown + '\n';
  }
}

bool is_table(const Json& v) {
  return v.is_array() && !v.as_array().empty() &&
         std::all_of(v.as_array().begin(), v.as_array().end(),
                     [](const Json& row) { return row.is_object(); });
}

/// A list of objects, one line each: "name value, name value".
std::string rows(const Json& table, const std::function<std::string(const Json&)>& show) {
  std::string out;
  for (const Json& row : table.as_array()) {
    std::string line;
    for (const auto& [name, value] : row.as_object()) {
      const std::string shown = show(value);
      if (!shown.empty()) append_item(line, name + ' ' + shown);
    }
    out += "\n    " + line;
  }
  return out;
}

/// As brief(), but of a list of texts only how many they are.
std::string counted(const Json& v) {
  const bool texts = v.is_array() && !v.as_array().empty() && v.as_array().front().is_string();
  return texts ? text('(', v.as_array().size(), " texts)") : brief(v);
}

std::string tensor_line(const Json& t, bool numbers) {
  std::string out = t.find("dtype")->as_string() + "  " + shape_text(*t.find("shape"));
  const std::string& unit = t.find("unit")->as_string();
  if (!unit.empty()) out += "  " + unit;
  if (!numbers) return out;
  if (t.find("min") != nullptr)
    out += "  min " + brief(*t.find("min")) + "  max " + brief(*t.find("max")) + "  mean " +
           brief(*t.find("mean"));
  const Json* bad = t.find("non_finite");
  if (bad != nullptr && bad->as_integer() != 0) out += "  NOT FINITE: " + bad->dump();
  if (const Json* meaning = t.find("meaning")) out += "  " + meaning->as_string();
  return out;
}

std::string whole_or_absent(const Json& v) {
  const bool exact = v.is_integer() || v.is_string() || v.is_bool();
  return exact ? v.dump() : "";
}

std::string program(const std::string& tool) { return tool.substr(0, tool.find(' ')); }

/// `{}` where a header has no such entry.
Json object_or_empty(const Json& v) { return v.is_null() ? Json(Json::Object{}) : v; }

Json header_of(const Provenance& p) {
  Json out(Json::Object{});
  out["kind"] = name_of(p.kind);
  out["version"] = p.version;
  out["tool"] = p.tool;
  out["algorithm"] = p.algorithm;
  out["command"] = p.command;
  out["parameters"] = object_or_empty(p.parameters);
  Json inputs(Json::Object{});
  for (const auto& [role, hash] : p.inputs) inputs[role] = hash;
  out["inputs"] = inputs;
  out["scene"] = p.scene_hash;
  out["scene_parts"] = object_or_empty(p.scene_parts);
  out["history"] = p.history;
  out["key"] = p.key;
  out["counters"] = counts_of(p.counters);
  out["extra"] = object_or_empty(p.extra);
  return out;
}

}  // namespace

bool is_octahedral(const Tensor& tensor) {
  return tensor.dtype == Dtype::u32 && tensor.unit == kOctahedralUnit;
}

Json describe(const Container& file) {
  Json out = header_of(file.provenance());
  Json tensors(Json::Object{});
  for (const auto& [name, tensor] : file.tensors())
    tensors[name] = describe_tensor(tensor, find_row(file.kind(), name));
  out["tensors"] = tensors;
  return out;
}

std::string describe_text(const Container& file) {
  const Json all = describe(file);
  std::string out;
  line(out, "kind", text(brief(*all.find("kind")), ' ', all.find("version")->dump()));
  for (const char* name : {"tool", "command", "scene", "key"}) line(out, name, brief(*all.find(name)));
  if (const DVec3 origin = origin_in(file.provenance().scene_parts); origin != DVec3(0))
    line(out, "origin",
         text(shortest(origin.x), ' ', shortest(origin.y), ' ', shortest(origin.z),
              " m: positions below are counted from there"));
  block(out, "parameters", *all.find("parameters"), brief);
  block(out, "inputs", *all.find("inputs"), brief);
  if (!all.find("history")->as_array().empty()) out += "history:\n";
  for (const Json& stage : all.find("history")->as_array())
    if (const Json* command = stage.find("command")) out += "  " + brief(*command) + '\n';
  block(out, "tensors", *all.find("tensors"), [](const Json& t) { return tensor_line(t, true); });
  block(out, "counters", *all.find("counters"), brief);
  block(out, "extra", *all.find("extra"), [](const Json& v) {
    return is_table(v) ? rows(v, brief) : v.is_object() ? rows(Json::Array{v}, counted) : brief(v);
  });
  return out;
}

std::string canonical_text(const Container& file) {
  const Provenance& p = file.provenance();
  std::string out;
  line(out, "kind", text(name_of(p.kind), ' ', p.version));
  line(out, "tool", text(program(p.tool), " algorithm ", p.algorithm));
  line(out, "command", p.command);
  block(out, "parameters", p.parameters, [](const Json& v) { return v.dump(); });
  out += "inputs:\n";
  for (const auto& [role, hash] : p.inputs) out += "  " + role + '\n';
  out += "history:\n";
  for (const Json& stage : p.history.as_array())
    if (const Json* command = stage.find("command")) out += "  " + brief(*command) + '\n';
  Json tensors(Json::Object{});
  for (const auto& [name, tensor] : file.tensors()) {
    Json shape(Json::Array{});
    for (const std::uint64_t n : tensor.shape) shape.push_back(n);
    tensors[name]["dtype"] = dtype_name(tensor.dtype);
    tensors[name]["shape"] = shape;
    tensors[name]["unit"] = tensor.unit;
  }
  block(out, "tensors", tensors, [](const Json& t) { return tensor_line(t, false); });
  block(out, "counters", counts_of(p.counters), brief);
  block(out, "extra", p.extra,
        [](const Json& v) { return is_table(v) ? rows(v, whole_or_absent) : whole_or_absent(v); });
  return out;
}

}  // namespace phos::inline file
