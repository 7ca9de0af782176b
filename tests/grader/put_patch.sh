#!/usr/bin/env bash
# put_patch.sh PATCH SOLUTION OUTPUT: writes the solution with a mistake's or variant's patch
# applied.
patch --quiet --fuzz=0 --no-backup-if-mismatch --reject-file=- "--output=$3" "$2" "$1" && exit
printf '%s: error: the patch no longer applies to %s: tests/grader/patch_anew.sh makes it anew\n' "$1" "$2" >&2
exit 1
