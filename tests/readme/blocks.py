"""The blocks of a README that may be pasted into a terminal: indented ones and fenced ones.

An indented block is split at its blank lines into chunks, because a README often shows a command, a blank
line and the output of the command. A fenced block is one chunk. Shown output is compared with real output here.
"""
import re
from dataclasses import dataclass, field

COMMENT = re.compile(r"\s+#\s.*$")


@dataclass
class Chunk:
    line: int  # the number of the first line, counted from 1
    lines: list = field(default_factory=list)

    def commands(self):
        """Returns each line without blanks around it and without a comment behind it, and its number."""
        return [(self.line + i, COMMENT.sub("", text.strip()))
                for i, text in enumerate(self.lines) if text.strip()]


def chunks_of(text):
    chunks = []
    in_fence = after_text = goes_on = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            in_fence, after_text, goes_on = not in_fence, False, False
            if in_fence:
                chunks.append(Chunk(number + 1))
        elif in_fence:
            chunks[-1].lines.append(line)
        # An indented line directly below a line of text continues a paragraph or an entry of a list.
        elif line.startswith("    ") and line.strip() and not after_text:
            if not goes_on:
                chunks.append(Chunk(number))
            chunks[-1].lines.append(line)
            goes_on = True
        else:
            after_text, goes_on = bool(line.strip()), False
    return chunks


def without_times(text):
    if text.split(maxsplit=1)[:1] == ["ms:"]:
        return "ms:"
    text = re.sub(r"\bin \S+ s\b", "in N s", text.strip())
    # The last column in the row of a stratum is a speed.
    text = re.sub(r"(\d\.\d\de-\d\d +\S+) +\d+$", r"\1", text)
    return " ".join(text.split())


def not_printed(chunks, entry, printed):
    """Returns the lines, with their numbers, that a page shows as output and that were not printed. Looks only at
    chunks in which a line begins with the entry."""
    there = {without_times(text) for text in printed.splitlines()}
    return [(line, text)
            for chunk in chunks if any(text.startswith(entry) for _, text in chunk.commands())
            for line, text in chunk.commands()
            if text != "..." and without_times(text) not in there]
