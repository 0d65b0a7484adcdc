# Of what ctest --output-on-failure printed: the tests that failed, each with what it said at the end; of one that is
# many GoogleTests in a row, those of them that failed alone.
#   awk -v name=release -f tests/failed_tests.awk LOG
function show(   i) {
  if (of_gtest++ == 0) print "failed (" name "): " title
  for (i = lines > 40 ? lines - 39 : 1; i <= lines; ++i) print "  " text[i]
  lines = 0
}
function finish() {
  if (title != "" && of_gtest == 0) show()
  title = ""
}
/^ *[0-9]+\/[0-9]+ Test +#[0-9]+:/ {
  finish()
  if ($0 ~ /\*\*\*/ && $0 !~ /\*\*\*Skipped/) {
    title = $0
    sub(/^ *[0-9]+\/[0-9]+ Test +/, "", title)
    gsub(/ \.\.+/, "", title)
    lines = of_gtest = 0
  }
  next
}
/^ +Start +[0-9]+: / { finish(); next }
/^[0-9]+% tests passed, / { finish(); next }
title == "" { next }
{ text[++lines] = $0 }
/^\[ RUN      \] / { lines = 0; text[++lines] = $0 }
/^\[  FAILED  \] .* \([0-9]+ ms\)$/ { show() }
END { finish() }
