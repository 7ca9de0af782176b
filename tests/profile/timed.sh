#!/usr/bin/env bash
# timed.sh LOG COMMAND...: runs a compiler or linker and adds a line to LOG: its processor seconds
# in total; those for parsing, for templates and for optimising and writing code (g++'s
# -ftime-report); and its output file.
log=$1
shift
said=$(mktemp)
TIMEFORMAT='%U %S'
taken=$( { time "$@" 2>"$said" >&2; code=$?; } 2>&1; exit "$code")
code=$?
output=''
for word in "$@"; do
  [ "$before" != -o ] || output=$word
  before=$word
done
awk -v taken="$taken" -v output="$output" '
  /^ phase parsing/ { parsing = $3 + $5 }
  /^ phase lang. deferred/ { templates = $4 + $6 }
  /^ phase opt and generate/ { code = $5 + $7 }
  END { split(taken, t, " "); printf "%.2f %.2f %.2f %.2f %s\n", t[1] + t[2], parsing, templates, code, output }
' <(tr -s '(:)' ' ' <"$said") >>"$log"
[ "$code" = 0 ] || cat "$said" >&2
rm -f "$said"
exit "$code"
