#!/usr/bin/env python3
"""Runs, scores, checks and converts sets of Assay vectors: small hard cases of continuous
collision detection with exactly known answers. README.md says what everything means.

  vectors.py run [--set DIR] [--out FILE] [--group G...] [--timeout S] [--restart] -- COMMAND ARGS...
  vectors.py run [...] --detector LIB.so|python:MODULE:CLASS
  vectors.py run [...] --arithmetic WORD
  vectors.py score RESULTS... [--set DIR] [--out FILE.html]
  vectors.py check DIR
  vectors.py to-csv FILE.json OUT.csv [--truth FILE]
  vectors.py from-csv FILE.csv... --out DIR [--features vertex-face|edge-edge] [--truth FILE.json]
  vectors.py flags [--set DIR]

Exit codes of run and score: 0 all answers are right; 1 a miss, a late time or an alarm; 3 none of
these, but some case has no answer. Exit code 2 of every verb: the input is wrong; a line says why.

In Python: vectors.run(answer, set=DIR) asks a function or an object and returns the results.
"""
import argparse
import collections
import hashlib
import json
import math
import os
import queue
import re
import signal
import statistics
import struct
import subprocess
import sys
import threading
import time
import traceback
from fractions import Fraction
from pathlib import Path

SET_SCHEMA, RESULTS_SCHEMA, PROTOCOL = "assay-vectors/1", "assay-results/1", "assay-vectors 1"
RESULTS = ("collision", "free", "acceptable")
NO_ANSWERS = ("crash", "timeout", "error", "undecided")
ANSWERS = ("free", "collision", "share", "unsupported", *NO_ANSWERS)
# The outcome of a case is the first of these that is the outcome of one of its steps.
OUTCOMES = ("miss", "late", "alarm", *NO_ANSWERS, "unsupported", "right")
LONGEST_ANSWER = 1 << 24  # bytes of a line
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")

if hasattr(sys, "set_int_max_str_digits"):
    sys.set_int_max_str_digits(0)  # coefficients of polynomials are long


class Wrong(Exception):
    """Wrong input. The message is one line."""


# --- the set ------------------------------------------------------------------------------------

class Step:
    """A query, or one step of a mesh: its points at t = 0 and t = 1, and the right answer."""

    def __init__(self, t0, t1, truth):
        self.t0, self.t1 = t0, t1
        self.result = truth["result"]
        self.first_time = truth.get("first_time")
        self.pairs = truth.get("pairs")


class Case:
    def __init__(self, group, json_case):
        self.group, self.json = group["group"], json_case
        self.features, self.question = group["features"], group["question"]
        self.id, self.about, self.flags = json_case["id"], json_case["about"], json_case["flags"]
        self.triangles, self.distance = json_case.get("triangles"), json_case.get("distance")
        if self.triangles is None:
            self.steps = [Step(json_case["t0"], json_case["t1"], json_case)]
        else:
            frames = json_case["frames"]
            self.steps = [Step(frames[s["from"]], frames[s["to"]], s) for s in json_case["steps"]]


class VectorSet:
    """A folder with set.json and its groups. The constructor reads and checks all of them."""

    def __init__(self, folder=None, only=None):
        self.folder = Path(folder) if folder else Path(__file__).resolve().parent
        self.info = read_json(self.folder / "set.json")
        check_set(self.info, self.folder / "set.json")
        names = [*(Path(g["file"]).stem for g in self.info["groups"]), *self.info["flags"]]
        for name in sorted({*(only or [])} - {*names}):
            raise Wrong(f"no group or flag is named {name}; the names are: {' '.join(names)}")
        self.groups, self.cases = [], []
        lines, ids = "", set()
        for entry in self.info["groups"]:
            file = self.folder / entry["file"]
            data = read_bytes(file)
            digest = hashlib.sha256(data).hexdigest()
            if digest != entry["sha256"]:
                raise Wrong(f"{file}: changed: its SHA-256 is {digest}, not the one in set.json")
            lines += f"{digest}  {entry['file']}\n"
            group = parse_json(data, file)
            check_group(group, file, self.info, entry)
            for case in group["cases"]:
                want(case["id"] not in ids, file, f"case {case['id']} occurs twice")
                ids.add(case["id"])
            cases = [c for c in group["cases"] if not only or {group["group"], *c["flags"]} & {*only}]
            if cases:
                self.groups.append(group)
                self.cases += [Case(group, case) for case in cases]
        if hashlib.sha256(lines.encode()).hexdigest() != self.info["digest"]:
            raise Wrong(f"{self.folder / 'set.json'}: its digest is not the digest of its groups")
        if len(ids) != self.info["cases"]:
            raise Wrong(f"{self.folder / 'set.json'}: it states {self.info['cases']} cases, "
                        f"but its groups have {len(ids)} cases")

    def label(self):
        return {key: self.info[key] for key in ("version", "profile", "digest")}

    def members(self):
        """Returns the ids of the cases of each flag, and of each group."""
        flags = {flag: [c.id for c in self.cases if flag in c.flags] for flag in self.info["flags"]}
        groups = {g["group"]: [c["id"] for c in g["cases"]] for g in self.groups}
        return flags, groups


def read_bytes(file):
    try:
        return Path(file).read_bytes()
    except OSError as problem:
        raise Wrong(f"{file}: {problem.strerror}") from None


def no_constant(word):
    raise ValueError(f"{word} is no number")


def parse_json(data, file):
    try:
        return json.loads(data, parse_constant=no_constant)
    except (ValueError, RecursionError) as problem:
        raise Wrong(f"{file}: is no JSON: {problem}") from None


def read_json(file):
    return parse_json(read_bytes(file), file)


def is_number(x):
    return isinstance(x, (int, float)) and not isinstance(x, bool) and abs(x) <= sys.float_info.max


def is_count(x, end=math.inf):
    return isinstance(x, int) and not isinstance(x, bool) and 0 <= x < end


def is_list(x, length, good):
    return isinstance(x, list) and (length is None or len(x) == length) and all(map(good, x))


def is_text(x):
    return isinstance(x, str)


def want(holds, place, what):
    if not holds:
        raise Wrong(f"{place}: {what}")


def want_fields(value, fields, place):
    """Demands fields. `fields` maps each name to a test of its value, and to that test in words."""
    want(isinstance(value, dict), place, "is no object")
    for name, (good, words) in fields.items():
        want(name in value, place, f"has no field {name}")
        want(good(value[name]), place, f"field {name} is not {words}")


def one_of(*words):
    return (lambda x: isinstance(x, str) and x in words), "one of " + ", ".join(words)


TEXT = (is_text, "a text")
HEX = (lambda x: is_text(x) and re.fullmatch("[0-9a-f]{64}", x), "64 hexadecimal digits")
COUNT = (is_count, "a whole number >= 0")
SCHEMA = one_of(SET_SCHEMA)
KIND = {"features": one_of("vertex-face", "edge-edge", "mesh"),
        "question": one_of("contact", "distance", "limit"),
        "precision": one_of("double", "float32")}
TRIPLE = (lambda x: is_list(x, 3, is_number))


def check_set(info, file):
    want_fields(info, {
        "schema": SCHEMA, "version": TEXT, "profile": TEXT, "cases": COUNT, "digest": HEX,
        "licence": TEXT, "cite": TEXT,
        "groups": (lambda x: is_list(x, None, lambda g: isinstance(g, dict)), "a list of objects"),
        "flags": (lambda x: isinstance(x, dict), "an object")}, file)
    for group in info["groups"]:
        want_fields(group, {"file": (lambda x: is_text(x) and re.fullmatch(r"[\w.-]+\.json", x),
                                     "the name of a file beside set.json"),
                            "sha256": HEX, "cases": COUNT, **KIND}, f"{file}: groups")
    for name, flag in info["flags"].items():
        want_fields(flag, {"about": TEXT, "wrong": TEXT,
                           "links": (lambda x: is_list(x, None, is_text), "a list of texts")},
                    f"{file}: flag {name}")


def check_group(group, file, info, entry):
    want_fields(group, {"schema": SCHEMA, "version": one_of(info["version"]),
                        "group": one_of(Path(entry["file"]).stem), "licence": TEXT,
                        "cases": (lambda x: is_list(x, entry["cases"], lambda c: isinstance(c, dict)),
                                  f"a list of {entry['cases']} objects"),
                        **{key: one_of(entry[key]) for key in KIND}}, file)
    want((group["question"] != "distance" or group["features"] != "mesh") and
         (group["question"] != "limit" or group["features"] == "mesh"), file,
         'question "limit" is only for meshes, question "distance" only for two features')
    for case in group["cases"]:
        want_fields(case, {"id": (lambda x: is_text(x) and re.fullmatch(r"[\w.:-]+", x),
                                  "a name of letters, digits and . : - _")}, f"{file}: a case")
        check_case(case, group, info["flags"], f"{file}: case {case['id']}")


def check_case(case, group, flags, place):
    fields = {"about": TEXT, "result": one_of(*RESULTS), "source": TEXT,
              "flags": (lambda x: is_list(x, None, is_text), "a list of texts"),
              "hard": (lambda x: isinstance(x, dict) and is_text(x.get("kind")) and
                       is_number(x.get("bits")), "an object with kind and bits")}
    if group["question"] == "distance":
        fields["distance"] = (lambda x: is_number(x) and x >= 0, "a number of at least 0")
    want_fields(case, fields, place)
    for flag in case["flags"]:
        want(flag in flags, place, f"set.json knows no flag {flag}")
    want(is_list(case.get("breaks", []), None, is_text), place, "breaks is not a list of texts")
    want(is_text(case.get("split_of", "")) and ("split_of" not in case or group["features"] != "mesh"),
         place, "split_of is not the id of a query")
    if group["features"] == "mesh":
        check_mesh(case, group, place)
        points = [p for frame in case["frames"] for p in frame]
    else:
        for key in ("t0", "t1"):
            want(is_list(case.get(key), 4, TRIPLE), place, f"{key} is not four points")
        check_truth(case, place)
        points = case["t0"] + case["t1"]
    if group["precision"] == "float32":
        want(all(is_float32(x) for p in points for x in p), place, "a coordinate is no float32")


def check_mesh(case, group, place):
    frames = case.get("frames")
    want(isinstance(frames, list) and frames and isinstance(frames[0], list) and
         is_list(frames, None, lambda f: is_list(f, len(frames[0]), TRIPLE)), place,
         "frames are not lists of equally many points")
    index = (lambda x: is_count(x, len(frames[0])))
    want(case.get("triangles") and is_list(
        case["triangles"], None, lambda t: is_list(t, 3, index) and len(set(t)) == 3), place,
        "a triangle is not three different indices of points")
    steps = case.get("steps")
    want(is_list(steps, 1 if group["question"] == "limit" else None, lambda s: isinstance(s, dict))
         and steps, place, 'steps is not a list of steps (for question "limit": of exactly one step)')
    number = (lambda x: is_count(x, len(frames))), "the number of a frame"
    for i, step in enumerate(steps):
        here = f"{place}: step {i + 1}"
        want_fields(step, {"from": number, "to": number, "result": one_of(*RESULTS)}, here)
        want(isinstance(step.get("commit", True), bool), here, "commit is neither true nor false")
        check_truth(step, here)
        want(group["question"] != "limit" or step.get("first_time") != [0, 0], here,
             'question is "limit", but the step begins in contact')
        triangle = (lambda x: is_count(x, len(case["triangles"])))
        pairs = step.get("pairs", [])
        want(isinstance(pairs, list), here, "pairs is not a list")
        for pair in pairs:
            want(is_list(pair, 4, is_number) and triangle(pair[0]) and triangle(pair[1]) and
                 pair[0] < pair[1] and pair[2] <= pair[3], here,
                 "a pair is not two triangles and two times")
    results = [step["result"] for step in steps]
    want((case["result"] == "free") == all(r == "free" for r in results) and
         (case["result"] != "acceptable" or "acceptable" in results), place,
         "its result does not fit the results of its steps")


def check_truth(truth, place):
    for name in ("first_time", "polynomial"):
        want(isinstance(truth.get(name, []), list), place, f"{name} is not a list")
    time_, polynomial = truth.get("first_time"), truth.get("polynomial")
    if truth["result"] == "free":
        want(time_ is None and polynomial is None, place, "result is free, but first_time or polynomial is set")
    if time_ is not None:
        want(is_list(time_, 2, is_number) and 0 <= time_[0] <= time_[1] <= 1, place,
             "first_time is not [lo, hi] with 0 <= lo <= hi <= 1")
        want(time_[1] == time_[0] or time_[1] == next_double(time_[0]), place,
             "the doubles of first_time are neither equal nor neighbours")
    if polynomial is not None:
        want(is_list(polynomial, None, lambda c: is_text(c) and re.fullmatch(r"-?\d+", c)), place,
             "polynomial is not a list of whole numbers written as texts")


def is_float32(x):
    try:
        return struct.unpack("<f", struct.pack("<f", x))[0] == x
    except OverflowError:
        return False


def next_double(x):
    """Returns the double after x. REQUIRES x >= 0."""
    return struct.unpack("<d", struct.pack("<q", struct.unpack("<q", struct.pack("<d", x))[0] + 1))[0]


# --- polynomials --------------------------------------------------------------------------------

def sign_at(polynomial, t):
    """Returns the sign of a polynomial with whole coefficients at the fraction t."""
    total, power = 0, 1
    for c in reversed(polynomial):
        total, power = total * t.numerator + c * power, power * t.denominator
    return (total > 0) - (total < 0)


def primitive(polynomial):
    """Returns the polynomial without zeros at its end, divided by the common factor."""
    while polynomial and polynomial[-1] == 0:
        polynomial = polynomial[:-1]
    factor = math.gcd(*polynomial)
    return [c // factor for c in polynomial]


def sturm_chain(p):
    """Returns the Sturm chain of p. Its last member is a common divisor of p and its derivative."""
    p = primitive(p)
    chain = [p, primitive([i * c for i, c in enumerate(p)][1:])]
    while chain[-1]:
        chain.append([-c for c in remainder(chain[-2], chain[-1])])
    return chain[:-1]


def remainder(rest, divisor):
    """Returns the remainder of a division, times a number > 0 that makes it whole."""
    while len(rest) >= len(divisor):
        shift, factor = len(rest) - len(divisor), abs(divisor[-1])
        lead = rest[-1] if divisor[-1] > 0 else -rest[-1]
        rest = primitive([factor * c - (lead * divisor[i - shift] if i >= shift else 0)
                          for i, c in enumerate(rest)])
    return rest


def zeros_between(chain, lo, hi):
    """Returns the number of zeros in (lo, hi], by Sturm's theorem. REQUIRES no zero at lo or hi."""
    def changes(t):
        signs = [s for s in (sign_at(q, t) for q in chain) if s != 0]
        return sum(a != b for a, b in zip(signs, signs[1:]))
    return changes(lo) - changes(hi)


def has_zero(coefficients, lo, hi):
    """Returns whether the polynomial has a zero in [lo, hi]. Exact."""
    p = primitive([int(c) for c in coefficients])
    lo, hi = Fraction(lo), Fraction(hi)
    return bool(p) and (0 in (sign_at(p, lo), sign_at(p, hi)) or
                        zeros_between(sturm_chain(p), lo, hi) > 0)


def check(folder):
    """Checks all that can be checked without an oracle. Returns the set."""
    vectors = VectorSet(folder)
    for case in vectors.cases:
        truths = case.json["steps"] if case.triangles is not None else [case.json]
        for truth in truths:
            if "polynomial" in truth and "first_time" in truth:
                want(has_zero(truth["polynomial"], *truth["first_time"]), f"case {case.id}",
                     "its polynomial has no zero in first_time")
    check_halves({case.id: case for case in vectors.cases})
    return vectors


def check_halves(cases):
    """Demands that halves make up a step, and have a contact exactly if the step has a contact."""
    halves = collections.defaultdict(list)
    for case in cases.values():
        if "split_of" in case.json:
            want(case.json["split_of"] in cases, f"case {case.id}",
                 "it is half of a case that is missing")
            halves[case.json["split_of"]].append(case.json)
    for name, case in cases.items():
        whole, both = case.json, halves[name]
        if not both and ("SplitInvariant" not in case.flags or "split_of" in whole):
            continue
        want("SplitInvariant" in case.flags, f"case {name}", "it has halves, but not the flag SplitInvariant")
        want(len(both) == 2, f"case {name}", "it does not have two halves (by their split_of)")
        ways = [[[Fraction(b) - Fraction(a) for a, b in zip(p, q)]
                 for p, q in zip(h["t0"], h["t1"])] for h in both]
        want(ways[0] == ways[1] and both[0]["t0"] == whole["t0"] and
             both[0]["t1"] == both[1]["t0"] and both[1]["t1"] == whole["t1"], f"case {name}",
             "its halves do not make up its step")
        want((whole["result"] == "free") == all(h["result"] == "free" for h in both),
             f"case {name}", "its result differs from the result of its halves")


# --- asking -------------------------------------------------------------------------------------

def number_of(word):
    if not NUMBER.fullmatch(word) or math.isinf(float(word)):
        raise ValueError(word)
    return float(word)


def parse_answer(line, case):
    """Returns the answer in a line of the protocol; "error" if the line is no answer."""
    try:
        words = line.split()
        answer = {"answer": words[0]}
        end = words.index("pairs") if "pairs" in words else len(words)
        numbers = [number_of(w) for w in words[1:end]]
        if (words[0] == "share") != (case.question == "limit") and words[0] not in NO_ANSWERS[2:] + (
                "unsupported",):
            raise ValueError(line)
        if words[0] == "collision" and len(numbers) in (1, 2):
            if numbers[0] > numbers[-1]:
                raise ValueError(line)
            answer["time"] = [numbers[0], numbers[-1]]
        elif words[0] == "share" and len(numbers) == 1 and 0 <= numbers[0] <= 1:
            answer["share"] = numbers[0]
        elif words[0] not in ("free", "collision", "undecided", "error", "unsupported") or numbers:
            raise ValueError(line)
        if end < len(words):
            indices = [int(w) for w in words[end + 1:]]
            pairs = sorted({tuple(sorted(p)) for p in zip(indices[::2], indices[1::2])})
            if (case.triangles is None or words[0] not in ("free", "collision") or
                    len(indices) % 2 or (pairs and words[0] == "free") or
                    not all(0 <= a < b < len(case.triangles) for a, b in pairs)):
                raise ValueError(line)
            answer["pairs"] = [list(p) for p in pairs]
        return answer
    except (ValueError, IndexError):
        return {"answer": "error"}


def decimal(x):
    """Returns the shortest decimal that reads back as the double x."""
    return repr(float(x)).removesuffix(".0")


def numbers_text(points):
    return " ".join(repr(float(x)) for point in points for x in point)


class NoAnswer(Exception):
    """The program crashed, ran out of time, or did not keep to the protocol."""


class Program:
    """A program that speaks the line protocol. It starts again after a case without an answer."""

    def __init__(self, command, seconds, restarts):
        self.command, self.seconds, self.restarts = command, seconds, restarts
        self.process = None
        words = self.start().split(maxsplit=2) + ["", "", ""]
        if not words[1]:
            self.stop()
            raise Wrong(f"{command[0]}: its first line is not: NAME VERSION SETTINGS")
        self.product = {"name": words[0], "version": words[1], "settings": words[2].strip()}

    def start(self):
        try:
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE,
                                            stdout=subprocess.PIPE, start_new_session=True)
        except OSError as problem:
            raise Wrong(f"{self.command[0]}: cannot be started: {problem.strerror}") from None
        self.requests, self.lines = queue.Queue(), queue.Queue()
        for work in (self.write, self.read):
            threading.Thread(target=work, args=(self.process, self.requests, self.lines),
                             daemon=True).start()
        try:
            return self.ask(PROTOCOL, 10 * self.seconds)
        except NoAnswer as problem:
            self.stop()
            raise Wrong(f"{self.command[0]}: did not say its name ({problem})") from None

    # write() and read() use the process and the queues of one start, because the threads of a
    # program that does not end go on, and they must not disturb the next process.
    @staticmethod
    def write(process, requests, _):
        try:
            for line in iter(requests.get, None):
                process.stdin.write(line.encode() + b"\n")
                process.stdin.flush()
        except (OSError, ValueError):
            pass
        try:
            process.stdin.close()
        except OSError:
            pass

    @staticmethod
    def read(process, _, lines):
        try:
            for line in iter(lambda: process.stdout.readline(LONGEST_ANSWER), b""):
                if not line.endswith(b"\n"):
                    break  # the line is cut: the program ended, or the line is too long
                lines.put(line.decode("utf-8", "replace"))
        except (OSError, ValueError):
            pass
        lines.put(None)

    def ask(self, request, seconds=None):
        if not self.lines.empty():
            # The program ended, or it wrote a line before it was asked a question.
            raise NoAnswer("crash" if self.lines.get() is None else "error")
        self.requests.put(request)
        try:
            line = self.lines.get(timeout=seconds or self.seconds)
        except queue.Empty:
            raise NoAnswer("timeout") from None
        if line is None:
            raise NoAnswer("crash")
        return line

    def stop(self):
        if not self.process:
            return
        self.requests.put(None)
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except (OSError, AttributeError):
            self.process.kill()
        self.process.wait()
        self.process = None

    def end(self):
        """Lets the program end by itself, and kills it after self.seconds."""
        if self.process:
            self.requests.put(None)
            try:
                self.process.wait(self.seconds)
            except subprocess.TimeoutExpired:
                pass
            self.stop()

    def answers(self, case):
        if not self.process:
            self.start()
        given = []
        try:
            if case.triangles is None:
                words = case.features
                if case.question == "distance":
                    words += f"-within {float(case.distance)!r}"
                step = case.steps[0]
                given = [self.answer(case, words, step)]
            else:
                indices = " ".join(str(i) for t in case.triangles for i in t)
                line = self.ask(f"mesh {len(case.steps[0].t0)} {len(case.triangles)} {indices}")
                word = line.strip()
                if word == "unsupported":
                    return [{"answer": word}] * len(case.steps)
                if word != "ok":
                    raise NoAnswer("error")
                for step in case.steps:
                    given.append(self.answer(
                        case, "limit" if case.question == "limit" else "step", step))
        except NoAnswer as problem:
            self.stop()
            # The steps after this one have no answer either.
            given += [{"answer": str(problem)}] * (len(case.steps) - len(given))
        if self.restarts:
            self.end()
        return given

    def answer(self, case, words, step):
        line = self.ask(f"{words} {numbers_text(step.t0)} {numbers_text(step.t1)}")
        answer = parse_answer(line, case)
        if answer["answer"] == "error" and line.split() != ["error"]:
            raise NoAnswer("error")
        if not self.lines.empty() and self.lines.queue[0] is not None:
            raise NoAnswer("error")
        return answer


class Functions:
    """A Python function or object that answers the questions of a set."""

    METHODS = {("vertex-face", "contact"): "vertex_face", ("edge-edge", "contact"): "edge_edge",
               ("vertex-face", "distance"): "vertex_face_within",
               ("edge-edge", "distance"): "edge_edge_within",
               ("mesh", "contact"): "step", ("mesh", "limit"): "limit"}

    def __init__(self, answer):
        self.answer = answer
        name = str(getattr(answer, "name", getattr(answer, "__name__", type(answer).__name__)))
        self.product = {"name": name, "version": str(getattr(answer, "version", "0")),
                        "settings": str(getattr(answer, "settings", ""))}

    def end(self):
        pass

    def answers(self, case):
        return [self.ask(case, step) for step in case.steps]

    def ask(self, case, step):
        method = getattr(self.answer, self.METHODS[case.features, case.question], None)
        arguments = [step.t0, step.t1]
        if method is None:
            is_plain = callable(self.answer) and case.question == "contact"
            if not is_plain or case.triangles is not None:
                return {"answer": "unsupported"}
            method, arguments = self.answer, [case.features, *arguments]
        elif case.triangles is not None:
            arguments.insert(0, case.triangles)
        elif case.question == "distance":
            arguments.insert(0, case.distance)
        try:
            said = method(*arguments)
            if said is None:
                said = "undecided"
            elif not isinstance(said, str):
                said = (f"share {float(said)!r}" if case.question == "limit"
                        else "collision" if true_or_false(said, case) else "free")
        except NotImplementedError:
            said = "unsupported"
        except Wrong:
            raise
        except Exception as problem:  # whatever a detector throws, the next case is asked
            print(f"{case.id}: {type(problem).__name__}: {problem}", file=sys.stderr)
            said = "error"
        return parse_answer(said, case)


def true_or_false(said, case):
    """Returns a bool of Python or NumPy as bool. Refuses a number, because 0.0 would mean free."""
    is_bool = getattr(getattr(said, "dtype", None), "kind", "") == "b" and not said.shape
    want(isinstance(said, bool) or is_bool, case.id,
         f"{said!r} is no answer; answers are True, False, None and lines such as \"collision 0.25\"")
    return bool(said)


def ask_all(asked, vectors):
    started = time.monotonic()
    answers = {}
    try:
        for case in vectors.cases:
            given = asked.answers(case)
            answers[case.id] = given[0] if case.triangles is None else {"steps": given}
    finally:
        asked.end()
    return {"schema": RESULTS_SCHEMA, "set": vectors.label(), "product": asked.product,
            "seconds": round(time.monotonic() - started, 3), "answers": answers}


def run(answer, set=None, groups=None):
    """Asks a function answer(features, t0, t1), or an object with some of the methods vertex_face,
    edge_edge, vertex_face_within, edge_edge_within, step and limit. Returns results for write_results
    and judge."""
    return ask_all(Functions(answer), VectorSet(set, groups))


def write_results(results, file):
    """Writes results, one case on each line."""
    text = json.dumps({key: item for key, item in results.items() if key != "answers"})[:-1]
    cases = ",\n".join(f"{json.dumps(i)}:{json.dumps(a, separators=(',', ':'))}"
                       for i, a in results["answers"].items())
    cases = re.sub(r"\.0(?=[],}])", "", cases)
    write_text(file, f'{text}, "answers": {{\n{cases}\n}}}}\n')


def write_text(file, text, mode="w"):
    try:
        with open(file, mode, encoding="utf-8", newline="\n") as out:
            out.write(text)
    except OSError as problem:
        raise Wrong(f"{file}: {problem.strerror}") from None


# --- judging ------------------------------------------------------------------------------------

class Judged:
    """The outcomes of a product's answers, and numbers that sum them up."""

    def __init__(self, product):
        self.product = product
        self.outcome = {}  # by id
        self.missed = {}  # by id of a missed case: its first missed step, and the answer to it
        self.closed = self.open = self.missing = self.spurious = 0
        self.met = self.named = 0  # right pairs and answered pairs, of steps whose pairs are judged
        self.times, self.late_by, self.early_by = 0, [], []  # count of first times; parts of a step
        self.gave_pairs = False
        self.uses = []  # the shares of the possible way that a limiter allows
        self.limits = 0  # the limits that have one right answer

    def name(self, *version):
        return ", ".join(filter(None, (self.product["name"], *version, self.product["settings"])))

    def name_and_version(self):
        return self.name(f"version {self.product['version']}")

    def ids(self, *outcomes):
        return [i for i, outcome in self.outcome.items() if outcome in outcomes]

    def step(self, question, step, answer):
        word = answer["answer"]
        if word not in ("free", "collision", "share"):
            return word
        if question == "limit":
            return self.limit(step, answer["share"])
        if step.result == "acceptable":
            self.closed += word == "collision"
            self.open += word == "free"
        elif word != step.result:
            return "miss" if word == "free" else "alarm"
        if "pairs" in answer and step.pairs is not None and step.result != "acceptable":
            self.gave_pairs = True
            right = {(a, b) for a, b, *_ in step.pairs}
            given = {tuple(p) for p in answer["pairs"]}
            self.missing += len(right - given)
            self.spurious += len(given - right)
            self.met, self.named = self.met + len(right), self.named + len(given)
        if word == "collision" and "time" in answer and step.first_time:
            self.times += 1
            if answer["time"][0] > step.first_time[1]:
                self.late_by.append(answer["time"][0] - step.first_time[1])
                return "late"
            if answer["time"][1] < step.first_time[0]:
                self.early_by.append(step.first_time[0] - answer["time"][1])
        return "right"

    def limit(self, step, share):
        self.limits += step.result != "acceptable"
        if not step.first_time:
            self.uses.append(share)
            return "right"
        lo, hi = step.first_time
        is_safe = share < lo or (share == lo and lo != hi)
        if step.result == "acceptable":
            self.closed += is_safe
            self.open += not is_safe
        elif not is_safe:
            return "miss"
        elif lo > 0:
            self.uses.append(share / lo)
        return "right"


def judge(results, vectors):
    judged = Judged(results["product"])
    for case in vectors.cases:
        if case.id not in results["answers"]:
            continue
        answer = results["answers"][case.id]
        answers = answer["steps"] if case.triangles is not None else [answer]
        outcomes = [judged.step(case.question, s, a) for s, a in zip(case.steps, answers)]
        judged.outcome[case.id] = next(o for o in OUTCOMES if o in outcomes)
        if "miss" in outcomes:
            judged.missed[case.id] = (outcomes.index("miss"), answers[outcomes.index("miss")])
    return judged


def read_results(file, vectors):
    results = read_json(file)
    want_fields(results, {"schema": one_of(RESULTS_SCHEMA),
                          "answers": (lambda x: isinstance(x, dict), "an object")}, file)
    want_fields(results.get("set"), {"version": TEXT, "profile": TEXT, "digest": TEXT},
                f"{file}: set")
    want_fields(results.get("product"), {"name": TEXT, "version": TEXT, "settings": TEXT},
                f"{file}: product")
    given, own = results["set"], vectors.label()
    want(given["digest"] == own["digest"], file,
         f"results of another set ({given['version']} {given['profile']}, digest "
         f"{given['digest'][:12]}); the set to score is {own['version']} {own['profile']}, digest "
         f"{own['digest'][:12]}")
    cases = {case.id: case for case in vectors.cases}
    for name, answer in results["answers"].items():
        place = f"{file}: {name}"
        want(name in cases, place, "the set has no such case")
        case = cases[name]
        want(isinstance(answer, dict), place, "is no object")
        if case.triangles is not None:
            want(is_list(answer.get("steps"), len(case.steps), lambda a: isinstance(a, dict)), place,
                 f"its steps are not a list of {len(case.steps)} objects")
        for one in answer["steps"] if case.triangles is not None else [answer]:
            check_answer(one, case, place)
    return results


def check_answer(answer, case, place):
    want_fields(answer, {"answer": one_of(*ANSWERS)}, place)
    if answer["answer"] in ("free", "collision", "share"):
        want((answer["answer"] == "share") == (case.question == "limit"), place,
             f'"{answer["answer"]}" is no answer to the question "{case.question}"')
    if answer["answer"] == "share":
        want(is_number(answer.get("share")) and 0 <= answer["share"] <= 1, place,
             "share is not a number from 0 to 1")
    if "time" in answer:
        want(is_list(answer["time"], 2, is_number) and answer["time"][0] <= answer["time"][1], place,
             "time is not [lo, hi] with lo <= hi")
    if "pairs" in answer:
        end = len(case.triangles or [])
        want(is_list(answer["pairs"], None, lambda p: is_list(p, 2, lambda i: is_count(i, end))),
             place, "a pair is not two indices of triangles")


def letter_of(i):
    """Returns A, B, ... Z, A2, B2, ... for i = 0, 1, ..."""
    return chr(ord("A") + i % 26) + (str(i // 26 + 1) if i >= 26 else "")


def table_text(rows, left):
    """Returns a table as text. The first `left` columns are aligned to the left."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ("  ".join(c.ljust(w) if i < left else c.rjust(w)
                       for i, (c, w) in enumerate(zip(row, widths))) for row in rows)
    return "".join(line.rstrip() + "\n" for line in lines)


def uses_text(judged):
    return (f"{len(judged.uses)} of {judged.limits} are safe; their median is "
            f"{100 * statistics.median(judged.uses):.1f} % of the safe way")


def matrix_rows(title, members, every, brief):
    """Returns a row for each name: misses/cases of each product, for the ids of the name."""
    rows = [[title] + [letter_of(i) for i in range(len(every))]]
    for name, ids in members.items():
        counts = []
        for judged in every:
            asked = [judged.outcome[i] for i in ids
                     if judged.outcome.get(i, "unsupported") != "unsupported"]
            counts.append((asked.count("miss"), len(asked)))
        if any(n for _, n in counts) and (not brief or any(m for m, _ in counts)):
            rows.append([name] + [f"{m}/{n}" if n else "-" for m, n in counts])
    return rows


def score_text(vectors, every, brief=False):
    info = vectors.info
    text = (f"set {info['version']} ({info['profile']}), {info['cases']} cases, digest "
            f"{info['digest'][:12]}\n\n")
    rows = [["", "product", "cases", "misses", "late", "alarms", "undecided", "error", "crash",
             "timeout", "unsupported"]]
    for i, judged in enumerate(every):
        counts = collections.Counter(judged.outcome.values())
        cases = len(judged.outcome) - counts["unsupported"]
        rows.append([letter_of(i), judged.name_and_version(), str(cases)] + [
            str(counts[o]) for o in ("miss", "late", "alarm", "undecided", "error", "crash",
                                     "timeout", "unsupported")])
    text += table_text(rows, 2)
    flags, groups = vectors.members()
    for title, members in (("misses/cases by flag", flags), ("misses/cases by group", groups)):
        rows = matrix_rows(title, members, every, brief)
        if len(rows) > 1:
            text += "\n" + table_text(rows, 1)
    lines = []
    for i, judged in enumerate(every):
        letter = letter_of(i)
        for outcome, words in (("miss", "misses"), ("late", "late"), ("alarm", "alarms"),
                               ("undecided", "undecided"), ("error", "error"), ("crash", "crash"),
                               ("timeout", "timeout")):
            ids = judged.ids(outcome)
            if ids:
                more = f" and {len(ids) - 8} more cases" if len(ids) > 8 else ""
                lines.append(f"{letter} {words}: {' '.join(ids[:8])}{more}\n")
        if judged.closed or judged.open:
            lines.append(f"{letter} where features only touch: {judged.closed} answers "
                         f"are collision, {judged.open} answers are free\n")
        if judged.early_by:
            lines.append(f"{letter} answers whose time is too early: {len(judged.early_by)}\n")
        if judged.gave_pairs:
            lines.append(f"{letter} pairs: {judged.missing} missing, {judged.spurious} spurious\n")
        if judged.uses:
            lines.append(f"{letter} limits: {uses_text(judged)}\n")
    return text + ("\n" + "".join(lines) if lines else "")


def exit_code(every):
    if any(judged.ids("miss", "late", "alarm") for judged in every):
        return 1
    is_silent = [set(judged.outcome.values()) <= {"unsupported"} for judged in every]
    return 3 if any(is_silent) or any(judged.ids(*NO_ANSWERS) for judged in every) else 0


# --- query files --------------------------------------------------------------------------------

def features_of(path):
    name = path.name[:-3] if path.name.endswith(".gz") else path.name
    stem = Path(name).stem
    for word, end in (("vertex-face", "vf"), ("edge-edge", "ee")):
        if stem.endswith(end) or stem.startswith(word):
            return word
    for folder in path.absolute().parent.parts[::-1]:
        if folder in ("vertex-face", "edge-edge"):
            return folder
    raise Wrong(f"{path}: are its queries vertex-face or edge-edge? Give --features")


def double_of(words, place):
    try:
        if len(words) == 1:
            return number_of(words[0])
        exact = Fraction(*map(int, words))
        x = exact.numerator / exact.denominator
    except (ValueError, ZeroDivisionError, OverflowError):
        raise Wrong(f"{place}: {'/'.join(words)} is no double") from None
    want(Fraction(x) == exact, place, f"{'/'.join(words)} is no double")
    return x


def read_csv(file, truth):
    """Returns queries as (t0, t1, label, distance)."""
    data = read_bytes(file)
    if data[:2] == b"\x1f\x8b":
        import gzip
        try:
            data = gzip.decompress(data)
        except (OSError, EOFError) as problem:
            raise Wrong(f"{file}: {problem}") from None
    lines = data.decode("utf-8", "replace").rstrip("\r\n").split("\n")
    want(len(lines) % 8 == 0, file, f"{len(lines)} rows are not a multiple of 8")
    labels = read_json(truth) if truth else None
    if truth:
        want(is_list(labels, len(lines) // 8, lambda x: isinstance(x, bool)), truth,
             f"is not a list of {len(lines) // 8} booleans")
    queries = []
    for first in range(0, len(lines), 8):
        points, ends = [], set()
        for i in range(first, first + 8):
            place, columns = f"{file}: line {i + 1}", [c.strip() for c in lines[i].split(",")]
            want(3 <= len(columns) <= 8, place, f"{len(columns)} columns; a row has 3 to 8 columns")
            each = 1 if len(columns) < 6 else 2  # a decimal, or numerator and denominator
            points.append([double_of(columns[k:k + each], place) for k in range(0, 3 * each, each)])
            ends.add(tuple(columns[3 * each:]))
        place = f"{file}: line {first + 1}"
        want(len(ends) == 1, place, "the eight rows of this query differ in label or separation")
        end = ends.pop()
        label = labels[first // 8] if labels else {"1": True, "0": False}.get((*end, "")[0])
        want(label is not None, place, "this query has no label, but must have one: give --truth")
        distance = None
        if len(end) == 2:
            want(bool(NUMBER.fullmatch(end[1])) and 0 <= float(end[1]) < math.inf, place,
                 "the separation is no finite number >= 0")
            distance = float(end[1])
        queries.append((points[:4], points[4:], label, distance))
    return queries


def from_csv(files, out, features, truth):
    want(not truth or len(files) == 1, truth, "--truth needs exactly one query file")
    files = [Path(f) for f in files]
    common = Path(os.path.commonpath([f.absolute().parent for f in files]))
    groups = []
    for file in files:
        kind = features or features_of(file)
        queries = read_csv(file, truth)
        questions = {distance is not None for *_, distance in queries}
        want(len(questions) == 1, file, "some queries have a separation and others have none")
        path = file.absolute().relative_to(common)
        name = re.sub(r"[^\w.-]", "_", "-".join((*path.parent.parts, path.name.split(".")[0])))
        group = {"schema": SET_SCHEMA, "version": "0", "group": name,
                 "features": kind,
                 "question": "distance" if questions.pop() else "contact",
                 "precision": "double", "licence": "that of the queries"}
        cases = [{"id": f"{name}-{i + 1}", "about": f"Query {i + 1} of {path}.",
                  "result": "collision" if label else "free", "t0": t0, "t1": t1, "flags": [],
                  "hard": {"kind": "unknown", "bits": 0}, "source": str(path),
                  **({} if distance is None else {"distance": distance})}
                 for i, (t0, t1, label, distance) in enumerate(queries)]
        groups.append((group, cases))
    write_set(out, {"schema": SET_SCHEMA, "version": "0", "profile": "converted", "cases": 0,
                    "digest": "", "licence": "that of the queries", "cite": "", "groups": [],
                    "flags": {}}, groups)


def write_set(out, info, groups):
    """Writes groups with their cases, and a set.json that also lists the groups of `info`."""
    out = Path(out)
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise Wrong(f"{out}: {problem.strerror}") from None
    entries = {entry["file"]: entry for entry in info["groups"]}
    texts = {}
    for group, cases in groups:
        lines = ",\n".join(map(json.dumps, cases))
        text = f'{json.dumps(group)[:-1]}, "cases": [\n{lines}\n]}}\n'
        name = f"{group['group']}.json"
        want(name not in texts and name != "set.json", out / name,
             "two groups have this name, or the name is set.json")
        texts[name] = text
        entries[name] = {"file": name, "sha256": hashlib.sha256(text.encode()).hexdigest(),
                         "cases": len(cases), **{key: group[key] for key in KIND}}
        check_group({**group, "cases": cases}, out / name, info, entries[name])
    digests = "".join(f"{entry['sha256']}  {name}\n" for name, entry in entries.items())
    info = {**info, "groups": list(entries.values()),
            "cases": sum(entry["cases"] for entry in entries.values()),
            "digest": hashlib.sha256(digests.encode()).hexdigest()}
    # Checks before it writes, so that a wrong set does not replace a good one.
    check_set(info, out / "set.json")
    for name, text in texts.items():
        write_text(out / name, text)
    write_text(out / "set.json", json.dumps(info, indent=1) + "\n")
    check(out)
    print(f"{out}: {info['cases']} cases in {len(entries)} groups")


def to_csv(group_file, out, truth):
    """Writes queries with labels in the rows, or in the file `truth`. `acceptable` has label 1."""
    group = read_json(group_file)
    want_fields(group, {"schema": SCHEMA, **KIND, "cases": (lambda x: is_list(
        x, None, lambda c: isinstance(c, dict)), "a list of objects")}, group_file)
    want(group["features"] != "mesh", group_file, "has meshes, which no query file can hold")
    text, labels = "", []
    for case in group["cases"]:
        want_fields(case, {"result": one_of(*RESULTS)}, group_file)
        for key in ("t0", "t1"):
            want(is_list(case.get(key), 4, TRIPLE), group_file, f"a {key} is not four points")
        labels.append(case["result"] != "free")
        end = [] if truth else [str(int(labels[-1]))]
        if group["question"] == "distance":
            end = (end or [""]) + [decimal(case["distance"])]
        for point in case["t0"] + case["t1"]:
            ratios = [str(n) for x in point for n in float(x).as_integer_ratio()]
            text += ",".join(ratios + end) + "\n"
    write_text(out, text)
    if truth:
        write_text(truth, json.dumps(labels, separators=(",", ":")) + "\n")


# --- the flags ----------------------------------------------------------------------------------

def flags_text(vectors):
    counts = collections.Counter(flag for case in vectors.cases for flag in case.flags)
    text = "| flag | cases | why it is hard | what goes wrong | links |\n|---|---|---|---|---|\n"
    for name, flag in vectors.info["flags"].items():
        links = ", ".join(f"[{i + 1}]({link})" for i, link in enumerate(flag["links"]))
        text += f"| {name} | {counts[name]} | {flag['about']} | {flag['wrong']} | {links} |\n"
    return text


# --- the command line ---------------------------------------------------------------------------

class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Wrong(f"{message} (--help lists verbs and options)")


def parser_of_all():
    parser = Parser(prog="vectors.py", description=__doc__, add_help=True,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True, parser_class=Parser)
    one = verbs.add_parser("run", help="ask a program or a detector all questions of a set")
    one.add_argument("--set", metavar="DIR", help="the set (default: this program's folder)")
    one.add_argument("--out", metavar="FILE", default="results.json", help="default: results.json")
    one.add_argument("--group", nargs="+", metavar="G", help="ask only cases of these groups or flags")
    one.add_argument("--timeout", type=float, default=10, metavar="S",
                     help="seconds for an answer (default: 10)")
    one.add_argument("--restart", action="store_true", help="start the program again for each case")
    one.add_argument("--detector", metavar="NAME",
                     help="ask a plug-in of Assay, or a Python class: python:MODULE:CLASS")
    one.add_argument("--arithmetic", metavar="WORD",
                     help="arithmetic of the built-in detector: exact, bounded, double or float")
    one = verbs.add_parser("score", help="compare results with the exact answers")
    one.add_argument("results", nargs="+")
    one.add_argument("--set", metavar="DIR")
    one.add_argument("--out", metavar="FILE.html", help="write the page of results to this file")
    one = verbs.add_parser("check", help="check that a set is whole and sound")
    one.add_argument("set", metavar="DIR")
    one = verbs.add_parser("to-csv", help="write a group as a query file")
    one.add_argument("group", metavar="GROUP.json")
    one.add_argument("out", metavar="OUT.csv")
    one.add_argument("--truth", metavar="FILE", help="write the labels to FILE, not into the rows")
    one = verbs.add_parser("from-csv", help="make a set from query files")
    one.add_argument("files", nargs="+", metavar="FILE.csv")
    one.add_argument("--out", required=True, metavar="DIR")
    one.add_argument("--features", choices=("vertex-face", "edge-edge"))
    one.add_argument("--truth", metavar="FILE", help="a JSON list with a boolean for each query")
    one = verbs.add_parser("flags", help="print the flags as a table")
    one.add_argument("--set", metavar="DIR")
    return parser


def asked_by(given, command):
    """Returns the object that answers: a Program, or a detector of Assay."""
    ways = [way for way in (command, given.detector, given.arithmetic) if way]
    want(len(ways) == 1, "run", "who answers? Give one of -- COMMAND ARGS..., --detector, --arithmetic")
    want(0 < given.timeout < math.inf, "--timeout", "the seconds must be a number above 0")
    write_text(given.out, "", "a")  # whether it can be written: no work is to be lost
    if command:
        return Program(command, given.timeout, given.restart)
    import hosted
    hosted.demand_module()
    words = hosted.assay.OPTIONS["arithmetic"]
    want(given.detector or given.arithmetic in words, "--arithmetic", f"is not one of {', '.join(words)}")
    return (hosted.PlugIn(given.detector, given.timeout) if given.detector
            else hosted.BuiltIn(given.arithmetic))


def main(words):
    sys.modules.setdefault("vectors", sys.modules[__name__])  # for what is imported beside it
    command = []
    if words[:1] == ["run"] and "--" in words:
        at = words.index("--")
        words, command = words[:at], words[at + 1:]
    given = parser_of_all().parse_args(words)
    if given.verb == "run":
        vectors = VectorSet(given.set, given.group)
        results = ask_all(asked_by(given, command), vectors)
        write_results(results, given.out)
        judged = [judge(results, vectors)]
        print(score_text(vectors, judged, brief=True), end="")
        print(f"written: {given.out}")
        return exit_code(judged)
    if given.verb == "score":
        vectors = VectorSet(given.set)
        judged = [judge(read_results(file, vectors), vectors) for file in given.results]
        if given.out:
            import matrix
            write_text(given.out, matrix.page(vectors, judged))
        print(score_text(vectors, judged), end="")
        return exit_code(judged)
    if given.verb == "check":
        vectors = check(given.set)
        print(f"{given.set}: is sound; {len(vectors.cases)} cases in {len(vectors.groups)} groups, "
              f"digest {vectors.info['digest']}")
    elif given.verb == "to-csv":
        to_csv(given.group, given.out, given.truth)
    elif given.verb == "from-csv":
        from_csv(given.files, given.out, given.features, given.truth)
    else:
        print(flags_text(VectorSet(given.set)), end="")
    return 0


def end_with(work):
    """Ends the process with the exit code that work(words of the command line) returns."""
    try:
        sys.exit(work(sys.argv[1:]))
    except Wrong as wrong:
        print(f"{Path(sys.argv[0]).name}: " + " ".join(str(wrong).split()), file=sys.stderr)
        sys.exit(2)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception:  # a fault of this script, which must not be taken for a miss
        traceback.print_exc()
        sys.exit(4)


if __name__ == "__main__":
    end_with(main)
