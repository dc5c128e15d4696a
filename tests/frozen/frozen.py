#!/usr/bin/env python3
"""Writes the verdicts of the harness on fixed subjects, as rows of text.

usage: frozen.py [BUILD] [--whole] [--out FILE | --renew]

If only the inside of the harness changes, each row must stay the same. A subject is a detector that gives
the same answers each time. A row holds, separated by tabs: the subject, the seed, the part of the verdict,
and its value as JSON, without parts that depend on the clock, the machine or the build. Each subject runs
on a twentieth of the cases of campaign smoke, of one seed (a minute on two cores); with --whole, on all
cases of three seeds (half an hour). The rows are compared with rows.txt, which has digests of long values,
and differing rows are printed. --out writes all rows, so that two runs can be compared.
Exit code 0: all rows are the same, and each claim and outcome occurs.
"""
import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STRATA = {  # of campaign smoke
    "closed-generic": 600, "closed-near-degenerate": 200, "closed-degenerate": 200,
    "closed-far-large-step": 200, "unclosed-generic": 600, "unclosed-degenerate": 200,
    "unclosed-near-degenerate": 200, "closed-everyday": 200, "unclosed-everyday": 200, "broken": 200,
    "counted": 200, "limits": 200, "within": 200,
}
# The Python for which the module `assay` is built.
PYTHON = os.environ.get("ASSAY_PYTHON", "/usr/bin/python3")
# By name: the library below BUILD, and its environment variables. `built-in`, `limiter` and `distance`
# are right.
PLUGIN = "tests/plugins/plugin_{}.so".format
SUBJECTS = {
    "built-in": ("", {}),
    "limiter": (PLUGIN("limits_steps"), {}),
    "distance": (PLUGIN("keeps_distance"), {}),
    "stalls": (PLUGIN("limits_steps"), {"ASSAY_LIMITS_STEPS": "parallel-zero"}),
    "passes": (PLUGIN("limits_steps"), {"ASSAY_LIMITS_STEPS": "rounds-up"}),
    "rounds": (PLUGIN("limits_steps"), {"ASSAY_LIMITS_STEPS": "float-end"}),
    "candidates": (PLUGIN("candidates_alone"), {"ASSAY_CANDIDATES": "ends-only"}),
    "relations": (PLUGIN("takes_relations"), {"ASSAY_TAKES_RELATIONS": "ignores"}),
    "free": (PLUGIN("always_free"), {}),
    "late": (PLUGIN("wrong_wrapper"), {"ASSAY_TEST_WRONG": "1"}),
    "drops": (PLUGIN("wrong_wrapper"), {"ASSAY_TEST_WRONG": "0"}),
    "adds": (PLUGIN("wrong_wrapper"), {"ASSAY_TEST_WRONG": "8"}),
    "drawn": (PLUGIN("wrong_wrapper"), {"ASSAY_TEST_WRONG": "10"}),
    "refuses": (PLUGIN("by_contract"), {"ASSAY_BY_CONTRACT": "start=free capacity-triangles=40 refuse-from=12"}),
    "fails": (PLUGIN("fail"), {}),
    "errors": (PLUGIN("by_contract"), {"ASSAY_BY_CONTRACT": "claims=31 features=vertex-face refuse-from=9"}),
    "python": ("python:additive_ccd:AdditiveCcd", {}),
    "cubic": ("peers/cubic_double.so", {}),
    "fcl": ("peers/fcl_elementary.so", {}),
}
# Parts of a certificate that are lists, and the member that names the items of each list.
LISTS = {"gates": "gate", "strata": "family", "failures": "signature", "judged_up_to": "claim",
         "not_judged": "claim", "laws": "law", "faults": "fault", "repeated": "input"}
PARTS = ["verdict", "exit_code", "failed_gate", "gates", "detector", "not_judged", "judged_up_to",
         "tried", "left_out_families", "strata", "laws", "power", "harness_problems", "self_test",
         "corpus", "repeated", "search", "failures"]
# Members that depend on the clock, the machine, the build or the folder.
LEFT_OUT = {"version", "file", "sha256", "replay", "isolation", "taken_from", "by_clock", "seconds",
            "after", "before", "flaky", "not_so_deep", "shrunk", "times_ms", "peak_memory_bytes"}


def kept(value):
    if isinstance(value, dict):
        return {k: kept(v) for k, v in value.items() if k not in LEFT_OUT and not k.endswith(("_us", "_ms"))}
    return [kept(v) for v in value] if isinstance(value, list) else value


def row(*fields):
    *words, value = fields
    return "\t".join([*map(str, words), json.dumps(kept(value), sort_keys=True)])


def run(words, folder, env=None):
    return subprocess.run([str(w) for w in words], cwd=folder, env=env, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)


def plan(whole, name):
    """Returns the plan. Shrinking depends on the clock, so its share of the time is almost 0."""
    part = 1 if whole else 20
    strata = [{"family": f, "cases": n // part, "bound": 0.9} for f, n in STRATA.items()]
    policy = {"power": 0.01, "self_test_queries": 10000 // part,
              "repeated_triangles": 2000 if whole else 300 if name == "late" else 0}
    return {"schema": "assay-campaign/1", "name": "frozen", "strata": strata, "seconds": 100000,
            "fault_cases": 300 // part, "fault_seeds": 1, "search": 10000 // part, "shrink_share": 1e-9,
            "laws_every": 1, "law_premises": 1, "tetrahedron_seconds": 0.0, "policy": policy}


def campaign_rows(build, name, seed, folder, whole, proof=None):
    """Returns the rows of a run. `proof` is the folder of the run of the built-in detector with this seed."""
    folder.mkdir()
    (folder / "plan.json").write_text(json.dumps(plan(whole, name)))
    words = [build / "assay", "run", "--campaign", "plan.json", "--seed", seed, "--out", "run",
             "--jobs", 1, "--case-seconds", 100]
    library, told = SUBJECTS[name]
    env = dict(os.environ, PYTHONPATH=f"{ROOT / 'tests/plugins'}:{build / 'python'}", **told)
    if library:
        words += ["--power", proof, "--detector", library if ":" in library else build / library]
    ended = run(words, folder, env)
    script = "import sys; from assay import _judge; print(_judge.findings(sys.argv[1]))"
    read = run([PYTHON, "-c", script, "run"], folder, env)
    rows = [row(name, seed, "exit code", ended.returncode)]
    try:
        said = json.loads(read.stdout)
    except ValueError:
        return rows + [row(name, seed, "says", ended.stdout.splitlines()[-1:])]
    # `drawn` answers with other intervals each time, so the measures of its trials differ.
    left = {"power"} if library else set()
    left |= {"strata", "tried"} if name == "drawn" else set()
    for part in [p for p in PARTS if p not in left]:
        rows += rows_of([name, seed, part], said.get(part))
    if name == "drawn":
        rows = [re.sub(r"wider than (\S+) in \d+ of", r"wider than \1 in some of", r) for r in rows]
    return rows


def rows_of(words, value):
    """Returns a row for each named item of a list, or for each member of an object, or for the value."""
    if isinstance(value, dict):
        return [r for key, of in value.items() if key not in LEFT_OUT for r in rows_of([*words, key], of)]
    member = LISTS.get(words[-1])
    if isinstance(value, list) and value and member:
        return [row(*words, item[member], item) for item in value]
    return [row(*words, value)]


def checked(build, words, folder, name):
    """Returns the rows of `check` or another verb on one input."""
    report = folder / (re.sub(r"\W", "-", name) + ".json")
    ended = run([build / "assay", *words, "--json", report], folder)
    said = json.loads(report.read_text()) if report.exists() else {}
    said = json.loads(json.dumps(said).replace(f"{folder}/", "").replace(f"{ROOT}/", ""))
    short = {k: v for k, v in said.items() if k != "steps"}
    steps = json.dumps(kept(said.get("steps", [])), sort_keys=True)
    return [row(name, "exit code", ended.returncode), row(name, "report", short),
            row(name, "steps", len(said.get("steps", [])), hashlib.sha256(steps.encode()).hexdigest())]


def input_rows(build, folder):
    """Returns the rows of curated cases, scenes, a log, a table, queries, relations and the self-test."""
    tasks = [(f"case {f.stem}", ["check", f]) for f in sorted((ROOT / "corpus/curated").glob("*.json"))]
    for scene in ("two-spheres", "dented-sphere", "folding-sheet"):
        run([build / "assay", "scene", scene, "--size", 300, "--frames", 4, "--out", scene], folder)
        frames = sorted((folder / scene).glob("*.ply"))
        tasks.append((f"scene {scene}", ["check", *frames]))
        tasks.append((f"within {scene}", ["check", *frames, "--separation", "0.05"]))
        tasks.append((f"rings {scene}", ["check", *frames, "--rings", 2]))
    frames = sorted((folder / "dented-sphere").glob("*.ply"))
    (folder / "table.csv").write_text("step,answer,time\n1,free,\n2,free,\n3,free,\n")
    tasks.append(("table", ["check", *frames, "--answers", "table.csv"]))
    tasks.append(("at rest", ["check", frames[-1]]))
    tasks.append(("bodies", ["check", "--body", frames[0], "--body", frames[-1]]))
    record = ("import sys, assay\nf = assay.read_frames(sys.argv[2:])\n"
              "with assay.Recorder(sys.argv[1], f.triangles, f.positions[0], name='fixed',\n"
              "                    claims=['free-sound']) as log:\n"
              "    for a, b in zip(f.positions, f.positions[1:]): log.step(a, b, answer='free')\n")
    env = dict(os.environ, PYTHONPATH=str(build / "python"))
    run([PYTHON, "-c", record, folder / "steps.log", *frames], folder, env)
    tasks.append(("log", ["check", "steps.log"]))
    (folder / "vertex_face.csv").write_text("".join(
        f"{x},{y},{z},1\n" for end in (1, -1)
        for x, y, z in [(0.25, 0.25, end), (0, 0, 0), (1, 0, 0), (0, 1, 0)]))
    tasks.append(("queries", ["check", "vertex_face.csv"]))
    with ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda task: checked(build, task[1], folder, task[0]), tasks))
    told = run([build / "assay", "self-test", "--queries", 200], folder).stdout
    # The last column of the table is a time.
    tallies = [line.split()[:-1] for line in told.splitlines() if re.search(r" [\d.]+$", line)]
    return [line for part in rows for line in part] + [row("self-test", *of, "") for of in tallies]


def states(rows):
    """Returns which claims are broken, judged or not judged somewhere, and which outcomes occur."""
    found = set()
    for line in rows:
        fields = line.split("\t")
        if len(fields) < 5:
            continue
        if fields[2] == "failures":
            found.add(("broken", json.loads(fields[-1])["claim"]))
        if fields[2] == "judged_up_to":
            found.add(("judged", fields[3]))
        if fields[2] == "not_judged":
            found.add(("not judged", fields[3]))
        if fields[2] == "strata":
            for bound in json.loads(fields[-1])["bounds"]:
                found |= {("outcome", o) for o in ("holds", "defects", "undecided", "errors", "refused")
                          if bound[o]}
    return found


CLAIMS = json.loads((ROOT / "reports/schemas/certificate.schema.json").read_text())["$defs"]["claim"]["enum"]
# No subject causes these: an undecided step, because it takes until a limit of time; and that a claim is
# not judged, except for the five claims below.
NEVER = {("outcome", "undecided")} | {("not judged", claim) for claim in CLAIMS if claim not in (
    "free-sound", "not-late", "first-time", "first-pairs", "all-pairs")}
OUTCOMES = ["holds", "defects", "undecided", "errors", "refused"]


def shortened(line):
    """Returns the row as rows.txt has it, with the digest of a long value."""
    *words, value = line.split("\t")
    is_long = len(value) > 160
    return "\t".join([*words, hashlib.sha256(value.encode()).hexdigest()[:16] if is_long else value])


def compared(rows):
    """Compares rows with rows.txt for the present subjects, prints differences. Returns whether none differs."""
    subject = lambda line: line.split("\t")[0]
    here = {subject(line) for line in rows}
    before = [line for line in (ROOT / "tests/frozen/rows.txt").read_text().splitlines()
              if subject(line) in here]
    after = {shortened(line): line for line in rows}
    gone, new = [line for line in before if line not in after], after.keys() - set(before)
    for line in gone:
        print("-", line)
    for short, line in after.items():
        if short in new:
            print("+", line[:2000])
    return not gone and not new and len(before) == len(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build", nargs="?", default=ROOT / "build/release", type=Path)
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--out", type=Path, help="write all rows here, and compare nothing")
    parser.add_argument("--renew", action="store_true", help="write rows.txt")
    given = parser.parse_args()
    build = given.build.resolve()
    # A detector of others is built only if its library is installed.
    subjects = [name for name, (library, _) in SUBJECTS.items()
                if not library.startswith("peers/") or (build / library).exists()]
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(2) as pool:
        folder = Path(scratch)
        seeds = (1, 2, 3) if given.whole else (1,)

        def task(job):
            name, seed = job
            return campaign_rows(build, name, seed, folder / f"{name} {seed}", given.whole,
                                 folder / f"built-in {seed}/run")

        inputs = pool.submit(input_rows, build, folder)
        first = list(pool.map(task, [("built-in", seed) for seed in seeds]))
        others = list(pool.map(task, [(name, seed) for name in subjects[1:] for seed in seeds]))
        rows = [line for part in [*first, *others, inputs.result()] for line in part]
    text = "\n".join(rows) + "\n"
    wanted = {(state, claim) for state in ("broken", "judged", "not judged") for claim in CLAIMS}
    wanted |= {("outcome", outcome) for outcome in OUTCOMES}
    never = wanted - states(rows)
    is_covered = never == NEVER
    if not is_covered:
        print("never met:", sorted(never - NEVER), "; met, and in NEVER:", sorted(NEVER - never))
    print(len(rows), "rows,", hashlib.sha256(text.encode()).hexdigest())
    if given.out:
        given.out.write_text(text)
        return 0
    if given.renew:
        (ROOT / "tests/frozen/rows.txt").write_text("".join(shortened(line) + "\n" for line in rows))
        return 0
    return 0 if compared(rows) and is_covered else 1


if __name__ == "__main__":
    sys.exit(main())
