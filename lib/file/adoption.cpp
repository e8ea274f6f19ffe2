#include "file/adoption.h"

#include "core/error.h"

namespace phos::inline file {
namespace {

void take(Options& options, const std::string& name, const Container& earlier) {
  const Json* recorded = earlier.provenance().parameters.find(name);
  const Json was = recorded ? *recorded : options.unrecorded_value(name);
  const std::string given_as = options.given_as(name);
  const Json asked = options.value(name);
  if (!was.is_null()) adopt_recorded(options, name, was, earlier);
  if (given_as.empty() || (was.is_null() && !recorded)) return;
  if (was.is_null())
    throw Error(ExitCode::mismatch, earlier.path(),
                text("was made without --", name, "; leave --", given_as,
                     " out to add with the same, or make a new file without --add-to"));
  if (!(options.value(name) == asked))
    throw Error(ExitCode::mismatch, earlier.path(),
                text("was made with --", name, " ", shown(was), ", not ", shown(asked), "; leave --",
                     given_as, " out to add with the same, or make a new file without --add-to"));
}

}  // namespace

std::string shown(const Json& value) { return value.is_string() ? value.as_string() : value.dump(); }

void adopt_recorded(Options& options, const std::string& name, const Json& value, const Container& earlier) {
  try {
    options.adopt(name, value);
  } catch (const Error& e) {
    throw Error(ExitCode::bad_input, earlier.path(), text("damaged metadata: --", name, ": ", e.what()));
  }
}

void adopt_estimate(Options& options, const Container& earlier) {
  for (const std::string& name : options.names(Adopted::estimate)) take(options, name, earlier);
}

}  // namespace phos::inline file
