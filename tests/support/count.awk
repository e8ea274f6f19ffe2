#!/usr/bin/awk -f
# count.awk RESULTS LOG: "PASSED FAILED SKIPPED" of cases that test programs wrote into RESULTS (tests/support/main.cpp), and of scripts by
# the log of ctest. A case that was planned and has no end has failed, with its program. Names the failed ones in RESULTS.
FILENAME == ARGV[1] {
  if ($1 != "planned" || !($2 in cases)) cases[$2] = $1
  suite = $2; sub(/\.[^.]*$/, "", suite); of_program[suite] = 1
  next
}
match($0, /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: [^ ]+/) {
  name = substr($0, RSTART, RLENGTH); sub(/.* /, "", name)
  if (!(name in of_program)) cases[name] = / Passed /? "passed" : /Skipped / ? "skipped" : "failed"
  else if (!/ Passed /) bad[name] = 1
}
END {
  for (name in cases) {
    if (cases[name] == "planned") cases[name] = "failed"
    ++count[cases[name]]
    suite = name; sub(/\.[^.]*$/, "", suite)
    if (cases[name] == "failed") delete bad[suite]
  }
  for (name in bad) { ++count["failed"]; cases[name] = "failed" }  # after its last case
  for (name in cases) print cases[name], name | ("sort -k 2 >" ARGV[1])
  print count["passed"] + 0, count["failed"] + 0, count["skipped"] + 0
}
