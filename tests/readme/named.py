"""Checks a command that is not run: files, options and targets that it names must exist."""
import re
import shlex

SECONDS = 60
ROOMS = {"detector", "oracle", "corpus", "properties", "reports", "tests"}
PLACEHOLDER = re.compile(r"\[-|[a-z]\|[a-z]|(?<!\w)[A-Z]{2,}(?![\w=])")


def is_synopsis(command):
    """Returns whether the command has places to fill in, as `assay report DIR... --out FILE` has."""
    return PLACEHOLDER.search(command) is not None


def wrong_names(command, clone, build):
    """Returns one line for each wrong name in a command."""
    words = shlex.split(command)
    while "=" in words[0]:
        words.pop(0)
    # A file of the sources, as tests/mutation/smoke.json is, and not a file that the command writes.
    missing = [f"there is no {word}" for word in words
               if "/" in word and word.split("/")[0] in ROOMS and not (clone.place / word).exists()]
    if missing:
        return missing
    if words[0] == "ctest":
        code, printed = clone.run(command + " -N", SECONDS)
        met = re.search(r"Total Tests: [1-9]", printed)
        return [] if code == 0 and met else [f"ctest finds no test: {printed[-200:]}"]
    if words[:2] == ["cmake", "--build"]:
        return [wrong for target in words[words.index("--target") + 1:]
                for wrong in no_target(target, clone, build)]
    if words[0] == "ninja":
        return [wrong for target in words[3:] for wrong in no_target(target, clone, build)]
    return not_in_help(words, clone)


def no_target(target, clone, build):
    code, _ = clone.run(f"ninja -C {shlex.quote(str(build))} -t query {target}", SECONDS)
    return [] if code == 0 else [f"no target {target}"]


def not_in_help(words, clone):
    # The program is python3 SCRIPT, assay VERB, or a script.
    program = words[:2] if words[0] == "python3" or words[0].endswith("assay") else words[:1]
    code, help_text = clone.run(shlex.join([*program, "--help"]), SECONDS)
    if code != 0:
        return [f"{' '.join(program)} --help ends with {code}"]
    text = " ".join(words[len(program):])
    options = re.findall(r"--[a-z][-a-z]*", text)
    # assay bench --suite peers|sequences
    choices = [c for group in re.findall(r"[a-z][-a-z]*(?:\|[a-z][-a-z]*)+", text)
               for c in group.split("|")]
    return [f"{' '.join(program)} knows no {name}" for name in options + choices
            if not re.search(rf"(?<![-\w]){name}(?![-\w])", help_text)]
