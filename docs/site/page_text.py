"""Pages of the project as text: which there are, and what in them is typed, saved or printed."""

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
AT_THE_TOP = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"]
PRINTS = "Prints"

FENCE = re.compile(r'^```(?P<language>\S*)(?: title="(?P<title>[^"]*)")?\s*$')
SPAN = re.compile(r"`([^`\n]+(?:\n[^`\n]+)?)`")
HERE_DOCUMENT = re.compile(r"<<\s*'?(\w+)'?")


def pages(root):
    """Every page, from the root on."""
    docs = sorted(file.relative_to(root).as_posix() for file in (root / "docs").rglob("*.md"))
    return AT_THE_TOP + docs


@dataclass
class Piece:
    """A block, or words in backticks (`language` "span"), of a page."""

    page: str
    line: int
    language: str
    title: str
    body: str

    @property
    def place(self):
        return f"{self.page}:{self.line}"


def pieces(page, text):
    """Blocks and spans of a page, in their order."""
    found, prose, lines, number = [], [], text.split("\n"), 0
    while number < len(lines):
        fence = FENCE.match(lines[number])
        if not fence:
            prose.append((number + 1, lines[number]))
            number += 1
            continue
        found += spans(page, prose)
        prose, begin = [], number + 1
        end = next(at for at in range(begin, len(lines)) if lines[at].startswith("```"))
        body = "\n".join(lines[begin:end])
        found.append(Piece(page, number + 1, fence["language"], fence["title"] or "", body))
        number = end + 1
    return [*found, *spans(page, prose)]


def spans(page, prose):
    """Words in backticks; those that a line's end cuts are one."""
    text = "\n".join(line for _, line in prose)
    for match in SPAN.finditer(text):
        line = prose[text.count("\n", 0, match.start())][0]
        yield Piece(page, line, "span", "", " ".join(match[1].replace("\\|", "|").split()))


def commands(body):
    """Commands of a block, each with the lines that belong to it."""
    found, until = [], None
    for line in body.split("\n"):
        goes_on = until or (found and found[-1].endswith("\\"))
        if goes_on:
            found[-1] += "\n" + line
        elif line.strip() and not line.startswith("#"):
            found.append(line)
        if until:
            until = None if line == until else until
        elif opened := HERE_DOCUMENT.search(line):
            until = opened[1]
    return found
