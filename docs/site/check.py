"""Whether the pages of the site say what is so: every command on them is run, and what a page shows as
printed is compared with what came out.

    check.py PROGRAM [--mend | --list] [PAGE …]

PROGRAM carries out the commands of `wayside` and `cargo xtask`. A page is followed from top to bottom in a
new folder of its own: blocks with the title of a file are saved, blocks of `sh` and whole commands in
backticks are run, blocks titled "Prints" are compared with what the last command printed. A tutorial's
folder holds the sources as `wayside`, any other the folders of the sources. What is not run is a row of
left-out.toml with its reason, or a pattern such as `run SCENE.toml`; of both, names and options are looked up
all the same. `--mend` writes what was printed into the pages, beside the finding; `--list` tells what would
be run, and runs nothing.
"""

import os
import re
import subprocess
import sys
import tempfile
import time
import tomllib
from collections import Counter
from pathlib import Path

from known import OURS, Program, gone, is_pattern
from page_text import PRINTS, ROOT, commands, pages, pieces

HERE = Path(__file__).resolve().parent
LEFT_OUT = HERE / "left-out.toml"
TUTORIALS = "docs/tutorials/"
# Folders of the sources that commands of pages name.
OF_SOURCES = ["scenes", "fixtures", "crates", "docs"]
LONGEST_S = 600
# A prediction is of all parts.
PART = re.compile(r" --shard \S+")
# Lines about a work that goes on: standard error, when nobody looks at a terminal.
PROGRESS = re.compile(r"^[\w-]+, for \d+ s|^frame \d+ of \d+$")
# Numbers that hang on the machine: seconds, memory, threads, and the first of two that end with seconds.
MASKED = re.compile(r"\d[\d.]*(?= (?:s|ms|MiB|threads)\b)|\d[\d.]*(?= to \d[\d.]* s\b)")
SHELL_WORDS = ("cargo", "wayside", "pip", "python3", "python", "node")


class Check:
    def __init__(self, program, options):
        self.known = Program(program)
        self.mend, self.only_list = "--mend" in options, "--list" in options
        self.table = tomllib.loads(LEFT_OUT.read_text())
        self.findings, self.counts, self.used = [], Counter(), Counter()
        self.took, self.seen, self.printed = [], set(), ""

    # A page.

    def page(self, page, folder):
        text = (ROOT / page).read_text()
        self.folder, self.printed = prepared(folder, page), ""
        for piece in pieces(page, text):
            handle = getattr(self, f"on_{piece.language.split(',')[0]}", None)
            if handle:
                handle(piece)
            else:
                self.tell(piece, f"a block is sh, toml, text, python or rust, not `{piece.language}`")
        self.counts["pages"] += 1

    def tell(self, piece, what):
        self.findings.append(f"{piece.place}: {what}")

    def on_text(self, piece):
        if piece.title == PRINTS:
            self.compare(piece)
        elif piece.title:
            self.save(piece)

    def on_toml(self, piece):
        try:
            tomllib.loads(piece.body)
            self.counts["TOML read"] += 1
        except tomllib.TOMLDecodeError as wrong:
            self.tell(piece, f"is no TOML: {wrong}")
        if piece.title:
            self.save(piece)

    def on_python(self, piece):
        compile(piece.body, piece.place, "exec")
        self.left_out("```python")

    def on_rust(self, piece):
        self.left_out("```rust")

    def save(self, piece):
        (self.folder / piece.title).write_text(piece.body + "\n")
        self.counts["files saved"] += 1

    # Commands.

    def on_sh(self, piece):
        kept = [self.kept(piece, command) for command in commands(piece.body)]
        kept = [command for command in kept if command]
        if kept:
            self.run(piece, "\n".join(kept), len(kept))

    def on_span(self, piece):
        words = piece.body.split()
        if not words or words[0] not in SHELL_WORDS:
            return
        if len(words) <= (2 if words[:2] == ["cargo", "xtask"] else 1) + 1:
            self.look_up(piece, piece.body)
            self.counts["names of commands"] += 1
            return
        kept = self.kept(piece, piece.body)
        if kept and (kept not in self.seen or os.listdir(self.folder) != OF_SOURCES):
            self.run(piece, kept, 1)
            self.seen.add(kept)

    def look_up(self, piece, command):
        for one in re.split(r"&&|\|\|?|;", command) if not is_pattern(command) else [command]:
            if OURS.match(one.strip()):
                for what in self.known.unknown(one.strip()):
                    self.tell(piece, what)
        for what in [] if piece.page.startswith(TUTORIALS) else gone(command):
            self.tell(piece, what)

    def kept(self, piece, command):
        """The command as it is to be run, or nothing."""
        self.look_up(piece, command)
        row = self.left_out(command)
        if row is None and not is_pattern(command) or piece.page.startswith(TUTORIALS) and row is None:
            return command
        if row is None or is_pattern(command):
            self.counts["patterns"] += 1
            return None
        instead = row.get("instead") if (ROOT / row.get("needs", ".")).exists() else None
        return f"{PART.sub('', command.split(' #')[0])} {instead}" if instead else None

    def left_out(self, command):
        for number, row in enumerate(self.table["left_out"]):
            if any(command.startswith(begin) for begin in row["begins"]):
                self.used[number] += 1
                return row
        if command.startswith("```"):
            self.findings.append(f"left-out.toml: no row tells of blocks {command}")
        return None

    def run(self, piece, script, count):
        if self.only_list:
            return print(f"{piece.place}: {script}")
        start = time.monotonic()
        # What does not end in time is ended with all that it began.
        shell = ["timeout", str(LONGEST_S), "bash", "-e", "-c", script]
        done = subprocess.run(shell, cwd=self.folder, env=self.environment(), stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        lines = done.stdout.decode().splitlines()
        self.printed = "\n".join(line for line in lines if not PROGRESS.match(line))
        self.took.append((time.monotonic() - start, piece.place, script))
        self.counts["commands run"] += count
        if done.returncode:
            self.tell(piece, f"exit code {done.returncode}: {script}\n{self.printed[-1000:]}")

    def environment(self):
        work = self.folder.parent
        path = f"{work / 'bin'}{os.pathsep}{os.environ['PATH']}"
        return {**os.environ, "PATH": path, "LC_ALL": "C.UTF-8", "XDG_CACHE_HOME": str(work / "cache")}

    # What was printed.

    def compare(self, piece):
        if self.only_list:
            return
        self.counts["outputs compared"] += 1
        if is_shown(masked(piece.body), masked(self.printed)):
            return
        if self.mend:
            file = ROOT / piece.page
            file.write_text(file.read_text().replace(f"\n{piece.body}\n```", f"\n{self.printed}\n```", 1))
        self.tell(piece, f"shows\n{piece.body}\nand what is printed is\n{self.printed}")

    def unused(self):
        """Rows of the table that no page needs."""
        rows = [row for number, row in enumerate(self.table["left_out"]) if not self.used[number]]
        return [f"left-out.toml: nothing begins with {row['begins']}" for row in rows]

    def told(self):
        for seconds, place, script in sorted(self.took, reverse=True)[:5]:
            print(f"{seconds:5.1f} s  {place}  {script.splitlines()[0][:70]}")
        for number, row in enumerate(self.table["left_out"]):
            print(f"left out {self.used[number]:3}: {', '.join(row['begins'])} ({row['why']})")
        print(", ".join(f"{count} {what}" for what, count in self.counts.items()))


def prepared(folder, page):
    """The folder in which a page is followed."""
    folder.mkdir(parents=True)
    if page.startswith(TUTORIALS):
        (folder / "wayside").symlink_to(ROOT)
    else:
        for name in OF_SOURCES:
            (folder / name).symlink_to(ROOT / name)
    return folder


def programs(folder, program):
    """`wayside` and `cargo xtask` as commands: both are the program that is checked."""
    folder.mkdir()
    for name, words in [("wayside", '"$@"'), ("cargo", '"${@:2}"')]:
        file = folder / name
        only = '[ "$1" = xtask ] || { echo "cargo $*: the check runs cargo xtask alone"; exit 1; }\n'
        file.write_text(f"#!/bin/bash\n{only if name == 'cargo' else ''}exec {program} {words}\n")
        file.chmod(0o755)


def masked(text):
    return MASKED.sub("#", "\n".join(line.rstrip() for line in text.strip("\n").splitlines()))


def is_shown(shown, printed):
    """Whether lines are those printed; a line of "…" stands for any."""
    parts = [re.escape(part) for part in re.split(r"^…$", shown, flags=re.MULTILINE)]
    return re.fullmatch("(?s:.*)".join(parts), printed) is not None


def main():
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    program, asked = Path(words[0]).resolve(), words[1:]
    check = Check(program, options=sys.argv)
    with tempfile.TemporaryDirectory() as work:
        programs(Path(work) / "bin", program)
        for page in asked or pages(ROOT):
            check.page(page, Path(work) / page.replace("/", "-").removesuffix(".md"))
    findings = check.findings + ([] if asked else check.unused())
    check.told()
    print("\n".join(findings))
    passed = check.counts["commands run"] + check.counts["outputs compared"]
    print(f"test result: {'FAILED' if findings else 'ok'}. {passed} passed; {len(findings)} failed")
    sys.exit(bool(findings))


if __name__ == "__main__":
    main()
