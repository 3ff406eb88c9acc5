#!/usr/bin/env bash
# Counts the instructions of each case of benches/instructions.rs with callgrind. Needs valgrind.
# usage: instructions.sh [part of a case's name]
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(cargo bench --quiet --locked -p sbgc-benches --bench instructions --no-run --message-format=json \
  | sed -n 's/.*"executable":"\([^"]*instructions-[^"]*\)".*/\1/p' | tail -n 1)
out=$(mktemp)
trap 'rm -f "$out"' EXIT
"$program" | grep -- "${1:-}" | while IFS=$'\t' read -r count unit name; do
  valgrind --tool=callgrind --callgrind-out-file="$out" --toggle-collect='*measured*' "$program" "$name" \
    >/dev/null 2>&1 </dev/null
  awk -v count="$count" -v unit="$unit" -v name="$name" \
    '/^(summary|totals):/ { printf "%10.1f instructions per %-8s %s\n", $2 / count, unit, name; exit }' "$out"
done
