# Turns results.csv into a page (format html or md). The page gives the largest deviation for each case and estimator, and counts the values outside of
# 2 % and two standard errors.
BEGIN {
  FS = ","
  what["5.2"] = "point source"; what["5.3"] = "area source"; what["5.4"] = "flux conservation"; what["5.5"] = "directional transmittance of glass"
  what["5.6"] = "diffuse reflection of a square"; what["5.7"] = "diffuse reflection with an obstruction"; what["5.8"] = "interreflection in a cube"
  what["5.9"] = "roof opening"; what["5.10"] = "roof opening with glass"; what["5.11"] = "facade opening, sky and ground"
  what["5.12"] = "facade opening with glass"; what["5.13"] = "facade opening under a horizontal mask"
  what["5.14"] = "facade opening behind a vertical mask"
}
# The subject of a case, with the number of its skies.
function subject(c) { return what[c] (skies[c] == 0 ? "" : skies[c] == 1 ? ", 1 sky" : ", " skies[c] " skies") }
function magnitude(x) { return x < 0 ? -x : x }
NR == 1 { next }
{
  key = $1 SUBSEP $5
  if ($4 != "" && !(($1, $4) in under)) { under[$1, $4] = 1; ++skies[$1] }
  if (!($1 in seen)) { seen[$1] = 1; cases[++number_of_cases] = $1 }
  if (!($5 in column)) { column[$5] = 1; estimators[++number_of_estimators] = $5 }
  off = $6 - $8; share = $8 > 0 ? off / $8 : 0
  ++points[key]; ++all
  if (magnitude(share) > magnitude(worst[key])) worst[key] = share
  if ($7 > 0.0005 * $8 && $8 > 0) { squares[key] += (off / $7) ^ 2; ++judged[key]; relative[key] += $7 / $8 }
  if (magnitude(off) > 0.02 * $8 + 1e-9 && magnitude(off) > 2 * $7) { ++outside[key]; ++all_outside; list[++listed] = $0 }
}
function cells(header, a, b, c, d, e, f, g) {
  if (format == "md") { print "| " a " | " b " | " c " | " d " | " e " | " f " | " g " |"; return }
  tag = header ? "th" : "td"
  print "<tr><" tag ">" a "</" tag "><" tag ">" b "</" tag "><" tag ">" c "</" tag "><" tag ">" d "</" tag "><" tag ">" e "</" tag "><" tag ">" f \
    "</" tag "><" tag ">" g "</" tag "></tr>"
}
function paragraph(text) { print format == "md" ? text "\n" : "<p>" text "</p>" }
function heading(level, text) { print format == "md" ? substr("###", 1, level) " " text "\n" : "<h" level ">" text "</h" level ">" }
END {
  if (format == "html") {
    print "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>phos and CIE 171:2006</title>"
    print "<style>body{font:15px sans-serif;max-width:70em;margin:2em auto;padding:0 1em}td,th{padding:.2em .8em;border-bottom:1px solid #ccc;text-align:left}</style>"
  }
  heading(1, "Validation with CIE 171:2006")
  paragraph("CIE 171:2006 holds test cases with analytic solutions, for programs that compute light. The true values of this page are quadratures of the " \
    "same integrals (to 2e-6), because the tables of the report have errata and coarse quadratures. The values of cases 5.9 to 5.14 are percent of " \
    "the illuminance on open ground under the same sky. The sun stands 60 degrees high in the south and is hidden: it shapes the sky, and gives no " \
    "light of its own.")
  paragraph("The estimator \"exact\" traces paths at each point. \"Records\" counts photons about each point, and takes direct light from shadow rays. " \
    "\"Gathered\" sends rays that read records of photons, and takes direct light from shadow rays. \"Cached\" is as \"gathered\", with direct light " \
    "in the records. \"Picture\" reads the pixels of a picture of phos-splat. \"Photons\" is as \"records\", but counts direct light too.")
  paragraph("Of " all " values, " all - all_outside " (" sprintf("%.1f", 100 * (all - all_outside) / all) " %) are within 2 % or two standard errors of the " \
    "true value. Where the standard error is above 1 %, chance alone puts one value in 22 outside. Settings: " settings ".")
  if (format == "html") print "<table>"
  cells(1, "case", "subject", "estimator", "values", "largest deviation from the true value", "mean standard error", \
    "values outside of 2 % and two standard errors (root mean square deviation in standard errors)")
  if (format == "md") print "|---|---|---|---|---|---|---|"
  for (i = 1; i <= number_of_cases; ++i)
    for (k = 1; k <= number_of_estimators; ++k) {
      key = cases[i] SUBSEP estimators[k]
      if (!(key in points)) continue
      cells(0, cases[i], subject(cases[i]), estimators[k], points[key], sprintf("%+.2f %%", 100 * worst[key]),
        judged[key] ? sprintf("%.2f %%", 100 * relative[key] / judged[key]) : "0",
        (outside[key] + 0) " (" (judged[key] ? sprintf("%.2f", sqrt(squares[key] / judged[key])) : "-") ")")
    }
  print format == "html" ? "</table>" : ""
  if (format == "html" && listed > 0) {
    heading(2, "Values outside of 2 % and two standard errors")
    print "<pre>case,variant,point,sky,estimator,value,stderr,truth"
    for (i = 1; i <= listed; ++i) print list[i]
    print "</pre>"
  }
}
