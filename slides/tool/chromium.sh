#!/usr/bin/env bash
# Debian's Chromium with its own profile, no network traffic, and without its sandbox, which does
# not start for root.
profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT
chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
  --disable-background-networking --disable-component-update --disable-sync \
  "$@" --user-data-dir="$profile"
