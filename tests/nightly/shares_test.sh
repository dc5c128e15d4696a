#!/usr/bin/env bash
# Runs the lines of reports/README.md that run a campaign in shares, by GNU parallel or as a Slurm
# array, with a small campaign in which one share is killed.
# usage: shares_test.sh ASSAY parallel|slurm      77: a needed program is missing
# shellcheck disable=SC2317  # functions called by trap and expect
set -uo pipefail
by=$2
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
# This build must stay while the test runs, because stores of another build would be refused.
mkdir "$scratch/bin" "$scratch/run"
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
  parallel)
    start='parallel '
    command -v parallel >/dev/null || { echo "GNU parallel is not installed"; exit 77; }
    ;;
  slurm)
    start='sbatch '
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

cat >"$scratch/run/tiny.json" <<'JSON'
{"schema": "assay-campaign/1", "name": "tiny", "seconds": 300, "strata": [
  {"family": "closed-generic", "cases": 160},
  {"family": "unclosed-generic", "cases": 80},
  {"family": "broken", "cases": 80}]}
JSON

# A program `assay` that comes first in the PATH. It kills the share of seed 3 once, as soon as the
# share has stored something.
mkdir "$scratch/first"
cat >"$scratch/first/assay" <<FAKE
#!/usr/bin/env bash
case " \$* " in
  *" --seed 3 "*)
    if mkdir "$scratch/killed" 2>/dev/null; then
      "$scratch/bin/assay" "\$@" &
      until [ -s "$scratch/run/night/3/run.sqlite" ] || ! kill -0 \$!; do sleep 0.05; done
      kill -9 \$! \$\$
    fi ;;
esac
exec "$scratch/bin/assay" "\$@"
FAKE
chmod +x "$scratch/first/assay"
export PATH=$scratch/first:$PATH

line=$(grep -m 1 "^    $start" "$here/../../reports/README.md")
expect "the page has the line" test -n "$line"
line=${line/--campaign nightly/--campaign tiny.json}
echo "$line"
together='assay verify night/* --out all'
expect "and the line that judges the shares together" \
  grep -qxF "    $together" "$here/../../reports/README.md"
cd "$scratch/run" || exit 1

bash -c "$line" >"$scratch/first.out" 2>&1
expect "the killed share has no certificate" test ! -e night/3/certificate.json
expect "a share says incomplete" grep -q '"verdict": "incomplete"' night/2/certificate.json
bash -c "$together" >"$scratch/absent.out" 2>&1
expect "while a share is absent there is no verdict: exit code 2" test $? -eq 2
expect "the share is named" grep -q "night/3/certificate.json: no such file" "$scratch/absent.out"

bash -c "$line" >"$scratch/second.out" 2>&1
bash -c "$together" >"$scratch/together.out" 2>&1
expect "the same line goes on, and all shares are certified" test $? -eq 0
expect "by their digests" test "$(grep -c '"share": "1/8"' all/certificate.json)" -eq 8
expect "that verifies" assay verify all
expect "no trial is lost" grep -q ' of 160 cases' "$scratch/together.out"

[ $failed -eq 0 ] || tail -n 15 "$scratch"/*.out
exit $failed
