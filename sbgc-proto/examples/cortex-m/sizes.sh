#!/usr/bin/env bash
# Prints what the parts of sbgc-proto cost on a microcontroller, and builds the programs so that a path to a panic is
# an error of the linker. Needs llvm-size or size, and nm; qemu-system-arm for stack and instructions.
# usage: sizes.sh            print the table
#        sizes.sh --write    put it into sizes.md, which the crate's documentation shows
#        sizes.sh --check    fail if a size is more than 5 % above that in sizes.md
set -euo pipefail
cd "$(dirname "$0")"
published=../../src/link/sizes.md
programs=(decoder chunks telemetry degrees link incoming outgoing)

section() { # program, names of sections
  size -A "$1" | awk -v names="$2" 'BEGIN { split(names, list, " ") } { for (i in list) if ($1 == list[i]) sum += $2 } END { print sum + 0 }'
}

table() {
  local target level program folder text constants ram base
  echo '| program | what is in it | target | text "s" | text "z" | constants | RAM |'
  echo '| --- | --- | --- | --- | --- | --- | --- |'
  declare -A sizes
  for target in thumbv7em-none-eabihf thumbv6m-none-eabi; do
    for level in s z; do
      CARGO_PROFILE_RELEASE_OPT_LEVEL=$level cargo build --quiet --locked --release -p sizes --target "$target"
      folder=target/$target/release
      base=$(section "$folder/nothing" .text)
      for program in "${programs[@]}"; do
        text=$(($(section "$folder/$program" .text) - base))
        sizes[$target,$level,$program]=$text
        constants=$(section "$folder/$program" .rodata)
        ram=$(section "$folder/$program" '.data .bss')
        # Constants and RAM stand beside the text of "s", which has the more.
        [ "$level" = z ] || sizes[$target,rest,$program]="$constants | $ram"
      done
      if [ "$level$target" = sthumbv7em-none-eabihf ]; then
        cargo build --quiet --locked --release -p measure --target "$target"
        cp "$folder/measure" target/measure
        cp "$folder/types" target/types
      fi
    done
  done
  for target in thumbv7em-none-eabihf thumbv6m-none-eabi; do
    for program in "${programs[@]}"; do
      what=$(sed -n '1s|^//! ||p' "sizes/src/bin/$program.rs")
      echo "| \`$program\` | $what | $target | ${sizes[$target,s,$program]} | ${sizes[$target,z,$program]} | ${sizes[$target,rest,$program]} |"
    done
  done
  echo
  echo '| type | bytes |'
  echo '| --- | --- |'
  nm --print-size --radix=d target/types | awk '/ SIZE_OF_/ { sub("SIZE_OF_", "", $4); print "| " tolower($4) " | " $2 + 0 " |" }'
  if command -v qemu-system-arm >/dev/null; then
    echo
    echo '| measured on a Cortex-M4, "s" | |'
    echo '| --- | --- |'
    timeout 120 qemu-system-arm -M mps2-an386 -kernel target/measure -nographic -monitor none -serial none \
      -icount shift=0 -semihosting-config enable=on,target=native </dev/null \
      | awk -F': ' 'NF == 2 { print "| " $1 " | " $2 " |" }'
  fi
}

case ${1:-} in
  --write) table >"$published.new" && mv "$published.new" "$published" ;;
  --check)
    table | tee target/sizes.md
    awk -F'|' '
      function key(  i, k) { k = ""; for (i = 2; i <= NF; i++) if ($i !~ /^ *[0-9]/) k = k "|" $i; return k }
      NR == FNR { if (/[0-9]/) for (i = 2; i < NF; i++) if ($i ~ /^ *[0-9]/) was[key() ":" i] = $i + 0; next }
      { for (i = 2; i < NF; i++) if ($i ~ /^ *[0-9]/) {
          k = key() ":" i; seen++
          if (!(k in was)) { print "not in the published table:" $0; bad = 1 }
          else if ($i + 0 > was[k] * 1.05 + 8) { print "grown from " was[k] " to " $i + 0 ":" $0; bad = 1 }
      } }
      END { if (!seen) { print "nothing was measured"; bad = 1 } exit bad }
    ' "$published" target/sizes.md || { echo 'renew the table with sizes.sh --write if that is wanted'; exit 1; }
    ;;
  *) table ;;
esac
