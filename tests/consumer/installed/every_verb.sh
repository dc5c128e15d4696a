#!/bin/sh
# every_verb.sh ASSAY DATA FOLDER [whole]: tries each verb of an installed program. FOLDER holds
# steps.log, a log of a simulator, and libmine.so, a plug-in; DATA is share/assay of the program.
# `whole` adds verbs that take minutes. Ends with 1 at the first verb that fails.
set -eu
assay=$1 data=$2 size=${4:-quick}
cd "$3"

# expect CODE WORDS...: runs the program.
expect() {
  wanted=$1 code=0
  shift
  "$assay" "$@" >log 2>&1 || code=$?
  [ "$code" -eq "$wanted" ] || {
    echo "assay $* ended with $code, and not with $wanted:"
    tail -n 20 log
    exit 1
  }
}

cat >few.json <<'CAMPAIGN'
{"schema": "assay-campaign/1", "name": "few", "seconds": null, "strata":
 [{"family": "closed-generic", "cases": 4}, {"family": "broken", "cases": 4},
  {"family": "unclosed-generic", "cases": 4}],
 "fault_cases": 10, "fault_seeds": 1, "policy": {"self_test_queries": 20}}
CAMPAIGN

expect 0 --version
expect 0 list scenes
expect 0 scene bend --size 200 --frames 4 --out bend
expect 0 check bend/frame_0000.ply bend/frame_0001.ply bend/frame_0002.ply --json check.json
expect 0 check "$data/corpus/curated/B1_one_vertex_own_nearest.json"
expect 0 check "$data/corpus/queries/example_vf.csv"
expect 0 self-test --queries 200
expect 0 check steps.log
expect 0 run --campaign few.json --out proof
expect 0 list failures proof
expect 0 report proof --out proof.html
expect 0 replay quick:1:closed-generic:5 --export exported
expect 0 certify --campaign few.json --power proof --out certified
expect 0 verify certified/certificate.json --again 0.5
expect 0 report certified --out certified.html
expect 0 run --campaign few.json --detector ./libmine.so --power proof --out mine
[ "$size" = whole ] || exit 0
expect 0 certify --campaign few.json --detector ./libmine.so --power proof --out mine
expect 0 verify mine/certificate.json
expect 0 bench --suite stability --quick
