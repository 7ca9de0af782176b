#!/usr/bin/env bash
# formulas.sh SUITE K: prints the slides' formulas up to lab K's, by name, as Markdown. Handouts and
# hints cite them, e.g. "slides 04:neyman", and students do not have the slides.
set -euo pipefail
suite=$1 last=$2

cat <<'END'
# The slides' formulas

A note such as *slides 01:welford*, in handouts, hints and sources, names a formula of the lecture's
slides: here it is, below its deck and slide. (VS Code's preview and GitHub set it as mathematics.)
END
for deck in "$suite"/slides/[0-9][0-9]*.md; do
  number=$(basename "$deck")
  number=${number:0:2}
  [ "$((10#$number))" -le "$last" ] || continue
  # The first heading is the deck's title; a formula goes from its label to the line that ends in
  # $$.
  awk -v number="$number" '
    !deck && /^# / { deck = substr($0, 3); next }
    /^# / { slide = substr($0, 3); next }
    /^<!-- eq: [a-z0-9-]+ -->$/ {
      if (!any++) printf "\n## Deck %s: %s\n", number, deck
      printf "\n**%s:%s** (%s)\n\n", number, $3, slide
      inside = 1
      next
    }
    inside { print }
    inside && /\$\$[ .,;]*$/ { inside = 0 }
  ' "$deck"
done
