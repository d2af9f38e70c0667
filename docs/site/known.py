"""What a command of a page may say: names and options that the program has, files and examples that are
there."""

import re
import subprocess

from page_text import ROOT

OPTION = re.compile(r"--[a-z][a-z0-9-]*")
# Stands for what a reader puts there: SCENE.toml, DIR, F.cube, K/N, X,Y,Z, experiment-N.toml, …, [--quiet].
PLACEHOLDER = re.compile(r"(?:^|[/=-])[A-Z][A-Z0-9_]*(?:$|[./,:])|[…\[\]{}<>]|^\.\.\.$")
# Commands of `cargo xtask` alone.
OF_THE_PROJECT = {
    "study", "chart", "atlas", "levels", "bench", "house", "bytes", "scene-keys", "fuzz-ledger", "ci",
}
OURS = re.compile(r"^(?:cargo xtask|wayside)(?: |$)")


class Program:
    """Commands and options of the program, by its own help."""

    def __init__(self, program):
        self.program = program
        self.all = self.listed(["--help"])
        self.options = {}

    def listed(self, words):
        """Names that stand in the list of commands."""
        listing = self.help(words).split("Commands:")[1].split("Options:")[0]
        return {line.split()[0] for line in listing.splitlines() if line.strip()}

    def help(self, words):
        return subprocess.run([self.program, *words], capture_output=True, text=True, check=True).stdout

    def options_of(self, name):
        if name not in self.options:
            self.options[name] = set(OPTION.findall(self.help([name, "--help"])))
        return self.options[name]

    def unknown(self, command):
        """What of a command of ours the program does not know."""
        words = re.sub(r"^(cargo xtask|wayside)", "", command).split()
        name = words[0].strip("…") if words else ""
        if not name or name.startswith(("-", "[")) or PLACEHOLDER.search(name):
            return []
        if name not in self.all or command.startswith("wayside") and name in OF_THE_PROJECT:
            return [f"there is no command `{name}`"]
        used, has = OPTION.findall(" ".join(words).split(" #")[0].split(" -- ")[0]), self.options_of(name)
        return [f"`{name}` has no option `{option}`" for option in used if option not in has]


def is_pattern(command):
    """Whether a command has a place that a reader fills."""
    return any(PLACEHOLDER.search(word) for word in command.split("#")[0].split())


def gone(command):
    """Packages, examples and files of the sources that a command names and that are not there."""
    words = [word.strip("'\";") for word in command.split("#")[0].split()]
    places = {"docs", "scenes", "crates", "fixtures"}
    files = [word for word in words if "/" in word and word.split("/")[0] in places]
    missing = [f"`{file}` is not there" for file in files if not (is_pattern(file) or (ROOT / file).exists())]
    after = dict(zip(words, words[1:]))
    package = after.get("-p") or after.get("--package")
    if words[:1] == ["cargo"] and package and not is_pattern(package):
        folder = ROOT / (package if package == "xtask" else f"crates/{package}")
        missing += [] if folder.is_dir() else [f"there is no package `{package}`"]
        example = after.get("--example")
        if example and not any((folder / "examples").glob(f"{example}*")):
            missing.append(f"`{package}` has no example `{example}`")
    return missing
