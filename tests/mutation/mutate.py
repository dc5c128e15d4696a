#!/usr/bin/env python3
"""Mutates the detector's sources and counts which mutants its tests find (tests/README.md)."""
import argparse
import json
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

sys.dont_write_bytecode = True  # the sources' folder stays as it is
import mutants
import remembered
import workbench

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WANTED = 0.95  # share to be killed of the mutants that are not named equivalent
CLOCK = "detector/search/stopwatch.h"  # times that are no part of the result
# Programs that judge beside mutant_judge, and which of their tests are about the detector alone.
TESTS = {"detector_tests": "*", "properties_detector_tests": "ViewAnchor.*"}
MOST_USERS = 12  # if more sources include a header, each mutant of it takes too long


def arguments():
    p = argparse.ArgumentParser(description=__doc__)
    p.add_argument("--build", default=str(ROOT / "build/release"), help="build tree (Ninja)")
    p.add_argument("--out", default=str(ROOT / "build/mutation"), help="work and result.json")
    p.add_argument("--facts", help="file of mutation_facts; otherwise written to OUT/facts")
    p.add_argument("--sizes", nargs=3, default=[], metavar=("SMALL", "FAMILY", "QUERIES"),
                   help="of the facts to write, see write_facts.cpp")
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--mutants", type=int, default=130)
    p.add_argument("--jobs", type=int, default=2)
    p.add_argument("--only", nargs="+", help="files that contain one of these texts")
    p.add_argument("--these", help="a JSON list of mutants (file, line, mutated) instead of a draw")
    p.add_argument("--anew", action="store_true", help="forget the outcomes of earlier runs")
    p.add_argument("--all-killed", action="store_true", help="want every mutant killed")
    p.add_argument("--filter", help="tests of detector_tests to ask, and no other program's")
    p.add_argument("--judge-alone", action="store_true", help="leave the detector's tests out")
    return p.parse_args()


def judges_of(options, build):
    facts = options.facts or str(Path(options.out) / "facts")
    if not options.facts:
        subprocess.run([str(build.build / "mutation_facts"), facts, *options.sizes], check=True)
    judges = [workbench.Judge("mutant_judge", build.link_command("mutant_judge"), [facts])]
    if not options.judge_alone:
        tests = {"detector_tests": options.filter} if options.filter else TESTS
        for name, filtered in tests.items():
            judges.append(workbench.Judge(name, build.link_command(name),
                                          ["--gtest_fail_fast", f"--gtest_filter={filtered}"]))
    return judges


def time_judges(judges, build, memory):
    for judge in judges:
        if judge.name in memory.seconds:
            judge.seconds = memory.seconds[judge.name]
            continue
        code, output, judge.seconds = workbench.run_limited(
            [str(build.build / judge.name), *judge.arguments], 600)
        if code != 0:
            sys.exit(f"{judge.name} fails for the detector as it is: {output[-300:]}")
        print(f"{judge.name}: {judge.seconds:.1f} s for the detector as it is", flush=True)
        memory.add_judge(judge.name, judge.seconds)


def by_hand(entry):
    """Returns a mutant that no rule makes. Its line must occur once, or the entry names the `occurrence`."""
    lines = [line.strip() for line in (ROOT / entry["file"]).read_text().split("\n")]
    places = [n for n, line in enumerate(lines, 1) if line == entry["line"]]
    nth = entry.get("occurrence", 1)
    if len(places) < nth or ("occurrence" not in entry and len(places) != 1):
        return []
    return [mutants.Mutant(entry["file"], places[nth - 1], entry["line"], entry["mutated"],
                           entry["about"])]


def named_mutants(path):
    """Returns the mutants of a list at their present lines, and the entries that no mutant fits any more."""
    met, gone = [], []
    for entry in json.loads(Path(path).read_text()):
        file = ROOT / entry["file"]
        same = [m for m in mutants.mutants_of(ROOT, entry["file"])
                if m.key() == (entry["file"], entry["line"], entry["mutated"])] \
            if file.exists() else []
        if "about" in entry:
            same = by_hand(entry)
        met += same[:entry.get("times", 1)]
        if not same:
            gone.append(entry)
    return met, gone


def work_of(options, build):
    """Returns by file its mutants in random order, and how many of them are wanted."""
    if options.these:
        met, gone = named_mutants(options.these)
        for entry in gone:
            sys.exit(f"not met: {entry['file']}: {entry['line']} -> {entry['mutated']}")
        by_file = {}
        for m in met:
            by_file.setdefault(m.file, []).append(m)
        return {file: (list_, len(list_)) for file, list_ in by_file.items()}
    found, weights = {}, {}
    for file in sorted(build.users):
        if file == CLOCK:
            continue
        if len(build.users[file]) > MOST_USERS or (options.only and not any(text in file for text in options.only)):
            continue
        of_file = mutants.in_random_order(options.seed, mutants.mutants_of(ROOT, file))
        if of_file:
            found[file] = of_file
            weights[file] = len({m.number for m in of_file}) * mutants.area_weight(file)
    wanted = mutants.quotas(weights, options.mutants)
    return {file: (found[file], wanted[file]) for file in found}


def judge_file(benches, memory, list_, wanted, show):
    """Judges mutants of a file until `wanted` mutants that compile to other code are judged."""
    bench = benches.get()
    out, valid = [], 0
    try:
        for mutant in list_:
            if valid == wanted:
                break
            start = time.time()
            known = memory.outcome(mutant)
            outcome, judge, how = known or bench.outcome(
                mutant, memory.judges_passed(mutant))
            if not known:
                memory.add(mutant, (outcome, judge, how))
            valid += outcome in ("killed", "survives")
            out.append({**mutant.__dict__, "outcome": outcome, "judge": judge, "how": how,
                        "seconds": round(time.time() - start, 1)})
            show(out[-1])
    finally:
        benches.put(bench)
    return out


def hunk(record):
    return (f"{record['file']}:{record['number']} ({record['kind']})\n"
            f"-  {record['line']}\n+  {record['mutated']}")


def table(records):
    columns = ("killed", "survives", "equivalent", "does not compile", "same code")
    count = {}
    for r in records:
        for row in (r["file"], "all"):
            count.setdefault(row, dict.fromkeys(columns, 0))[r["outcome"]] += 1
    count["all"] = count.pop("all")
    print(f"{'file':44} {'mutants':>7} {'killed':>6} {'equivalent':>10} {'survivors':>9} "
          f"{'no compile':>10} {'same code':>9}")
    for file, c in count.items():
        judged = c["killed"] + c["equivalent"] + c["survives"]
        print(f"{file:44} {judged:7} {c['killed']:6} {c['equivalent']:10} {c['survives']:9} "
              f"{c['does not compile']:10} {c['same code']:9}")
    return count["all"]


def main():
    options = arguments()
    out = Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    build = workbench.Build(ROOT, options.build)
    _, stale = named_mutants(HERE / "equivalent.json")
    equivalent = {(e["file"], e["line"], e["mutated"]): e["reason"]
                  for e in json.loads((HERE / "equivalent.json").read_text())}
    judges = judges_of(options, build)
    build.precompile(out)
    work = work_of(options, build)
    if options.anew:
        (out / "outcomes").unlink(missing_ok=True)
    memory = remembered.Remembered(out / "outcomes", {
        j.name: remembered.digest_of(build.build / j.name, j.arguments) for j in judges})
    time_judges(judges, build, memory)
    benches = SimpleQueue()
    for n in range(options.jobs):
        benches.put(workbench.Workbench(build, out / f"job-{n}", judges))
    start, total = time.time(), sum(wanted for _, wanted in work.values())
    print(f"{total} mutants of {len(work)} files, seed {options.seed}, {options.jobs} jobs",
          flush=True)

    def show(record):
        print(f"{record['outcome']:16} {record['seconds']:5.1f} s {record['file']}:"
              f"{record['number']} {record['mutated'][:60]} [{record['judge']}: {record['how'][:60]}]",
              flush=True)

    with ThreadPoolExecutor(options.jobs) as pool:
        by_weight = sorted(work.values(), key=lambda w: -w[1])
        futures = [pool.submit(judge_file, benches, memory, *w, show) for w in by_weight]
        records = [r for future in futures for r in future.result()]
    records.sort(key=lambda r: (r["file"], r["number"]))
    refuted = []
    for r in records:
        key = (r["file"], r["line"], r["mutated"])
        if key in equivalent and r["outcome"] == "survives":
            r["outcome"], r["how"] = "equivalent", equivalent[key]
        elif key in equivalent and r["outcome"] == "killed":
            refuted.append(r)
    sums = table(records)
    judged = sums["killed"] + sums["survives"]
    score = sums["killed"] / judged if judged else 0.0
    wanted = 1.0 if options.all_killed else WANTED
    for r in records:
        if r["outcome"] == "survives":
            print("\nsurvivor " + hunk(r))
    for r in refuted:
        print("\nnamed equivalent, but killed: " + hunk(r))
    for e in stale:
        print(f"\nnamed equivalent, but not met any more: {e['file']}: {e['line']}")
    (out / "result.json").write_text(json.dumps(
        {"schema": "assay-mutation/1", "seed": options.seed, "score": score, "counts": sums,
         "minutes": round((time.time() - start) / 60, 1), "mutants": records}, indent=1) + "\n")
    print(f"\n{sums['killed']} of {judged} mutants killed: {score:.1%} (wanted {wanted:.0%}); "
          f"{sums['equivalent']} more are equivalent; {(time.time() - start) / 60:.0f} minutes; "
          f"{out / 'result.json'}")
    return 0 if judged and score >= wanted and not stale and not refuted else 1


if __name__ == "__main__":
    sys.exit(main())
