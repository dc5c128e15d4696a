"""Keeps outcomes of runs, so that an ended run continues, and a new test runs on survivors only."""
import hashlib
import json
import threading
from pathlib import Path


def digest_of(program, arguments):
    """Returns the digest of a judge: of its program, with the detector in it, and of the files that it reads."""
    sha = hashlib.sha256(Path(program).read_bytes())
    for argument in arguments:
        sha.update(Path(argument).read_bytes() if Path(argument).is_file() else argument.encode())
    return sha.hexdigest()


class Remembered:
    def __init__(self, path, digests):
        """`digests` has the digest of each judge, in the order of the judges."""
        self.path, self.digests, self.known = Path(path), digests, {}
        self.lock = threading.Lock()
        lines = self.path.read_text().splitlines() if self.path.exists() else []
        self.passed = {}  # by survivor: the judges, unchanged since then, that it survived
        self.seconds = {}  # by judge: its time for the unchanged detector
        for entry in map(json.loads, lines):
            if "judge" in entry:
                if digests.get(entry["judge"]) == entry["digest"]:
                    self.seconds[entry["judge"]] = entry["seconds"]
                continue
            key = tuple(entry["key"])
            if self._holds(entry):
                self.known[key] = entry["outcome"]
            if entry["outcome"][0] == "survives":
                self.passed[key] = {judge for judge, digest in entry["digests"].items()
                                    if digests.get(judge) == digest}

    def _holds(self, entry):
        outcome, killer, _ = entry["outcome"]
        first = next(iter(self.digests))
        judges = self.digests if outcome == "survives" else [killer or first]
        return all(judge in self.digests and entry["digests"].get(judge) == self.digests[judge]
                   for judge in judges)

    @staticmethod
    def _key(mutant):
        return (*mutant.key(), mutant.number)

    def outcome(self, mutant):
        return self.known.get(self._key(mutant))

    def judges_passed(self, mutant):
        return self.passed.get(self._key(mutant), set())

    def add_judge(self, judge, seconds):
        self._write({"judge": judge, "digest": self.digests[judge], "seconds": seconds})

    def add(self, mutant, outcome):
        self._write({"key": self._key(mutant), "outcome": outcome, "digests": self.digests})

    def _write(self, entry):
        with self.lock, self.path.open("a") as out:
            out.write(json.dumps(entry) + "\n")
