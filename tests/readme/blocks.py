"""The blocks of a README that may be pasted into a terminal: indented ones and fenced ones.

An indented block is split at its blank lines into chunks, for a README often shows a command, a blank
line and what the command prints. A fenced block is one chunk.
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
