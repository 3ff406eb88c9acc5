#!/usr/bin/env bash
# Runs the firmware in qemu against the simulated board: on both boards of qemu, in both versions of the frames, with
# and without noise on the line. Needs qemu-system-arm and the targets thumbv7em-none-eabihf and thumbv6m-none-eabi.
# usage: run.sh [path of sbgc]
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
sbgc=${1:-}
if [ -z "$sbgc" ]; then
  # From the root: here the settings of cargo name a microcontroller as the target.
  (cd "$root" && cargo build --quiet --locked -p sbgc-cli)
  sbgc=$root/target/debug/sbgc
fi
work=$(mktemp -d)
board=
trap '[ -z "$board" ] || kill "$board" 2>/dev/null || true; rm -rf "$work"' EXIT

# The Cortex-M3 of lm3s6965evb also runs what is built for a Cortex-M0.
cargo build --quiet --locked --release -p firmware --features defmt
cargo build --quiet --locked --release -p firmware --target thumbv6m-none-eabi --no-default-features --features lm3s6965evb
cargo build --quiet --locked --release -p firmware
declare -A program=(
  [mps2-an386]=target/thumbv7em-none-eabihf/release/firmware
  [lm3s6965evb]=target/thumbv6m-none-eabi/release/firmware
)

fly() { # machine, words for the firmware
  local machine=$1 words=$2 arguments= port
  for word in firmware $words; do arguments+=",arg=$word"; done
  : >"$work/port"
  "$sbgc" sim --tcp 127.0.0.1:0 >"$work/port" &
  board=$!
  for _ in $(seq 100); do [ -s "$work/port" ] && break; sleep 0.1; done
  port=$(sed 's/.*://' "$work/port")
  printf '\n--- %s %s\n' "$machine" "$words"
  timeout 120 qemu-system-arm -M "$machine" -kernel "${program[$machine]}" -nographic -monitor none \
    -chardev "socket,id=line,host=127.0.0.1,port=$port" -serial chardev:line \
    -semihosting-config "enable=on,target=native$arguments" </dev/null
  kill "$board"
  wait "$board" 2>/dev/null || true
  board=
}

for machine in mps2-an386 lm3s6965evb; do
  for words in '' noise v1 'v1 noise'; do
    fly "$machine" "$words"
  done
done
printf '\nthe camera arrived every time\n'
