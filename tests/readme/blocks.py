"""The blocks of a README that may be pasted into a terminal: indented ones and fenced ones.

An indented block is split at its blank lines into chunks, for a README often shows a command, a blank
line and what the command prints. A fenced block is one chunk. What a page shows as printed is compared here, too.
"""
import re
from dataclasses import dataclass, field

COMMENT = re.compile(r"\s+#\s.*$")


@dataclass
class Chunk:
    line: int  # its first, counted from 1
    lines: list = field(default_factory=list)

    def commands(self):
        """Where each line stands, and the line without blanks around and a comment behind it."""
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
        # Right below a line of text an indented line continues a paragraph or an entry of a list.
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
    # The last column of a stratum is a speed.
    text = re.sub(r"(\d\.\d\de-\d\d +\S+) +\d+$", r"\1", text)
    return " ".join(text.split())


def not_printed(chunks, entry, printed):
    """Where and what the lines are that a page shows and no command printed: those of the chunks that
    have a line that begins with the entry."""
    there = {without_times(text) for text in printed.splitlines()}
    return [(line, text)
            for chunk in chunks if any(text.startswith(entry) for _, text in chunk.commands())
            for line, text in chunk.commands()
            if text != "..." and without_times(text) not in there]
