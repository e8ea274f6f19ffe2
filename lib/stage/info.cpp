#include "stage/info.h"

#include "file/atomic_file.h"
#include "file/inspect/inspect.h"
#include "file/inspect/rows.h"

namespace phos::stage {
namespace {

void verify(Tool& tool, const InfoCommand& r) {
  try {
    Container::open(r.path).require_sound();
  } catch (const Error& e) {
    if (e.code() != ExitCode::bad_input) throw;
    if (tool.verbose()) tool.say(e.where() + ": " + e.what());
    tool.set_exit(ExitCode::bad_input);
  }
}

void print(const InfoCommand& r, const Sink& sink) {
  const Container file = Container::open(r.path);
  if (!r.dump.empty()) {
    dump_csv(file, r.dump, r.decode, sink);
  } else if (r.points) {
    write_ply(file, r.ply, sink);
  } else if (r.json) {
    sink(describe(file).dump(2) + "\n");
  } else {
    sink(r.canonical ? canonical_text(file) : describe_text(file));
  }
}

}  // namespace

void run(Tool& tool, const InfoCommand& asked) {
  const int wanted = asked.json + asked.canonical + asked.points + asked.verify + !asked.dump.empty();
  if (wanted > 1)
    throw Error(ExitCode::usage, "",
                "--json, --canonical, --dump, --points and --verify exclude each other; give one");
  if (asked.verify) return verify(tool, asked);
  AtomicFile file(asked.output.empty() ? "/dev/stdout" : asked.output);
  print(asked, [&](std::string_view s) { file.write(s); });
  file.commit();
}

}  // namespace phos::stage
