#include "file/provenance.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "core/error.h"
#include "core/text/utf8.h"
#include "file/container.h"
#include "file/json_parse.h"

namespace phos::inline file {

namespace {

constexpr const char* kFormatPrefix = "phos/";

/// Names from scenes may be in any encoding, but JSON is UTF-8: stray bytes become U+FFFD.
std::string valid_utf8(const std::string& s) {
  std::string out;
  for (std::size_t i = 0; i < s.size();) {
    const std::size_t n = utf8_length(s, i);
    if (n == 0) {
      out += "\xef\xbf\xbd", ++i;
    } else {
      out.append(s, i, n), i += n;
    }
  }
  return out;
}

void put(Metadata& metadata, const std::string& name, const std::string& value) {
  if (!value.empty()) metadata[name] = valid_utf8(value);
}

void put(Metadata& metadata, const std::string& name, const Json& value) {
  if (!value.is_null()) metadata[name] = valid_utf8(value.dump());
}

std::string get(const Metadata& metadata, const std::string& name) {
  const auto found = metadata.find(name);
  return found == metadata.end() ? std::string() : found->second;
}

Json get_json(const Metadata& metadata, const std::string& name, const std::string& where) {
  const auto found = metadata.find(name);
  return found == metadata.end() ? Json() : parse_json(found->second, where);
}

Json counts_of(const Counters& counters) {
  Json counts(Json::Object{});
  for (const auto& [event, n] : counters.counts()) counts[event] = n;
  return counts;
}

Json inputs_of(const Provenance& p) {
  Json inputs(Json::Object{});
  for (const auto& [role, hash] : p.inputs) inputs[role] = hash;
  return inputs;
}

std::string format_of(const Provenance& p) { return text(kFormatPrefix, name_of(p.kind), '/', p.version); }

/// "phos/photons/1" -> kind and version. Throws Error(bad_input) for anything else.
void read_format(const std::string& format, const std::string& where, Provenance& p) {
  const std::string prefix = kFormatPrefix;
  const std::size_t slash = format.rfind('/');
  const char* const end = format.data() + format.size();
  bool read = format.starts_with(prefix) && slash != std::string::npos && slash > prefix.size();
  if (read) {
    const auto [last, error] = std::from_chars(format.data() + slash + 1, end, p.version);
    read = error == std::errc() && last == end && p.version > 0;
  }
  if (!read)
    throw Error(ExitCode::bad_input, where,
                "is not a phos file (its metadata have no \"format\" of phos); give a file that a phos "
                "program wrote");
  const std::string name = format.substr(prefix.size(), slash - prefix.size());
  const std::optional<FileKind> kind = kind_named(name);
  if (!kind)
    throw Error(ExitCode::bad_input, where,
                text("is of the kind \"", name,
                     "\", which this version of phos does not know; use the version that made it"));
  p.kind = *kind;
}

std::string made_by(const Container& file) {
  const std::string tool = file.provenance().tool;
  return tool.empty() ? "the stage that made it" : tool.substr(0, tool.find(' '));
}

/// Which named node differs between the two scenes; "" if none.
std::string node_change(const Json* then, const Json* now) {
  if (then == nullptr || now == nullptr || !then->is_object() || !now->is_object()) return "";
  for (const auto& [name, hash] : then->as_object()) {
    const Json* present = now->find(name);
    if (present == nullptr) return "node \"" + name + "\" is gone";
    if (!(*present == hash)) return "node \"" + name + "\" moved";
  }
  for (const auto& [name, hash] : now->as_object())
    if (then->find(name) == nullptr) return "node \"" + name + "\" is new";
  return "";
}

bool differ(const Json& a, const Json& b, const char* part) {
  const Json *of_a = a.find(part), *of_b = b.find(part);
  return of_a != nullptr && of_b != nullptr && !(*of_a == *of_b);
}

const Json::Object* nodes_of(const Json& parts) {
  const Json* nodes = parts.find("nodes");
  return nodes != nullptr && nodes->is_object() ? &nodes->as_object() : nullptr;
}

/// A few of the named nodes that only one of two scenes has: nodes "a", "b", "c" and 4 more.
std::string nodes_beside(const Json::Object& own, const Json::Object& others) {
  constexpr std::size_t kNamed = 3;
  std::string words;
  std::size_t n = 0;
  for (const auto& [name, hash] : own)
    if (!others.contains(name) && ++n <= kNamed) words += text(n == 1 ? "" : ", ", '"', name, '"');
  if (n == 0) return "";
  if (n > kNamed) words += text(" and ", n - kNamed, " more");
  return text(n == 1 ? "node " : "nodes ", words);
}

/// How two scenes differ of which neither is a version of the other: surfaces and materials, and more than
/// half of the nodes (where nodes are not known, lights). "" for versions of one scene.
std::string another_scene(const Json& then, const Json& now, const std::string& now_path) {
  if (!differ(then, now, "geometry") || !differ(then, now, "materials")) return "";
  const Json::Object *nodes_then = nodes_of(then), *nodes_now = nodes_of(now);
  if (!nodes_then || !nodes_now)
    return differ(then, now, "lights") ? text("geometry, materials and lights differ from ", now_path) : "";
  const auto stayed =
      static_cast<std::size_t>(std::count_if(nodes_then->begin(), nodes_then->end(), [&](const auto& node) {
        const auto found = nodes_now->find(node.first);
        return found != nodes_now->end() && found->second == node.second;
      }));
  if (2 * stayed >= std::min(nodes_then->size(), nodes_now->size())) return "";
  const std::string had = nodes_beside(*nodes_then, *nodes_now), has = nodes_beside(*nodes_now, *nodes_then);
  if (had.empty() && has.empty()) return text("geometry, materials and nodes differ from ", now_path);
  return text(had.empty() ? "" : "with " + had, had.empty() || has.empty() ? "" : "; ",
              has.empty() ? "" : text(now_path, " has ", has));
}

/// The options that give such bands; "" for RGB.
std::string bands_of(const Json& parts) {
  const Json* bands = parts.find("bands");
  const Json *number = bands ? bands->find("number") : nullptr,
             *triplet = bands ? bands->find("triplet") : nullptr;
  if (!number || !triplet) return "";
  return text("--bands ", number->dump(), " --triplet ", triplet->dump());
}

std::string scene_change(const Json& then, const Json& now) {
  const Json *time_then = then.find("time"), *time_now = now.find("time");
  if (time_then != nullptr && time_now != nullptr && time_then->is_number() && time_now->is_number() &&
      time_then->as_number() != time_now->as_number())
    return text("time ", shortest(time_then->as_number()), " s is now ", shortest(time_now->as_number()),
                " s");
  const std::string bands_then = bands_of(then), bands_now = bands_of(now);
  if (bands_then != bands_now)
    return text("made ", bands_then.empty() ? "in RGB, without --bands" : "with " + bands_then, ", not ",
                bands_now.empty() ? "in RGB" : "with " + bands_now);
  const Json *sky_then = then.find("environment"), *sky_now = now.find("environment");
  if (sky_then != nullptr && sky_now == nullptr)
    return "it had an environment or a sky; give the same --environment, --sky, --sun";
  if (sky_then == nullptr && sky_now != nullptr) return "it had no --environment, --sky or --sun";
  if (sky_then != nullptr && !(*sky_then == *sky_now))
    return "another --environment, --sky or --sun, or another rotation, scale or option of these";
  const Json *lamps_then = then.find("luminaires"), *lamps_now = now.find("luminaires");
  if (lamps_then != nullptr && lamps_now == nullptr)
    return "it had measured luminaires; give the same --luminaire";
  if (lamps_then == nullptr && lamps_now != nullptr) return "it had no measured luminaire (--luminaire)";
  if (lamps_then != nullptr && !(*lamps_then == *lamps_now)) return "another --luminaire, or --luminaires-as";
  const std::string node = node_change(then.find("nodes"), now.find("nodes"));
  if (!node.empty()) return node;
  for (const char* part : {"geometry", "materials", "lights"}) {
    const Json *a = then.find(part), *b = now.find(part);
    if (a != nullptr && b != nullptr && !(*a == *b)) return text(part, " changed");
  }
  return "";
}

}  // namespace

Metadata to_metadata(const Provenance& p) {
  Metadata m;
  put(m, "format", format_of(p));
  put(m, "tool", p.tool);
  if (p.algorithm != 0) m["algorithm"] = std::to_string(p.algorithm);
  put(m, "command", p.command);
  put(m, "parameters", p.parameters);
  m["inputs"] = valid_utf8(inputs_of(p).dump());
  put(m, "scene", p.scene_hash);
  put(m, "scene_parts", p.scene_parts);
  put(m, "history", p.history);
  put(m, "key", p.key);
  put(m, "extra", p.extra);
  m["counters"] = valid_utf8(counts_of(p.counters).dump());
  return m;
}

Provenance from_metadata(const Metadata& m, const std::string& where) {
  Provenance p;
  read_format(get(m, "format"), where, p);
  try {
    p.tool = get(m, "tool");
    const Json algorithm = get_json(m, "algorithm", where);
    if (!algorithm.is_null()) p.algorithm = static_cast<int>(algorithm.as_integer());
    p.command = get(m, "command");
    p.parameters = get_json(m, "parameters", where);
    const Json inputs = get_json(m, "inputs", where);
    if (!inputs.is_null())
      for (const auto& [role, hash] : inputs.as_object()) p.inputs[role] = hash.as_string();
    p.scene_hash = get(m, "scene");
    p.scene_parts = get_json(m, "scene_parts", where);
    const Json history = get_json(m, "history", where);
    if (!history.is_null()) p.history = Json(history.as_array());
    p.key = get(m, "key");
    p.extra = get_json(m, "extra", where);
    const Json counters = get_json(m, "counters", where);
    if (!counters.is_null())
      for (const auto& [event, n] : counters.as_object()) {
        if (n.as_integer() < 0) throw std::runtime_error("a count below 0");
        p.counters.add(event, static_cast<std::uint64_t>(n.as_integer()));
      }
  } catch (const Error& e) {
    throw Error(ExitCode::bad_input, where,
                text("damaged metadata: ", e.what(), "; rerun the command that made it"));
  } catch (const std::runtime_error& e) {
    throw Error(ExitCode::bad_input, where,
                text("damaged metadata: ", e.what(), "; rerun the command that made it"));
  }
  return p;
}

Json history_entry(const Provenance& p) {
  Json entry(Json::Object{});
  entry["format"] = format_of(p);
  entry["tool"] = p.tool;
  if (p.algorithm != 0) entry["algorithm"] = p.algorithm;
  entry["command"] = p.command;
  entry["parameters"] = p.parameters;
  entry["inputs"] = inputs_of(p);
  if (!p.scene_hash.empty()) entry["scene"] = p.scene_hash;
  entry["key"] = p.key;
  entry["counters"] = counts_of(p.counters);
  return entry;
}

namespace {

/// Lobes are of materials, whatever moves.
bool same_materials(const Json& a, const Json& b) {
  const Json *of_a = a.find("materials"), *of_b = b.find("materials");
  return of_a && of_b && of_a->is_string() && of_b->is_string() && of_a->as_string() == of_b->as_string();
}

}  // namespace

void require_same_scene(const Container& file, const std::string& scene_path, const std::string& scene_hash,
                        const Json& scene_parts) {
  const Provenance& p = file.provenance();
  if (p.scene_hash == scene_hash) return;
  if (p.kind == FileKind::brdf && same_materials(p.scene_parts, scene_parts)) return;
  const std::string remedy = text("; rerun ", made_by(file), ", or pass --allow-mismatch");
  if (p.scene_hash.empty())
    throw Error(ExitCode::mismatch, file.path(), "does not say which scene it was made from" + remedy);
  if (const std::string other = another_scene(p.scene_parts, scene_parts, scene_path); !other.empty())
    throw Error(ExitCode::mismatch, file.path(), text("made from another scene (", other, ")", remedy));
  const std::string change = scene_change(p.scene_parts, scene_parts);
  throw Error(ExitCode::mismatch, file.path(),
              text("made from another scene (", scene_path, " has changed since", change.empty() ? "" : ": ",
                   change, ")", remedy));
}

}  // namespace phos::inline file
