#!/usr/bin/env bash
# A night of 8 shards, one of them killed while it runs and one lost later, against the same campaign
# undisturbed.
# usage: nightly_test.sh ASSAY machine|parallel|slurm      77: what it needs is not installed
# shellcheck disable=SC2317  # functions called by trap and expect
set -uo pipefail
by=$2
here=$(cd "$(dirname "$0")" && pwd)
nightly=$here/../../reports/nightly
scratch=$(mktemp -d)
# Stores of another build would be refused: this one stays while the test runs.
assay=$scratch/bin/assay
mkdir "$scratch/bin"
cp "$1" "$(dirname "$1")/assay-worker" "$scratch/bin/"
ln -s "$(dirname "$1")/share" "$scratch/share"
# shellcheck source=tests/nightly/slurm_cluster.sh
. "$here/slurm_cluster.sh"
cleanup() {
  [ "$by" = slurm ] && stop_slurm "$scratch/slurm"
  rm -rf "$scratch"
}
trap cleanup EXIT

case $by in
  parallel) command -v parallel >/dev/null || { echo "GNU parallel is not installed"; exit 77; } ;;
  slurm)
    slurm_is_here || exit 77
    start_slurm "$scratch/slurm" || { echo "Slurm did not come up"; exit 1; }
    ;;
esac

failed=0
expect() { # WHAT CONDITION...
  local what=$1
  shift
  if "$@"; then echo "ok: $what"; else
    echo "FAILED: $what"
    failed=1
  fi
}

cat >"$scratch/tiny.json" <<'JSON'
{"schema": "assay-campaign/1", "name": "tiny", "seconds": 300, "strata": [
  {"family": "closed-generic", "cases": 160},
  {"family": "unclosed-generic", "cases": 80},
  {"family": "broken", "cases": 80}]}
JSON

# Shard 3 is killed the first time, in the middle of its trials; shard 6 always while `stubborn` is
# there.
cat >"$scratch/assay" <<FAKE
#!/usr/bin/env bash
case " \$* " in
  *" --shard 3/8 "*)
    if mkdir "$scratch/killed" 2>/dev/null; then
      "$assay" "\$@" &
      sleep 0.4
      kill -9 \$!
      kill -9 \$\$
    fi ;;
  *" --shard 6/8 "*) [ -e "$scratch/stubborn" ] && kill -9 \$\$ ;;
esac
exec "$assay" "\$@"
FAKE
chmod +x "$scratch/assay"
night() {
  "$nightly" --campaign "$scratch/tiny.json" --seed 5 --shards 8 --at-once 2 --by "$by" \
    --assay "$scratch/assay" --out "$scratch/night" "$@"
}
absent() { [ ! -e "$1" ]; }

touch "$scratch/stubborn"
night --tries 2 >"$scratch/first.out" 2>"$scratch/first.err"
expect "a shard that never ends leaves the night incomplete: exit code 3" test $? -eq 3
expect "its shard is named" grep -q "shards 6 of 8; no certificate" "$scratch/first.err"
expect "no certificate then" absent "$scratch/night/certificate.json"
expect "the killed shard ran again" grep -q "start 2 of 2: 2 shards to do (3 6)" "$scratch/first.out"

rm "$scratch/stubborn"
night >"$scratch/second.out" 2>"$scratch/second.err"
expect "the same command goes on and ends" grep -q "start 1 of 3: 1 shards to do (6)" "$scratch/second.out"
expect "there is a certificate" test -s "$scratch/night/certificate.json"
expect "and a page" test -s "$scratch/night/report.html"
expect "that verifies" "$assay" verify "$scratch/night/certificate.json"

rm "$scratch/night/shards/shard-5-of-8.sqlite"
night >"$scratch/third.out" 2>"$scratch/third.err"
expect "a lost shard is seen and run again" grep -q "start 1 of 3: 1 shards to do (5)" "$scratch/third.out"
expect "its certificate verifies" "$assay" verify "$scratch/night/certificate.json"

"$assay" run --campaign "$scratch/tiny.json" --seed 5 --out "$scratch/whole" >"$scratch/whole.out"
expect "the campaign undisturbed ends" test $? -eq 0
"$assay" merge "$scratch/night/shards" "$scratch/whole" --out "$scratch/both" >"$scratch/both.out" 2>&1
expect "every trial of the night is that of the undisturbed campaign" test $? -eq 0
expect "and none is lost" grep -q "320 of 320 trials" "$scratch/both.out"

[ $failed -eq 0 ] || tail -n 5 "$scratch"/*.out "$scratch"/*.err "$scratch"/night/shards/*.log
exit $failed
