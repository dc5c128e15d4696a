#!/usr/bin/env bash
# How a night ends that is interrupted, or refused: with fakes of assay in place of the program.
# shellcheck disable=SC2317  # functions called by trap and expect
set -uo pipefail
nightly=$(cd "$(dirname "$0")" && pwd)/../../reports/nightly
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
expect() { # WHAT CONDITION...
  local what=$1
  shift
  if "$@"; then echo "ok: $what"; else
    echo "FAILED: $what"
    failed=1
  fi
}
never() { ! "$@"; }

# Each run leaves its process number and that of a child; while `slow` is there it never ends.
cat >"$scratch/assay" <<FAKE
#!/usr/bin/env bash
case \$1 in
  merge) echo "1 stores of campaign tiny"; echo "next: assay certify --campaign tiny" ;;
  run)
    echo \$\$ >>"$scratch/pids"
    touch "$scratch/night/shards/shard-\$(echo "\$7" | sed 's#/#-of-#').sqlite"
    [ -e "$scratch/refuse" ] && rm "$scratch/night/shards/"*.sqlite && echo "assay: smok: cannot be read" >&2 && exit 2
    echo "trials: 5/10 trials, 0 with a defect"
    if [ -e "$scratch/slow" ]; then
      sleep 1000 &
      echo \$! >>"$scratch/pids"
      wait
    fi
    echo "shard \$7: complete" ;;
esac
FAKE
chmod +x "$scratch/assay"
command=("$nightly" --campaign smok --seed 5 --shards 4 --at-once 2 --assay "$scratch/assay" --out "$scratch/night")
some_live() {
  local pid
  while read -r pid; do kill -0 "$pid" 2>/dev/null && return; done <"$scratch/pids"
  return 1
}
until_there() { # FILE LINES: at most 10 s
  local i
  for ((i = 0; i < 100; i++)); do
    [ -e "$1" ] && [ "$(wc -l <"$1")" -ge "$2" ] && return
    sleep 0.1
  done
  return 1
}

# INT as a terminal sends it, to all that are in the foreground; TERM to the script alone.
for signal in INT TERM; do
  touch "$scratch/slow"
  rm -rf "$scratch/night" "$scratch/pids"
  set -m
  "${command[@]}" >"$scratch/out" 2>"$scratch/err" &
  night=$!
  set +m
  expect "two shards run" until_there "$scratch/pids" 4
  "${command[@]}" >"$scratch/second" 2>&1
  expect "another night beside it is refused" test $? -eq 2
  expect "with a line" grep -q "another night is at work there" "$scratch/second"
  if [ $signal = INT ]; then kill -INT -- -$night; else kill -TERM $night; fi
  wait $night
  expect "$signal: exit code 3" test $? -eq 3
  expect "one line says what is left" grep -qx "nightly: interrupted: .* the same command goes on" "$scratch/err"
  expect "all that was started is ended" never some_live
  rm "$scratch/slow"
  "${command[@]}" >"$scratch/out" 2>"$scratch/err"
  expect "the same command goes on" test $? -eq 0
  expect "no line of merge about a next command" never grep -q "^next:" "$scratch/out"
done

touch "$scratch/refuse"
rm -rf "$scratch/night" "$scratch/pids"
"${command[@]}" >"$scratch/out" 2>"$scratch/err"
expect "a usage error: exit code 2" test $? -eq 2
expect "with the line of the shard" grep -qx "nightly: refused: assay: smok: cannot be read" "$scratch/err"
expect "and no other start" test "$(wc -l <"$scratch/pids")" -le 3
rm "$scratch/refuse"

# On a terminal.
touch "$scratch/slow"
rm -rf "$scratch/night" "$scratch/pids"
timeout 5 script -qec "${command[*]}" /dev/null >"$scratch/shown" 2>&1 </dev/null
expect "a live line a shard" grep -q "shard 2/4: trials: 5/10 trials" "$scratch/shown"
for ((i = 0; i < 50; i++)); do some_live && sleep 0.1; done
expect "a terminal that is gone ends all" never some_live

[ $failed -eq 0 ] || tail -n 20 "$scratch"/out "$scratch"/err "$scratch"/shown
exit $failed
