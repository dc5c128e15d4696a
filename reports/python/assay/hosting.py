"""Calls a detector in Python, for the plug-in that serves `--detector python:MODULE:CLASS`.

    class Mine:
        claims = ["free-sound", "total"]                  # words of detector/plugin/README.md
        contract = {"adjacency": "no-shared-vertex"}      # without it, nothing is left out
        def create(self, triangles, positions): ...       # int32 (m, 3), float64 (n, 3): copies
        def evaluate(self, x_t0, x_t1): ...               # float64 (n, 3) each

evaluate() returns None (free) or a result: a dict, or an object with at least one of these members.
Anything else, such as False or a number, is an error:

    answer   "free", "collision", "undecided"; if missing, "collision"
    first    (lo, hi), or one number; if missing, not known
    pairs    (k, 2) triangles; if missing, none
    times    (k, 2) or (k,), the first times of the pairs; if missing, not stated

A result of assay.Detector has these members. A class may also have name, version, commit(self) and

    def candidates(self, x_t0, x_t1): ...                 # (k, 2) pairs: its broad phase
    def limit(self, x_t0, x_t1): ...                      # how far the step may be taken
    @staticmethod
    def query(kind, x_t0, x_t1): ...                      # "vertex-face" or "edge-edge", (4, 3) each
    @staticmethod
    def use_threads(count): ...

limit() returns a share (a number), positions (n, 3), a tuple of both, or an object like
assay.Limit. An exception is an error of the step. create() may raise Refused for a mesh; all
functions except query() may raise BeyondCapacity for a mesh or a step that is too large.
"""

import importlib
import sys
import traceback

import numpy as np

ANSWERS = ("free", "collision", "undecided")
KINDS = ("vertex-face", "edge-edge")


class Refused(Exception):
    """Raised by create() for a mesh that the detector does not take. The message says why."""


class BeyondCapacity(Exception):
    """Raised for a mesh or a step that is too large for the detector: `refused: capacity`."""


class AskedAgain(BaseException):
    """Raised if the imported module itself asks for a judgement: a script without a guard. Its
    class can use only what is defined before that, because the rest of the script does not run."""


_imported = None  # the module that is being imported for its class


def stop_if_imported():
    """Ends the import of a module that judges its own class while it is imported."""
    if _imported is not None:
        raise AskedAgain(sys.modules.get(_imported))


def class_of(module, name):
    """Returns the class. ValueError: the module lacks it, or judges a detector before it."""
    global _imported
    _imported = module
    try:
        found, judges = importlib.import_module(module), False
    except AskedAgain as asked:
        found, judges = asked.args[0], True
    except ModuleNotFoundError as error:
        if not f"{module}.".startswith(f"{error.name}."):
            raise
        raise ValueError(f"no module {error.name}: put its folder on PYTHONPATH") from None
    finally:
        _imported = None
    if not hasattr(found, name):
        late = ": the module judges a detector before it defines this one; judge under if __name__ == '__main__'" if judges else ""
        raise ValueError(f"{module} has no class {name}{late}")
    sys.modules[module] = found
    return getattr(found, name)


class Hosted:
    """The class named "MODULE:CLASS", described by numbers of the plug-in interface.

    `claims`: the words of all claims, in the order of their bits. `members`: the members of a
    contract, each with its words in the order of their numbers; a number has no words.
    """

    def __init__(self, word, claims, members):
        module, _, name = word.partition(":")
        self.kind = class_of(module, name)
        self.name = str(getattr(self.kind, "name", name))
        self.version = str(getattr(self.kind, "version", "0"))
        contract = getattr(self.kind, "contract", {})
        self.claims, self.contract = described(self.kind.claims, contract, claims, members)

    def has(self, part):
        return hasattr(self.kind, part)

    def create(self, triangles, positions):
        detector = self.kind()
        detector.create(triangles, positions)
        return Created(detector)

    def query(self, kind, x_t0, x_t1):
        return parts_of(self.kind.query(KINDS[kind], x_t0, x_t1))

    def use_threads(self, count):
        self.kind.use_threads(count)


def described(claims, contract, claim_words, members):
    """Turns words of claims and of a contract into numbers. ValueError: there is no such word."""
    numbers = dict.fromkeys(members, 0)
    for member, value in contract.items():
        if member not in members:
            raise ValueError(f"contract: {member!r} is not a member of a contract")
        words = members[member]
        numbers[member] = _place(value, words, f"contract: {member}") if words else value
    return sum(1 << _place(claim, claim_words, "claims") for claim in set(claims)), numbers


class Created:
    """A detector of one mesh."""

    def __init__(self, detector):
        self.detector = detector

    def evaluate(self, x_t0, x_t1):
        return parts_of(self.detector.evaluate(x_t0, x_t1))

    def commit(self):
        if hasattr(self.detector, "commit"):
            self.detector.commit()

    def candidates(self, x_t0, x_t1):
        return pairs_of(self.detector.candidates(x_t0, x_t1))

    def limit(self, x_t0, x_t1):
        """Returns the share (-1: not stated) and the positions (empty: not stated)."""
        told = self.detector.limit(x_t0, x_t1)
        if isinstance(told, tuple):
            share, positions = told
        elif np.ndim(told) == 0 and isinstance(told, (int, float, np.number)):
            share, positions = told, None
        elif isinstance(told, np.ndarray):
            share, positions = None, told
        else:
            get = told.get if isinstance(told, dict) else lambda name: getattr(told, name, None)
            share, positions = get("share"), get("positions")
        if positions is None:
            return float(share), np.zeros(0)
        positions = np.asarray(positions, np.float64)
        if positions.shape != np.shape(x_t0):
            raise ValueError(f"positions of shape {positions.shape}: {np.shape(x_t0)} is wanted")
        return -1.0 if share is None else float(share), positions.reshape(-1)


def parts_of(result, answers=ANSWERS):
    """Returns the parts of an answer: its number, lo, hi, pairs, and times or None."""
    if result is None:
        return 0, 0.0, 0.0, pairs_of(None), None
    get = result.get if isinstance(result, dict) else lambda name: getattr(result, name, None)
    told = get("answer")
    is_bare = not isinstance(result, dict) and all(
        get(name) is None for name in ("answer", "first", "pairs", "times")
    )
    if is_bare:  # False, say, or a number
        raise ValueError(f"{result!r} is no answer: return None (free), or an object with answer, first, pairs or times")
    answer = _place("collision" if told is None else told, answers, "answer")
    lo, hi = _interval(get("first")) if answer == 1 else (0.0, 0.0)
    pairs, times = pairs_of(get("pairs")), get("times")
    if times is not None:
        times = np.asarray(times, np.float64)
        times = np.stack([times, times], axis=1) if times.ndim == 1 else times
        if times.shape != pairs.shape:
            raise ValueError(f"times of shape {times.shape} for pairs of shape {pairs.shape}")
        times = np.ascontiguousarray(times)
    return answer, lo, hi, pairs, times


def tell(error):
    """Returns the kind of an exception, and a line about it. Prints the traceback of an error."""
    if isinstance(error, Refused):
        return "refused", str(error)
    if isinstance(error, BeyondCapacity):
        return "beyond capacity", str(error)
    traceback.print_exception(error, file=sys.stderr)
    line = f"{type(error).__name__}: {error}"
    frames = traceback.extract_tb(error.__traceback__)
    if frames and frames[-1].filename == __file__ and isinstance(error, ValueError):
        line = str(error)  # this file demands something of the class that does not hold
    elif frames:
        line += f" ({frames[-1].filename}:{frames[-1].lineno}, in {frames[-1].name})"
    return "error", line


def _place(word, words, what):
    if word not in words:
        raise ValueError(f"{what}: {word!r} is none of {', '.join(words)}")
    return words.index(word)


def _interval(first):
    if first is None:
        return 0.0, 1.0
    lo, hi = first if np.ndim(first) else (first, first)
    return float(lo), float(hi)


def pairs_of(pairs):
    """Returns pairs as int32 (k, 2)."""
    given = np.asarray(() if pairs is None else pairs)
    if not given.size:
        return np.zeros((0, 2), np.int32)
    if given.ndim != 2 or given.shape[1] != 2 or given.dtype.kind not in "iu":
        raise ValueError(f"pairs of shape {given.shape} and dtype {given.dtype}: (k, 2) integers are wanted")
    return int32_of(given, "pairs", 2)


def int32_of(numbers, name, dimensions=1):
    """Returns whole numbers from 0 on as an int32 array. ValueError: other numbers or shapes."""
    given = np.asarray(numbers)
    most, are_whole = np.iinfo(np.int32).max, given.dtype.kind in "iu" and given.ndim == dimensions
    if not are_whole or (given.size and not 0 <= given.min() <= given.max() <= most):
        raise ValueError(f"{name}: whole numbers from 0 to {most} are wanted, {dimensions}-dimensional")
    return np.ascontiguousarray(given, np.int32)
