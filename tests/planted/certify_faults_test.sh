#!/usr/bin/env bash
# Runs certify on each planted fault, as on somebody's own detector: certify must say defect and
# name a claim, and the page must show a smallest mesh.
# usage: certify_faults_test.sh ASSAY PLUGIN.so...
set -uo pipefail
assay=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat >"$scratch/few.json" <<'JSON'
{"schema": "assay-campaign/1", "name": "few", "seconds": 120, "strata": [
  {"family": "closed-generic", "cases": 150}, {"family": "closed-degenerate", "cases": 100},
  {"family": "unclosed-generic", "cases": 150}, {"family": "unclosed-degenerate", "cases": 100},
  {"family": "broken", "cases": 50}]}
JSON

failed=0
for plugin in "$@"; do
  name=$(basename "$plugin" .so)
  out=$scratch/$name log=$scratch/$name.log wrong=""
  "$assay" certify --campaign "$scratch/few.json" --detector "$plugin" --out "$out" >"$log" 2>&1
  [ $? -eq 1 ] || wrong="exit code"
  grep -q '^verdict: defect' "$log" || wrong="$wrong verdict"
  "$assay" verify "$out/certificate.json" >"$scratch/verify" 2>&1
  [ $? -eq 1 ] && grep -q '^verified: .* verdict defect' "$scratch/verify" || wrong="$wrong verify"
  "$assay" report "$out" --out "$scratch/page.html" >/dev/null 2>&1 || wrong="$wrong report"
  # The first line that names a claim and the triangles, of a failed trial or of a curated case.
  shown=$(grep -m 1 '^DEFECT' "$log")
  mesh=$(grep -m 1 -- ' -> [0-9]* triangles' "$log" | sed 's/.* -> //')
  [ -n "$shown" ] || wrong="$wrong claim"
  [ -n "$mesh" ] || wrong="$wrong smallest-mesh"
  grep -q '"scene": *{' "$scratch/page.html" || wrong="$wrong scene"
  if [ -n "$wrong" ]; then
    echo "FAILED $name:$wrong"
    tail -n 20 "$log"
    failed=1
  else
    echo "ok $name: ${shown#DEFECT }; $mesh"
  fi
done
exit $failed
