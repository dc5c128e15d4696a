"""Compiles and judges mutants in a copy of the detector; the sources themselves stay untouched.

A mutated object is linked before the build's own library, so that it replaces the object of the library.
"""
import json
import resource
import shlex
import shutil
import subprocess
from pathlib import Path

MEMORY = 4 << 30  # bytes of a judge; a mutant that needs more is killed
PRECOMPILED = ["Eigen/Core", "algorithm", "functional", "memory", "optional", "span", "vector",
               "boost/outcome/basic_result.hpp", "boost/multiprecision/cpp_int.hpp"]
FACTOR, SLACK = 3, 5  # a judge hangs after FACTOR times its usual time, plus SLACK seconds


class Judge:
    """A program that ends with 0 if the detector in it is right."""

    def __init__(self, name, link, arguments):
        self.name, self.link, self.arguments = name, link, arguments
        self.seconds = 0.0  # for the unchanged detector


class Build:
    """What the build tree knows: how files are compiled, which sources include them, how to link."""

    def __init__(self, root, build):
        self.root, self.build = Path(root).resolve(), Path(build).resolve()
        entries = json.loads((self.build / "compile_commands.json").read_text())
        self.commands = {}
        for entry in entries:
            file = Path(entry["file"])
            if file.is_relative_to(self.root / "detector"):
                self.commands[str(file.relative_to(self.root))] = shlex.split(entry["command"])
        self.users = self._users()
        self.precompiled = None

    def _ninja(self, *arguments):
        run = subprocess.run(["ninja", "-C", str(self.build), *arguments], check=True,
                             capture_output=True, text=True)
        return run.stdout

    def _users(self):
        """Returns by file of the detector: the sources of the detector that include it, and the file itself."""
        users = {file: {file} for file in self.commands}
        objects = {self._option(c, "-o"): file for file, c in self.commands.items()}
        source = None
        for line in self._ninja("-t", "deps").splitlines():
            if not line.startswith(" "):
                source = objects.get(line.split(":")[0])
            elif source:
                path = (self.build / line.strip()).resolve()
                if path.is_relative_to(self.root / "detector"):
                    users.setdefault(str(path.relative_to(self.root)), set()).add(source)
        return users

    @staticmethod
    def _option(command, name):
        return command[command.index(name) + 1]

    def precompile(self, folder):
        """Compiles once the headers on which every source spends most time: compiling is half of the work."""
        header = Path(folder).resolve() / "precompiled.h"
        header.write_text("".join(f"#include <{name}>\n" for name in PRECOMPILED))
        source = next(file for file in sorted(self.commands) if "lanes" not in file)
        command = self.compile_command(source, self.root, f"{header}.gch")
        command[-2:] = ["-x", "c++-header", str(header)]
        subprocess.run(command, check=True)
        self.precompiled = header

    def compile_command(self, source, copy, output):
        """Returns the command for a source of the copy in `copy`, with little optimisation and no warnings.

        It checks the bounds of containers, because asan would find a mutant that reads past an end.
        """
        drop_next, out = False, ["-D_GLIBCXX_ASSERTIONS"]
        if self.precompiled and not any(w.startswith("-m") for w in self.commands[source]):
            out += ["-include", str(self.precompiled)]
        for word in self.commands[source]:
            if drop_next:
                drop_next = False
            elif word in ("-MT", "-MF", "-o", "-c"):
                drop_next = True
            elif word.startswith("-O"):
                out.append("-O1")
            elif word != "-MD" and not word.startswith("-W") and not word.endswith("ccache"):
                out.append(word.replace(str(self.root / "detector"), str(copy / "detector")))
        compiler = out.index(next(w for w in out if w.endswith(("c++", "g++"))))
        out.insert(0, out.pop(compiler))
        return [*out, "-w", "-o", str(output), "-c", str(copy / source)]

    def link_command(self, program):
        command = self._ninja("-t", "commands", program).splitlines()[-1]
        # The command is one of several: others are ninja's own, or list the tests after linking.
        steps = " ".join(":" if w == "&&" else shlex.quote(w) for w in shlex.split(command)).split(" : ")
        words = next(words for words in map(shlex.split, steps) if "-o" in words)
        faster = ["-fuse-ld=lld"] if shutil.which("ld.lld") else []
        return [word for word in words if word != ":"] + faster


class Workbench:
    """A copy of the detector, which has one mutant at a time."""

    def __init__(self, build, folder, judges):
        self.build, self.folder, self.judges = build, Path(folder), judges
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(build.root / "detector", self.folder / "detector")
        self.originals = {}

    def _compile(self, sources, prefix):
        objects = []
        for n, source in enumerate(sorted(sources)):
            output = self.folder / f"{prefix}{n}.o"
            command = self.build.compile_command(source, self.folder, output)
            if subprocess.run(command, capture_output=True, check=False,
                              start_new_session=True).returncode != 0:
                return None
            objects.append(output)
        return objects

    def outcome(self, mutant, passed):
        """Returns killed, survives, does not compile, or same code; the killing judge; how. Skips `passed` judges."""
        path = self.folder / mutant.file
        text = path.read_text()
        lines = text.split("\n")
        line = lines[mutant.number - 1]
        lines[mutant.number - 1] = line[:len(line) - len(line.lstrip())] + mutant.mutated
        sources = self.build.users.get(mutant.file, set())
        try:
            path.write_text("\n".join(lines))
            objects = self._compile(sources, "mutant")
        finally:
            path.write_text(text)
        if objects is None:
            return "does not compile", "", ""
        for judge in self.judges:
            how = None if judge.name in passed else self.judged(judge, objects)
            if how:
                return "killed", judge.name, how
            if judge is self.judges[0] and self._is_same_code(mutant.file, objects):
                return "same code", "", ""
        return "survives", "", ""

    def _is_same_code(self, file, objects):
        if file not in self.originals:
            originals = self._compile(self.build.users[file], "original")
            self.originals[file] = [o.read_bytes() for o in originals]
        return [o.read_bytes() for o in objects] == self.originals[file]

    def judged(self, judge, objects):
        """Returns how the judge found the objects to be wrong, or None."""
        program = (self.folder / judge.name.replace(" ", "_")).resolve()
        link = list(judge.link)
        link[link.index("-o") + 1] = str(program)
        link[1:1] = [str(o.resolve()) for o in objects]
        linked = subprocess.run(link, cwd=self.build.build, capture_output=True, text=True,
                                check=False)
        if linked.returncode != 0:
            raise RuntimeError(linked.stderr)
        code, output, _ = run_limited([str(program), *judge.arguments],
                                      FACTOR * judge.seconds + SLACK)
        if code == 0:
            return None
        if code < 0:
            return f"ends with signal {-code}"
        lines = [line for line in output.splitlines() if line.strip()]
        failed = [line for line in lines if "FAILED" in line]
        return (failed or lines or ["fails"])[0 if failed else -1].strip()[:160]


def run_limited(command, seconds):
    """Returns the exit code (negative: a signal), the output and the processor time of a command."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        run = subprocess.run(command, capture_output=True, text=True, errors="replace",
                             check=False, preexec_fn=limit, start_new_session=True,
                             timeout=30 * seconds)
        code, output = run.returncode, run.stdout
    except subprocess.TimeoutExpired:
        code, output = -24, ""  # counts as SIGXCPU: the program waits forever
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return code, output, after.ru_utime - before.ru_utime
