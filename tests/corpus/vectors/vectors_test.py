"""Tests vectors.py and the programs of corpus/vectors, on a small hand-made set and on the committed set."""
import copy
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOM = HERE.parents[2] / "corpus" / "vectors"
MINI = HERE / "mini_set"
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOM))
import vectors


def run(*words, **options):
    done = subprocess.run([sys.executable, ROOM / "vectors.py", *map(str, words)], text=True,
                          capture_output=True, timeout=120, check=False, **options)
    return done.returncode, done.stdout, done.stderr


class InScratch(unittest.TestCase):
    def setUp(self):
        self.scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch, ignore_errors=True)

    def ask(self, *command, options=()):
        """Runs a program on the mini set. Returns its exit code, results and summary."""
        out = self.scratch / "results.json"
        code, text, errors = run("run", "--set", MINI, "--out", out, *options, "--", *command)
        self.assertEqual(errors, "")
        return code, json.loads(out.read_text()), text

    def refused(self, words, *line):
        code, text, errors = run(*words)
        self.assertEqual((code, text, errors.count("\n")), (2, "", 1), errors)
        for part in line:
            self.assertIn(part, errors)


def right_answers():
    """Returns results with the right answer to each case of the mini set."""
    results = vectors.run(lambda features, t0, t1: True, set=MINI)
    for case in vectors.VectorSet(MINI).cases:
        steps = []
        for step in case.steps:
            answer = {"answer": "free" if step.result == "free" else "collision"}
            if case.question == "limit":
                answer = {"answer": "share", "share": 0.25}
            elif step.first_time:
                answer["time"] = list(step.first_time)
            if step.pairs and case.question != "limit":
                answer["pairs"] = [[a, b] for a, b, *_ in step.pairs]
            steps.append(answer)
        results["answers"][case.id] = steps[0] if case.triangles is None else {"steps": steps}
    return results


class Judging(unittest.TestCase):
    def setUp(self):
        self.set = vectors.VectorSet(MINI)
        self.results = right_answers()

    def outcome(self, name, answer, step=None):
        if step is None:
            self.results["answers"][name] = answer
        else:
            self.results["answers"][name]["steps"][step] = answer
        judged = vectors.judge(self.results, self.set)
        return judged.outcome[name], judged

    def test_right_answers_are_right(self):
        judged = vectors.judge(self.results, self.set)
        self.assertEqual(set(judged.outcome.values()), {"right"})
        self.assertEqual((judged.closed, judged.open, len(judged.early_by), judged.missing, judged.spurious),
                         (1, 0, 0, 0, 0))
        self.assertEqual(judged.uses, [0.5])
        self.assertEqual(vectors.exit_code([judged]), 0)

    def test_free_where_there_is_contact_is_a_miss(self):
        outcome, judged = self.outcome("vf-d-0001", {"answer": "free"})
        self.assertEqual((outcome, vectors.exit_code([judged])), ("miss", 1))

    def test_contact_where_there_is_none_is_an_alarm(self):
        outcome, judged = self.outcome("vf-d-0003", {"answer": "collision", "time": [0.9, 0.9]})
        self.assertEqual((outcome, vectors.exit_code([judged])), ("alarm", 1))

    def test_a_touch_may_be_called_free(self):
        outcome, judged = self.outcome("ee-d-0002", {"answer": "free"})
        self.assertEqual((outcome, judged.closed, judged.open), ("right", 0, 1))

    def test_times(self):
        lo, hi = next(c for c in self.set.cases if c.id == "vf-d-0002").steps[0].first_time
        self.assertLess(lo, hi)
        late = vectors.next_double(hi)
        for time, wanted, early in (([lo, hi], "right", 0), ([hi, hi], "right", 0),
                                    ([late, late], "late", 0), ([hi, late], "right", 0),
                                    ([0, 0.25], "right", 1), ([0, lo], "right", 0)):
            outcome, judged = self.outcome("vf-d-0002", {"answer": "collision", "time": time})
            self.assertEqual((outcome, len(judged.early_by)), (wanted, early), time)

    def test_no_answers(self):
        for word in ("undecided", "error", "crash", "timeout"):
            outcome, judged = self.outcome("vf-d-0001", {"answer": word})
            self.assertEqual((outcome, vectors.exit_code([judged])), (word, 3))
        outcome, judged = self.outcome("vf-d-0001", {"answer": "unsupported"})
        self.assertEqual((outcome, vectors.exit_code([judged])), ("unsupported", 0))

    def test_a_case_is_as_bad_as_its_worst_step(self):
        for word, wanted in (("undecided", "undecided"), ("free", "miss")):
            outcome, _ = self.outcome("st-d-0001", {"answer": word}, step=1)
            self.assertEqual(outcome, wanted)
        outcome, _ = self.outcome("st-d-0001", {"answer": "collision"}, step=0)
        self.assertEqual(outcome, "miss", "worse than an alarm")

    def test_pairs(self):
        for pairs, missing in (([], 1), ([[0, 1]], 0)):
            outcome, judged = self.outcome("st-d-0001", {"answer": "collision", "pairs": pairs}, 1)
            self.assertEqual((outcome, judged.missing, judged.spurious), ("right", missing, 0))

    def test_shares(self):
        for share, wanted in ((0.0, "right"), (0.49, "right"), (0.5, "miss"), (1.0, "miss")):
            outcome, _ = self.outcome("lm-d-0001", {"answer": "share", "share": share}, 0)
            self.assertEqual(outcome, wanted, share)
        step = vectors.Step([], [], {"result": "collision", "first_time": [0.25, 0.5]})
        judged = vectors.Judged({})
        self.assertEqual([judged.limit(step, s) for s in (0.25, 0.375)], ["right", "miss"],
                         "between two doubles the lesser one is safe")
        step = vectors.Step([], [], {"result": "free"})
        self.assertEqual((judged.limit(step, 1.0), judged.uses[-1]), ("right", 1.0))


class Polynomials(unittest.TestCase):
    def test_zeros_in_an_interval(self):
        for polynomial, lo, hi, wanted in (
                (["-1", "3"], 0.3333333333333333, 0.33333333333333337, True),
                (["-1", "3"], 0.33333333333333337, 0.3333333333333334, False),
                (["1", "-4", "4"], 0.5, 0.5, True),     # a double zero
                (["1", "-4", "4"], 0.25, 0.75, True),
                (["1", "0", "1"], 0.0, 1.0, False),
                (["-1", "0", "0", "8"], 0.25, 0.75, True),
                (["-1", "0", "0", "8"], 0.6, 0.75, False),
                (["1"], 0.0, 1.0, False), (["0", "0"], 0.0, 1.0, False)):
            self.assertEqual(vectors.has_zero(polynomial, lo, hi), wanted, polynomial)


class Protocol(InScratch):
    """Programs that keep the line protocol, and programs that violate it."""

    def hostile(self, *words, options=("--timeout", "0.5")):
        return self.ask(sys.executable, HERE / "hostile.py", *words, options=options)

    def words(self, results):
        return {name: answer["answer"] if "answer" in answer else
                [step["answer"] for step in answer["steps"]]
                for name, answer in results["answers"].items()}

    def test_it_dies(self):
        code, results, text = self.hostile("dies", 2)
        words = self.words(results)
        self.assertEqual(code, 1)
        self.assertEqual([words[f"vf-d-000{i}"] for i in (1, 2, 3, 4)],
                         ["free", "free", "crash", "free"], "started anew after its death")
        self.assertEqual(results["product"], {"name": "hostile", "version": "1", "settings": "dies"})
        self.assertIn("A crash: vf-d-0003 ee-d-0002", text)

    def test_it_hangs(self):
        _, results, text = self.hostile("hangs", 3)
        self.assertEqual(self.words(results)["vf-d-0004"], "timeout")
        self.assertEqual(self.words(results)["ee-d-0001"], "free")
        self.assertIn("A timeout: vf-d-0004", text)

    def test_it_says_nothing_or_not_a_line(self):
        for how in ("silent", "endless"):
            _, results, _ = self.hostile(how, options=("--timeout", "0.3", "--group",
                                                       "vertex-face-distance-float32"))
            wanted = {"silent": ("timeout",), "endless": ("timeout", "crash")}[how]
            for word in self.words(results).values():
                self.assertIn(word, wanted, how)

    def test_it_prints_garbage(self):
        for how in ("garbage", "wrong-time", "share 0.5", "collision 1 0", "free pairs 0 1",
                    "collision pairs 0 1", "collision 1_0", "", "free 0.5"):
            code, results, _ = self.hostile(how, options=("--group", "vertex-face-double"))
            self.assertEqual(code, 3, how)
            self.assertEqual(set(self.words(results).values()), {"error"}, how)
        _, results, _ = self.hostile("garbage", options=("--group", "steps-double", "limits-double"))
        self.assertEqual(self.words(results), {"st-d-0001": ["error"] * 3, "lm-d-0001": ["error"]})

    def test_it_speaks_unasked(self):
        _, results, _ = self.hostile("chatty", options=("--group", "vertex-face-double"))
        for word in self.words(results).values():
            self.assertIn(word, ("error", "free"))
        self.assertIn("error", self.words(results).values())

    def test_its_child_lives_on(self):
        code, results, _ = self.hostile("orphan", options=("--timeout", "1", "--group",
                                                           "vertex-face-double"))
        self.assertEqual(code, 3)
        for word in self.words(results).values():
            self.assertIn(word, ("timeout", "crash"))

    def test_it_never_says_its_name(self):
        out = self.scratch / "out.json"
        for how, line in (("mute", "did not say its name (crash)"), ("deaf", "(timeout)"),
                          ("nameless", "NAME VERSION SETTINGS")):
            self.refused(["run", "--set", MINI, "--out", out, "--timeout", "0.1", "--",
                          sys.executable, HERE / "hostile.py", how], line)
        self.refused(["run", "--set", MINI, "--out", out, "--", self.scratch / "none"],
                     "cannot be started")

    def test_a_mesh_is_taken_or_not(self):
        mesh = self.scratch / "mesh.py"
        mesh.write_text("""import sys
print("mesh 1" if input() else "", flush=True)
for line in sys.stdin:
    words = line.split()
    if words[0] == "mesh":
        n, m = int(words[1]), int(words[2])
        print("ok" if len(words) == 3 + 3 * m else "wrong", flush=True)
    elif words[0] == "step":
        z = [float(x) for x in words[3::3]]
        print("collision 0.5 pairs 1 0" if min(z[n:]) < 0 else "free pairs", flush=True)
    elif words[0] == "limit":
        print("share 0.4375", flush=True)
    else:
        print("unsupported", flush=True)
""")
        for options in ((), ("--restart",)):
            code, results, text = self.ask(sys.executable, mesh, options=options)
            self.assertEqual(results["answers"]["st-d-0001"]["steps"],
                             [{"answer": "free", "pairs": []},
                              {"answer": "collision", "time": [0.5, 0.5], "pairs": [[0, 1]]},
                              {"answer": "free", "pairs": []}])
            self.assertEqual(code, 0, text)
            self.assertIn("A limits: 1 of 1 are safe; their median is 87.5 % of the safe way", text)
            self.assertIn("A pairs: 0 missing, 0 spurious", text)


class AsAModule(InScratch):
    def test_an_object_answers_what_it_can(self):
        class Mine:
            name, version, settings = "mine", "2", "all free"

            def vertex_face(self, t0, t1):
                return None if t0[0][2] == 3.0 else False

            def edge_edge(self, t0, t1):
                raise ValueError("cannot")

            def vertex_face_within(self, distance, t0, t1):
                return f"collision {distance}"

            def limit(self, triangles, t0, t1):
                return 0.25 if len(triangles) == 2 else 1

        stderr, sys.stderr = sys.stderr, open(os.devnull, "w")
        self.addCleanup(setattr, sys, "stderr", stderr)
        self.addCleanup(sys.stderr.close)
        results = vectors.run(Mine(), set=MINI)
        answers = results["answers"]
        self.assertEqual(results["product"], {"name": "mine", "version": "2", "settings": "all free"})
        self.assertEqual(answers["vf-d-0001"], {"answer": "undecided"})
        self.assertEqual(answers["vf-d-0002"], {"answer": "free"})
        self.assertEqual(answers["ee-d-0001"], {"answer": "error"})
        self.assertEqual(answers["vd-f-0001"], {"answer": "collision", "time": [0.25, 0.25]})
        self.assertEqual(answers["st-d-0001"], {"steps": [{"answer": "unsupported"}] * 3})
        self.assertEqual(answers["lm-d-0001"], {"steps": [{"answer": "share", "share": 0.25}]})
        file = self.scratch / "results.json"
        vectors.write_results(results, file)
        self.assertEqual(vectors.read_results(file, vectors.VectorSet(MINI)), results)

    def test_a_time_in_place_of_true_or_false_is_refused(self):
        for said in (0.0, 0.5, (0.25, 0.5), {"first": 0.5}):
            with self.assertRaisesRegex(vectors.Wrong, "is no answer; answers are True, False, None and lines"):
                vectors.run(lambda *_: said, set=MINI)

    def test_a_function_is_asked_contacts(self):
        asked = []
        results = vectors.run(lambda *arguments: asked.append(arguments[0]), set=MINI,
                              groups=["edge-edge-double", "limits-double"])
        self.assertEqual(asked, ["edge-edge"] * 3)
        self.assertEqual(len(results["answers"]), 4)


class Examples(InScratch):
    def test_each_is_short(self):
        for name in ("plain.c", "textbook_cubic.py", "ipc_toolkit.py"):
            self.assertLessEqual(len((ROOM / "examples" / name).read_text().splitlines()), 60, name)

    def test_the_textbook_misses_what_stays_in_a_plane(self):
        plain = self.scratch / "plain"
        subprocess.run([*(os.environ.get("CC") or "cc").split(), "-std=c99", "-O1", "-Wall", "-Wextra",
                        "-Wpedantic", "-Werror", ROOM / "examples" / "plain.c", "-o", plain, "-lm"],
                       check=True)
        for command in ([plain], [sys.executable, ROOM / "examples" / "textbook_cubic.py"]):
            code, results, text = self.ask(*command)
            self.assertEqual(code, 1, text)
            self.assertIn("A misses: ee-d-0003\n", text)
            self.assertEqual(results["answers"]["vf-d-0003"], {"answer": "free"})
            self.assertEqual(results["answers"]["vd-f-0001"], {"answer": "unsupported"})
            self.assertEqual(results["answers"]["st-d-0001"]["steps"], [{"answer": "unsupported"}] * 3)

    def test_the_ipc_toolkit_by_its_interface(self):
        """Uses a module with the functions of the Python module of the IPC Toolkit."""
        example = ROOM / "examples" / "ipc_toolkit.py"
        done = subprocess.run([sys.executable, "-S", example, MINI], cwd=self.scratch, text=True,
                              capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        (self.scratch / "numpy.py").write_text(
            "int32 = 'int32'\ndef array(x, dtype=None):\n    return list(x)\n")
        (self.scratch / "ipctk.py").write_text("""
class TightInclusionCCD:
    def point_triangle_ccd(self, p_t0, t0_t0, t1_t0, t2_t0, p_t1, t0_t1, t1_t1, t2_t1,
                           min_distance=0.0, tmax=1.0):
        return p_t0[2] > min_distance >= p_t1[2], 0.25
    def edge_edge_ccd(self, ea0_t0, ea1_t0, eb0_t0, eb1_t0, ea0_t1, ea1_t1, eb0_t1, eb1_t1,
                      min_distance=0.0, tmax=1.0):
        return True, 0.0
def edges(faces):
    return faces
class CollisionMesh:
    def __init__(self, rest_positions, edges, faces):
        pass
def is_step_collision_free(mesh, vertices_t0, vertices_t1):
    return min(x[2] for x in vertices_t1) >= 0
def compute_collision_free_stepsize(mesh, vertices_t0, vertices_t1):
    return 0.5
""")
        done = subprocess.run([sys.executable, example, MINI], cwd=self.scratch, text=True,
                              capture_output=True, check=False,
                              env={**os.environ, "PYTHONPATH": str(self.scratch)})
        self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout)
        answers = json.loads((self.scratch / "results_ipctk.json").read_text())["answers"]
        self.assertEqual(answers["vd-f-0002"], {"answer": "collision", "time": [0.25, 0.25]})
        self.assertEqual(answers["vd-f-0001"], {"answer": "free"})
        self.assertEqual(answers["st-d-0001"]["steps"][1], {"answer": "collision"})
        self.assertIn("A misses: lm-d-0001\n", done.stdout)


class Page(InScratch):
    """The matrix page of `score --out`."""

    def page(self, *products):
        """Makes the page of products. Each product is a name, and the answers in which it is wrong."""
        files = []
        for name, changes in products:
            results = right_answers()
            results["product"] = {"name": name, "version": "1", "settings": "s"}
            results["answers"].update(changes)
            files.append(self.scratch / f"{len(files)}.json")
            vectors.write_results(results, files[-1])
        out = self.scratch / "page.html"
        code, _, errors = run("score", *files, "--set", MINI, "--out", out)
        self.assertEqual(errors, "")
        return code, out.read_text()

    def test_it_shows_misses_by_flags_and_nothing_from_elsewhere(self):
        bad = {"ee-d-0003": {"answer": "free"}, "ee-d-0002": {"answer": "free"},
               "vf-d-0003": {"answer": "collision"}, "vf-d-0001": {"answer": "undecided"},
               "vf-d-0004": {"answer": "collision", "time": [1, 1]},
               "lm-d-0001": {"steps": [{"answer": "share", "share": 0.5}]}}
        code, text = self.page(("bad", bad), ("good", {}))
        self.assertEqual(code, 1)
        for part in (
                '<tr><th scope="row">CoplanarThroughout<br><small>The four points lie in one plane during '
                'the whole step. Pitfall: The cubic is zero, and a solver that divides by it answers free. '
                '<code>--group CoplanarThroughout</code></small></th><td class="bad" data-of="A" '
                'title="1 miss"><b>&#x2717; 1/1</b></td><td class="good" data-of="B" title="1 right">'
                '<b>&#x2713; 0/1</b></td></tr>', "<small>1 alarm",
                "1 unanswered</small>", "<h3>A bad, version 1, s: 2 misses</h3>",
                "<h3>B good, version 1, s: no miss</h3>", "<code>ee-d-0003</code> Two edges slide "
                "along one line, in one plane throughout, and meet half way.<br><small>first contact "
                "at t = 0.5; answered free. CoplanarThroughout, ParallelEdges</small>",
                "answered share 0.5", "<p>Alarms (1): <code>vf-d-0003</code></p>",
                "<p>Unanswered: undecided (1): <code>vf-d-0001</code></p>", "<p>Late times (1, by ",
                "<li>A bad, s: 0 called contact, 1 free</li>", "prefers-color-scheme: dark"):
            self.assertIn(part, text)
        for part in ("<script", "http:", "https:", "url(", "src=", "href="):
            self.assertNotIn(part, text)

    def test_what_a_product_calls_itself_stays_text(self):
        code, text = self.page(('<script>alert("1")</script>&', {}))
        self.assertEqual(code, 0)
        self.assertNotIn("<script", text)
        self.assertIn("&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;&amp;", text)


class Committed(unittest.TestCase):
    """The set, the results and the page that are committed beside vectors.py."""

    def setUp(self):
        self.set = vectors.VectorSet()
        self.results = [vectors.read_results(file, self.set)
                        for file in sorted((ROOM / "results").glob("*.json"))]

    def test_the_page_is_that_of_the_results(self):
        import matrix
        every = [vectors.judge(results, self.set) for results in self.results]
        self.assertEqual(len(every), 23)
        self.assertEqual(matrix.page(self.set, every), (ROOM / "matrix.html").read_text())

    def test_the_rationals_are_those_of_the_groups(self):
        self.assertEqual(len(list((ROOM / "csv").glob("*/*.csv"))), 12)
        with tempfile.TemporaryDirectory() as scratch:
            back = Path(scratch) / "back.csv"
            for file in (ROOM / "csv").glob("*/*.csv"):
                vectors.to_csv(ROOM / f"{file.parent.name}-{file.stem}.json", back, None)
                self.assertEqual(back.read_bytes(), file.read_bytes(), file)

    def test_halves_are_those_of_a_step(self):
        whole = next(c for c in self.set.cases if "SplitInvariant" in c.flags)
        halves = [c for c in self.set.cases if c.json.get("split_of") == whole.id]
        opposite = "free" if whole.json["result"] != "free" else "collision"
        for change, line in (
                (lambda w, a, b: None, None),
                (lambda w, a, b: b.pop("split_of"), "it does not have two halves"),
                (lambda w, a, b: (a.pop("split_of"), b.pop("split_of")), "it does not have two halves"),
                (lambda w, a, b: a.update(t0=b["t0"]), "its halves do not make up"),
                (lambda w, a, b: a.update(split_of="nothing"), "half of a case that is missing"),
                (lambda w, a, b: w.update(result=opposite), "its result differs from the result of its halves")):
            cases = [copy.deepcopy(case) for case in (whole, *halves)]
            change(*(case.json for case in cases))
            by_id = {case.id: case for case in cases}
            if line is None:
                vectors.check_halves(by_id)
                continue
            with self.assertRaisesRegex(vectors.Wrong, line):
                vectors.check_halves(by_id)

    def test_who_broke_on_a_case_answers_it_wrongly(self):
        """Touching counts: closed sets are claimed. Nine cases of Bullet's have no float velocities."""
        broken = [(results, case) for results in self.results for case in self.set.cases
                  if results["product"]["name"] in case.json.get("breaks", ())]
        left_out = 0
        for results, case in broken:
            name, answers = results["product"]["name"], results["answers"][case.id]
            given = answers["steps"] if case.triangles is not None else [answers]
            is_left_out = name[:6] == "Bullet" and given[0]["answer"] == "unsupported"
            left_out += is_left_out
            self.assertTrue(is_left_out or any(map(self.is_wrong, given, case.steps)), (name, case.id))
        self.assertEqual(left_out, 9)
        self.assertEqual(len(broken), sum(len(case.json.get("breaks", ())) for case in self.set.cases))

    @staticmethod
    def is_wrong(answer, step):
        if step.result == "free" or answer["answer"] != "collision":
            return answer["answer"] == ("collision" if step.result == "free" else "free")
        return ("time" in answer and answer["time"][0] > step.first_time[1]) or (
            "pairs" in answer and step.pairs is not None and
            sorted(map(tuple, answer["pairs"])) != [tuple(p[:2]) for p in step.pairs])


class Checking(InScratch):
    def changed(self, change, group="vertex-face-double", seal=True):
        """Returns a set in which `change` has changed a group. `seal`: its digests are made right."""
        folder = self.scratch / "changed"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(MINI, folder)
        file = folder / f"{group}.json"
        content = json.loads(file.read_text())
        change(content)
        file.write_text(json.dumps(content))
        if seal:
            info = json.loads((folder / "set.json").read_text())
            lines = ""
            for entry in info["groups"]:
                data = (folder / entry["file"]).read_bytes()
                entry["sha256"] = vectors.hashlib.sha256(data).hexdigest()
                entry["cases"] = len(json.loads(data)["cases"])
                lines += f"{entry['sha256']}  {entry['file']}\n"
            info["digest"] = vectors.hashlib.sha256(lines.encode()).hexdigest()
            (folder / "set.json").write_text(json.dumps(info))
        return folder

    def test_the_mini_set_holds(self):
        code, text, _ = run("check", MINI)
        self.assertEqual(code, 0)
        self.assertIn("11 cases in 5 groups", text)

    def test_the_committed_set_holds(self):
        code, text, errors = run("check", ROOM)
        self.assertEqual(code, 0, errors)
        self.assertIn("is sound", text)

    def test_flags_are_a_table(self):
        code, text, _ = run("flags", "--set", MINI)
        self.assertEqual(code, 0)
        self.assertEqual(text.count("| DoubleRoot | 1 |"), 1)

    def test_what_is_wrong_is_said(self):
        first = (lambda group: group["cases"][0])

        def change(key, value):
            return lambda group: first(group).update({key: value})
        for wrong, line in (
                (change("first_time", [0.5, 0.75]), "neither equal nor neighbours"),
                (change("first_time", [0.75, 0.75]), "its polynomial has no zero in first_time"),
                (change("first_time", [2.0, 2.0]), "first_time is not [lo, hi] with 0 <= lo <="),
                (change("result", "maybe"), "result is not one of"),
                (change("result", "free"), "result is free, but first_time or polynomial is"),
                (change("flags", ["Unheard"]), "set.json knows no flag Unheard"),
                (change("id", "vf-d-0002"), "case vf-d-0002 occurs twice"),
                (change("id", "a b"), "id is not a name"),
                (change("t0", [[0, 0, 0]] * 3), "t0 is not four points"),
                (change("polynomial", ["0.5"]), "polynomial is not a list of whole numbers"),
                (lambda group: first(group).pop("about"), "no field about"),
                (lambda group: group.update(precision="float32"), "precision is not one of double"),
                (lambda group: group["cases"].pop(), "it states 11 cases, but its groups have 10 cases")):
            self.refused(["check", self.changed(wrong)], line)
        self.refused(["check", self.changed(lambda group: first(group)["t1"][0].__setitem__(0, 0.1),
                                            "vertex-face-distance-float32")], "no float")
        self.refused(["check", self.changed(
            lambda group: first(group)["steps"][1].update(pairs=[[0, 2, 0.5, 0.5]]),
            "steps-double")], "a pair is not two triangles")
        self.refused(["check", self.changed(change("about", "x"), seal=False)], "changed: ")
        self.refused(["check", self.scratch / "none"], "set.json: No such file")

    def test_text_that_is_no_json(self):
        folder = self.changed(lambda group: None)
        (folder / "set.json").write_text("[" * 100000)
        self.refused(["check", folder], "no JSON")
        (folder / "set.json").write_text('{"schema": NaN}')
        self.refused(["check", folder], "no JSON")

    def test_results_of_another_set_are_refused(self):
        file = self.scratch / "results.json"
        results = right_answers()
        vectors.write_results(results, file)
        self.assertEqual(run("score", file, "--set", MINI)[0], 0)
        other = self.changed(lambda group: group["cases"][0].update(about="Another."))
        self.refused(["score", file, "--set", other], "results of another set")
        for name, answer, line in (("vf-d-9999", {"answer": "free"}, "no such case"),
                                   ("vf-d-0001", {"answer": "share", "share": 0.5}, "no answer to the question"),
                                   ("vf-d-0001", {"answer": "perhaps"}, "answer is not one of"),
                                   ("vf-d-0001", {"answer": "collision", "time": [1, 0]}, "time is"),
                                   ("st-d-0001", {"steps": [{"answer": "free"}]}, "not a list of 3 objects"),
                                   ("lm-d-0001", {"steps": [{"answer": "share", "share": 2}]},
                                    "share is not a number")):
            vectors.write_results({**results, "answers": {name: answer}}, file)
            self.refused(["score", file, "--set", MINI], line)

    def test_words_of_the_command_line(self):
        for words in ([], ["run"], ["run", "--set", MINI], ["run", "--group", "none", "--set", MINI,
                                                            "--", "true"],
                      ["run", "--timeout", "-1", "--set", MINI, "--", "true"], ["jump"],
                      ["score", "--set", MINI, self.scratch / "none"],
                      ["run", "--set", MINI, "--out", self.scratch, "--", "true"]):
            self.refused(words)


class Csv(InScratch):
    def test_there_and_back(self):
        """Tests doubles of every kind, and labels in the rows or in a separate file."""
        rows = ("0,1,1,2,-3,4,{l}\n"
                f"1,{2 ** 1074},{(2 ** 53 - 1) * 2 ** 971},1,-6004799503160661,18014398509481984,{{l}}\n")
        text = "".join(rows.replace("{l}", label) * 4 for label in "10")
        file = self.scratch / "mine" / "vertex-face" / "data.csv"
        file.parent.mkdir(parents=True)
        file.write_text(text)
        out, back = self.scratch / "set", self.scratch / "back.csv"
        self.assertEqual(run("from-csv", file, "--out", out)[0], 0)
        self.assertEqual(run("check", out)[0], 0)
        self.assertEqual(run("to-csv", out / "data.json", back)[0], 0)
        self.assertEqual(back.read_text(), text)
        cases = json.loads((out / "data.json").read_text())["cases"]
        self.assertEqual([c["result"] for c in cases], ["collision", "free"])
        self.assertEqual(cases[0]["t0"][1], [5e-324, sys.float_info.max, -0.3333333333333333])
        decimals = self.scratch / "decimals-vf.csv"
        decimals.write_text("".join(f".1,-2e-1,{k},1\n" for k in range(8)))
        self.assertEqual(run("from-csv", decimals, "--out", self.scratch / "s3")[0], 0)
        taken = json.loads((self.scratch / "s3" / "decimals-vf.json").read_text())["cases"]
        self.assertEqual(taken[0]["t1"][1], [0.1, -0.2, 5])

        truth = self.scratch / "truth.json"
        self.assertEqual(run("to-csv", out / "data.json", back, "--truth", truth)[0], 0)
        self.assertEqual(truth.read_text(), "[true,false]\n")
        bare = self.scratch / "3036vf.csv"
        shutil.copy(back, bare)
        self.assertEqual(run("from-csv", bare, "--truth", truth, "--out", self.scratch / "s2")[0], 0)
        again = json.loads((self.scratch / "s2" / "3036vf.json").read_text())["cases"]
        self.assertEqual([(c["t0"], c["t1"], c["result"]) for c in again],
                         [(c["t0"], c["t1"], c["result"]) for c in cases])

    def test_distances(self):
        out, back = self.scratch / "distance-vf.csv", self.scratch / "back"
        group = MINI / "vertex-face-distance-float32.json"
        self.assertEqual(run("to-csv", group, out)[0], 0)
        self.assertTrue(out.read_text().startswith("1,1,1,1,3,1,0,0.25\n"))
        self.assertEqual(run("from-csv", out, "--out", back)[0], 0)
        given = json.loads(group.read_text())["cases"]
        taken = json.loads((back / "distance-vf.json").read_text())["cases"]
        for a, b in zip(given, taken):
            for key in ("t0", "t1", "result", "distance"):
                self.assertEqual(a[key], b[key])

    def test_what_no_double_is(self):
        for row, line in (("1,3,0,1,0,1,1", "1/3 is no double"), ("1,0,0,1,0,1,1", "1/0 is no"),
                          ("x,1,0,1,0,1,1", "x/1 is no"), ("1,1,0,1,0,1", "no label"),
                          ("1,1", "2 columns"), ("1,1e999,0", "1e999 is no double"),
                          ("1,1,0,1,0,1,1,-1", "no finite number"),
                          (f"{2 ** 1025},1,0,1,0,1,1", "is no double")):
            file = self.scratch / "a-vf.csv"
            file.write_text((row + "\n") * 8)
            self.refused(["from-csv", file, "--out", self.scratch / "set"], "line 1", line)
        file.write_text("1,1,0,1,0,1,1\n" * 9)
        self.refused(["from-csv", file, "--out", self.scratch / "set"], "multiple of 8")
        file.write_text("1,1,0,1,0,1,1\n" * 7 + "1,1,0,1,0,1,0\n")
        self.refused(["from-csv", file, "--out", self.scratch / "set"], "differ in label")
        shutil.copy(file, self.scratch / "odd.csv")
        self.refused(["from-csv", self.scratch / "odd.csv", "--out", self.scratch / "s"],
                     "vertex-face or edge-edge?")
        self.refused(["to-csv", MINI / "steps-double.json", self.scratch / "a.csv"], "meshes")


class PublicCsv(InScratch):
    @unittest.skipUnless(os.environ.get("ASSAY_DATA"), "ASSAY_DATA names no folder")
    def test_public_sets_come_back_as_they_were(self):
        data = Path(os.environ["ASSAY_DATA"])
        files = sorted((data / "sample-queries").glob("*/*/*.csv"))
        if not files:
            self.skipTest(f"{data}/sample-queries is not there")
        out, back = self.scratch / "set", self.scratch / "back.csv"
        self.assertEqual(run("from-csv", *files, "--out", out)[0], 0)
        groups = [g["file"] for g in json.loads((out / "set.json").read_text())["groups"]]
        self.assertEqual(len(groups), len(files))
        for file, group in zip(files, groups):
            vectors.to_csv(out / group, back, None)
            self.assertEqual(back.read_bytes(), file.read_bytes(), file)
        rod = data / "scalable-ccd" / "rod-twist"
        for kind in ("vf", "ee") if rod.exists() else ():
            csv, truth = rod / f"queries/3036{kind}.csv", rod / f"mma_bool/3036{kind}_mma_bool.json"
            out = self.scratch / kind
            self.assertEqual(run("from-csv", csv, "--truth", truth, "--out", out)[0], 0)
            vectors.to_csv(out / f"3036{kind}.json", back, self.scratch / "truth.json")
            self.assertEqual(back.read_bytes(), csv.read_bytes() + b"\n", "but for the last newline")
            self.assertEqual(json.loads((self.scratch / "truth.json").read_text()),
                             json.loads(truth.read_text()))


if __name__ == "__main__":
    unittest.main()
