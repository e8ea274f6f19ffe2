# The list of tables -> a page of those that the folder holds: rows, plots and pictures.
BEGIN { FS = "|" }
function text(s) { gsub(/&/, "\\&amp;", s); gsub(/</, "\\&lt;", s); gsub(/>/, "\\&gt;", s); return s }
# A row of fields, each in quotes, into field[1..]; returns their number.
function fields(line,    n, i) {
  sub(/^"/, "", line); sub(/"\r?$/, "", line)
  n = split(line, field, "\",\"")
  for (i = 1; i <= n; ++i) gsub(/""/, "\"", field[i])
  return n
}
# Every picture, with the line of FILE.caption where there is one.
function shown(name,    path, command, file, caption) {
  command = "ls '" folder "/" name "' 2>/dev/null | grep -E '\\.(svg|png)$'"
  while ((command | getline file) > 0) {
    path = folder "/" name "/" file ".caption"
    if ((getline caption < path) > 0) caption = ": " text(caption); else caption = ""
    close(path)
    figures = figures "<figure><img src=\"" name "/" file "\"><figcaption>" text(file) caption "</figcaption></figure>\n"
  }
  close(command)
}
{
  csv = folder "/" $1 ".csv"
  body = ""; settings = ""; figures = ""
  n = 0
  while ((getline line < csv) > 0) {
    if (++n == 1 || fields(line) < 6) continue
    if (field[1] == "settings") { settings = field[4]; continue }
    ++count[field[5]]
    body = body "<tr class=\"" field[5] "\"><td>" text(field[1]) "</td><td>" text(field[3]) "</td><td>" text(field[4]) "</td><td>" text(field[2]) \
      "</td><td>" field[5] "</td><td>" text(field[6]) "</td></tr>\n"
  }
  close(csv)
  if (n == 0) { missing = missing (missing == "" ? "" : ", ") $1; next }
  shown($1)
  if (settings ~ /^toy/) toy = 1
  tables = tables "<h2 id=\"" $1 "\">" $1 ": " text($3) "</h2>\n<p>" text($2) ". <a href=\"" $1 ".csv\">" $1 ".csv</a>; " text(settings) \
    "</p>\n<table><tr><th>quantity</th><th>paper</th><th>ours</th><th>unit</th><th>verdict</th><th>why</th></tr>\n" body "</table>\n" \
    "<div>" figures "</div>\n"
  list = list "<li><a href=\"#" $1 "\">" $1 "</a>: " text($3) "</li>\n"
}
END {
  print "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>phos and its papers</title>"
  print "<style>body{font:15px sans-serif;max-width:75em;margin:2em auto;padding:0 1em}td,th{padding:.2em .8em;border-bottom:1px solid #ccc;" \
    "text-align:left;vertical-align:top}.worse td:nth-child(5){color:#b00}.better td:nth-child(5){color:#070}.skipped{color:#777}" \
    "figure{display:inline-block;vertical-align:top;max-width:30em;margin:.5em}img{max-width:100%}</style>"
  print "<h1>phos and its papers</h1>\n<p>Each table's figures as the paper prints them, and as " text(version) " computes them on this machine. " \
    "<i>agrees</i>: within a quarter of the paper's figure, or as it claims; <i>better</i>, <i>worse</i>: beyond; <i>-</i>: not judged, such as seconds " \
    "on machines of 2004 to 2011. Errors are root mean square over the mean, the noise of the references taken out. Times at equal error: seconds " \
    "times the square of the ratio of errors.</p>"
  if (toy) print "<p><b>Tables of toy size are among them: their figures say nothing.</b></p>"
  print "<p>Verdicts: " count["agrees"] + 0 " agree, " count["better"] + 0 " better, " count["worse"] + 0 " worse, " count["skipped"] + 0 " skipped.</p>"
  print "<ul>\n" list "</ul>"
  if (missing != "") print "<p>Not computed: " missing ".</p>"
  print tables
}
