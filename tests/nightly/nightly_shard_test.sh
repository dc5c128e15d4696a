#!/usr/bin/env bash
# What a shard of a night makes of the exit codes of `assay run`: which are worth another start.
set -uo pipefail
shard=$(cd "$(dirname "$0")" && pwd)/../../reports/nightly_shard
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

# An assay that ends with CODE and, where it has BEGUN, leaves a store behind.
expect() { # WHAT CODE-OF-SHARD CODE BEGUN LAST-LINE
  rm -rf "$scratch/night"
  cat >"$scratch/assay" <<FAKE
#!/usr/bin/env bash
[ $4 = begun ] && : >"$scratch/night/shards/shard-2-of-3.sqlite"
echo "$5"
exit $3
FAKE
  chmod +x "$scratch/assay"
  "$shard" "$scratch/assay" "$scratch/night" tiny 1 1 '' '' 1 '' 2/3
  local code=$?
  if [ $code -eq "$2" ]; then echo "ok: $1"; else
    echo "FAILED: $1: exit code $code, not $2"
    failed=1
  fi
}

expect "a shard that is complete" 0 0 begun "shard 2/3: complete"
expect "a shard that is complete, with defects" 0 1 begun "shard 2/3: complete"
expect "a shard out of time goes on" 75 3 begun "shard 2/3: 10 trials left"
expect "a killed one goes on" 75 137 begun ""
expect "no worker in the middle of it passes" 75 2 begun "assay: cannot start assay-worker"
expect "a wrong name does not" 2 2 refused "assay: no campaign of this name"
expect "nor does the store of another run" 2 2 begun "assay: x.sqlite: holds another run: seed 1 and 2"
exit $failed
