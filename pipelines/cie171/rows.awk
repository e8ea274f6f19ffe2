# Turns readings of sensors into rows of results: case,variant,point,sky,estimator,value,stderr,truth. The first file is truth.csv, the second the
# readings. Sensors "NAME@SHARE" are summed, each times its share. The errors of path tracing are independent of each other, so that their squares
# add up; the errors of records are not, and add up themselves.
BEGIN { FS = "," }
NR == FNR { if ($1 "" == case_of "" && $2 "" == variant "" && ($4 "" == sky "" || case_of == "5.5")) truth[$3] = $5; next }
FNR == 1 { next }
function row(point, value, error) {
  if (!(point in truth)) { print "cie171.sh: no truth of case " case_of ", point " point >"/dev/stderr"; exit 3 }
  printf "%s,%s,%s,%s,%s,%.9g,%.4g,%s\n", case_of, variant, point, case_of == "5.5" ? "" : sky, estimator, value, error, truth[point]
}
index($1, "@") == 0 { row($1, $8 * factor, $9 * factor); next }
{
  split($1, part, "@"); name = part[1]
  if (!(name in sum)) order[++names] = name
  sum[name] += part[2] * $8
  indirect[name] += part[2] * $11
  error[name] += estimator == "exact" ? (part[2] * $9) ^ 2 : part[2] * $9
}
END {
  for (i = 1; i <= names; ++i) {
    name = order[i]
    if (estimator == "exact") error[name] = sqrt(error[name])
    if (case_of != "5.8") { row(name, sum[name] * factor, error[name] * factor); continue }
    row("total", sum[name], error[name])
    if (indirect[name] > 0) row("indirect", indirect[name], error[name])
  }
}
