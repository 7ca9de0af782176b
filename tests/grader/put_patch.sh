#!/usr/bin/env bash
# put_patch.sh PATCH SOLUTION OUTPUT: the solution with a mistake or a variant, by the patch of it.
patch --quiet --fuzz=0 --no-backup-if-mismatch --reject-file=- "--output=$3" "$2" "$1" && exit
printf '%s: error: the patch no longer applies to %s: tests/grader/patch_anew.sh makes it anew\n' "$1" "$2" >&2
exit 1
