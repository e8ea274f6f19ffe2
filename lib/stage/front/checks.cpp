#include "stage/front/checks.h"

#include <langinfo.h>
#include <locale.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <limits>

#include "core/error.h"
#include "core/facts/programs.h"
#include "core/memory.h"
#include "core/options.h"
#include "core/parallel.h"
#include "core/processor.h"
#include "splat/gl/probe.h"
#include "stage/front/child.h"
#include "stage/front/launch.h"

namespace phos::stage {
namespace {

constexpr unsigned kPatience_s = 20;
constexpr double kLittleMemory = 0x1p29, kLittleSpace = 0x1p26;  // bytes

MachineCheck good(const std::string& name, const std::string& found) {
  return {name, true, false, found, ""};
}

/// The output of the program in that file, also an error of the loader.
ChildResult run_program(const std::string& path, const std::string& name,
                        const std::vector<std::string>& arguments) {
  return in_child(
      [&] {
        ::dup2(1, 2);
        replace_by(path, name, arguments);
        throw Error(ExitCode::bad_input, "", std::strerror(errno));
      },
      kPatience_s);
}

std::string first_line(const std::string& s) { return s.substr(0, s.find('\n')); }

MachineCheck check_programs() {
  MachineCheck check = good("programs", text("all ", all_programs().size(), ", version ", version()));
  check.required = true;
  for (const Program& program : all_programs()) {
    const std::string name(program.name), path = path_of_phos(name);
    const std::string expected = text(name, ' ', version());
    std::string fault;
    if (path.empty()) {
      fault = name + " is neither beside phos nor on PATH";
    } else if (const ChildResult run = run_program(path, name, {"--version"}); !run.done) {
      fault = text(path, ": ", first_line(run.said));
    } else if (run.said != expected) {
      fault = text(path, " is \"", first_line(run.said), "\", not \"", expected, "\"");
    }
    if (fault.empty()) continue;
    check.found = check.ok ? fault : check.found + "; " + fault;
    check.ok = false;
    check.remedy = "install phos again, with the libraries that its package names";
  }
  return check;
}

MachineCheck check_gl(const GlKind& kind) {
  const ChildResult drawn = in_child([&] { std::cout << try_gl(kind.by); }, kPatience_s);
  return {kind.name, drawn.done, kind.required, drawn.done ? drawn.said + "; draws" : drawn.said,
          kind.remedy};
}

MachineCheck check_instructions() {
  return good("instruction sets", has_avx2() ? "AVX2, FMA, BMI2" : "the plainest of this processor family");
}

MachineCheck check_cores() {
  return good("cores", text(thread_count(), " threads are used of ", ::sysconf(_SC_NPROCESSORS_ONLN),
                            " cores (--threads)"));
}

MachineCheck check_memory() {
  const std::uint64_t bytes = free_memory_bytes();
  if (bytes == std::numeric_limits<std::uint64_t>::max())
    return good("memory", "as much as is asked for: neither the system nor a limit tells");
  const auto free = static_cast<double>(bytes);
  return {"memory", free >= kLittleMemory, false, memory_text(free) + " free",
          "end other programs, or raise ulimit -v"};
}

/// Can a file be made there? If not, the reason.
std::string cannot_write(const std::filesystem::path& folder) {
  std::string path = (folder / "phos-doctor-XXXXXX").string();
  const int fd = ::mkstemp(path.data());
  if (fd < 0) return std::strerror(errno);
  ::unlink(path.c_str());
  ::close(fd);
  return "";
}

/// Studies and plans keep their files there while they run.
MachineCheck check_temporary_folder() {
  MachineCheck check{"temporary folder", false, true, "", "export TMPDIR=FOLDER, one that can be written"};
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  const char* set = std::getenv("TMPDIR");
  const std::string name = error && set != nullptr ? set : folder.string();
  const std::string why = error ? "is no folder" : cannot_write(folder);
  struct statvfs space = {};
  if (!why.empty()) {
    check.found = text(name, ": ", why, "; phos-study and phos-plan --run need it");
  } else if (::statvfs(folder.c_str(), &space) != 0) {
    check.found = text(name, ": ", std::strerror(errno));
  } else {
    const double free = static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize);
    check.ok = free >= kLittleSpace;
    check.found = text(name, ", ", memory_text(free), " free");
  }
  return check;
}

/// A program from elsewhere that works if it answers `arguments` with a line that begins with `answer`.
struct Helper {
  const char* name;
  std::vector<std::string> arguments;
  const char *answer, *use, *package;
};

const std::vector<Helper>& helpers() {
  static const std::vector<Helper> all{
      {"ffmpeg", {"-version"}, "ffmpeg version", "phos-picture makes videos with it", "ffmpeg"},
      {"jq", {"-n", "1.5"}, "1.5", "pipelines read figures with it", "jq"},
      {"awk", {"BEGIN { print 1.5 }"}, "1.5", "pipelines compute with it", "mawk"},
      {"man", {"--version"}, "man ", "it shows what --man prints", "man-db"},
  };
  return all;
}

MachineCheck check_helper(const Helper& helper) {
  MachineCheck check{helper.name, false, false, "", text("apt-get install ", helper.package)};
  const std::string path = path_of(helper.name);
  if (path.empty()) {
    check.found = text("not on PATH; ", helper.use);
    return check;
  }
  const ChildResult run = run_program(path, helper.name, helper.arguments);
  check.ok = run.done && run.said.starts_with(helper.answer);
  check.found = check.ok ? path : text(path, ": answers \"", first_line(run.said), "\"; ", helper.use);
  return check;
}

/// Programs of phos write the same in every locale. Programs from elsewhere may not.
MachineCheck check_locale() {
  MachineCheck check{"locale", false, false, "", "export LC_ALL=C.UTF-8, or apt-get install locales"};
  std::string set;
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LC_NUMERIC", "LANG"})
    if (const char* value = std::getenv(name); value != nullptr && *value != '\0')
      set += text(set.empty() ? "" : " ", name, '=', value);
  if (set.empty()) set = "none set";
  const locale_t locale = ::newlocale(LC_ALL_MASK, "", nullptr);
  if (locale == nullptr) {
    check.found = set + ": is not installed; awk, jq and man may complain";
    return check;
  }
  const std::string point = ::nl_langinfo_l(RADIXCHAR, locale), codes = ::nl_langinfo_l(CODESET, locale);
  ::freelocale(locale);
  check.ok = point == ".";
  check.found = check.ok
                    ? text(set, ", ", codes)
                    : text(set, ": writes numbers with \"", point, "\"; pipelines need a point from awk");
  return check;
}

}  // namespace

std::vector<MachineCheck> check_machine() {
  std::vector<MachineCheck> all{check_programs()};
  for (const GlKind& kind : gl_kinds()) all.push_back(check_gl(kind));
  for (const auto check : {check_instructions, check_cores, check_memory, check_temporary_folder})
    all.push_back(check());
  for (const Helper& helper : helpers()) all.push_back(check_helper(helper));
  all.push_back(check_locale());
  for (MachineCheck& check : all)
    if (check.ok) check.remedy.clear();
  return all;
}

}  // namespace phos::stage
