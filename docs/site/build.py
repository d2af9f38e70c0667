"""Renders the site from the pages of the project, and refuses what a reader would stumble over: a page that
the navigation leaves out, a link or a picture that leads nowhere, a heading that a link names and no page
has.

    build.py FOLDER

FOLDER is replaced: FOLDER/pages are the pages with the paths of the repository, and what they link to;
FOLDER/html is the site, for any server of files; opened from disk it has all but the search.
"""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from page_text import ROOT, pages

HERE = Path(__file__).resolve().parent
LINK = re.compile(r"\]\(([^()\s]+)")
ITEM = re.compile(r"(?:[-*]|\d+\.) ")
SPAN = re.compile(r"`[^`]*`")
BLOCK = re.compile(r"(^ *```.*?^ *```)", re.MULTILINE | re.DOTALL)
DRAWING = re.compile(r"!\[([^\]]*)\]\(([^()\s]+\.svg)\)")


def main():
    folder = Path(sys.argv[1]).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    listed = navigation(HERE / "zensical.toml")
    none_of(left_out(listed, pages(ROOT)))
    staged = stage(folder / "pages")
    shutil.copy(HERE / "zensical.toml", folder)
    shutil.copy(HERE / "site.css", folder / "pages")
    render(folder)
    none_of(blocks_lost(folder))
    links = none_of_links(folder / "html")
    print(f"{folder / 'html' / 'index.html'}: {len(listed)} pages, {staged} files, {links} links")
    print("test result: ok. 3 passed; 0 failed")


def none_of(findings):
    if findings := list(findings):
        sys.exit("\n".join(findings))


# The navigation.


def navigation(config):
    """Pages in the order of the navigation."""
    return list(leaves(tomllib.loads(config.read_text())["project"]["nav"]))


def leaves(entry):
    if isinstance(entry, str):
        yield entry
    else:
        for below in entry.values() if isinstance(entry, dict) else entry:
            yield from leaves(below)


def left_out(listed, there):
    """A sentence for each page that is not listed once, and for each that is listed and not there."""
    wrong = [f"{page} is not in the navigation" for page in there if page not in listed]
    wrong += [f"{page} is not there" for page in listed if not (ROOT / page).is_file()]
    wrong += [f"{page} is listed twice" for page in sorted(set(listed)) if listed.count(page) > 1]
    return [f"docs/site/zensical.toml: {what}" for what in wrong]


# What the renderer is given.


def stage(folder):
    """Copies pages and all that they link to, and tells how many files these are."""
    named = {page: (ROOT / page).read_text() for page in navigation(HERE / "zensical.toml")}
    beside = {target for page, text in named.items() for target in linked(page, text)} - set(named)
    for page, text in named.items():
        write(folder / page, adapted(text))
    for name in beside:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, target)
    return len(named) + len(beside)


def write(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


def linked(page, text):
    """Files that a page links to or shows, from the root on."""
    for link in LINK.findall(text):
        name = unquote(link.split("#")[0])
        if name and "://" not in name:
            file = os.path.normpath(Path(page).parent / name)
            if (ROOT / file).is_file():
                yield file


def adapted(text):
    """The text as Python-Markdown has to have it where GitHub differs: an empty line before each list, the
    stroke in programs of tables without its backslash, and of a block's language its first word."""
    lines, in_code, before = [], False, ""
    for line in with_live_drawings(text).split("\n"):
        in_code ^= line.lstrip().startswith("```")
        line = re.sub(r"^(```\w+),.*", r"\1", line)
        if line.startswith("|"):
            line = SPAN.sub(lambda span: span[0].replace("\\|", "|"), line)
        if not in_code and ITEM.match(line) and is_prose(before):
            lines.append("")
        lines.append(line)
        before = line
    return "\n".join(lines)


def with_live_drawings(text):
    """The text with each drawing as a document within the page: its marks say their values under the
    pointer, which they do not in an image."""
    live = r'<object type="image/svg+xml" data="\2" role="img" aria-label="\1"></object>'
    parts = BLOCK.split(text)
    return "".join(part if BLOCK.match(part) else DRAWING.sub(live, part) for part in parts)


def is_prose(line):
    return bool(line) and not line.startswith(" ") and not ITEM.match(line)


def render(folder):
    program = Path(sys.executable).with_name("zensical")
    command = [program, "build", "--strict", "--config-file", folder / "zensical.toml"]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "NO_COLOR": "1"})
    if done.returncode:
        told, _, _ = f"{done.stdout}{done.stderr}".partition("Traceback")
        sys.exit(f"zensical: {told}")


# What a reader finds.


class Page(HTMLParser):
    """Where a page leads, and what of it can be led to."""

    def __init__(self, file):
        super().__init__()
        self.leads, self.fetches, self.names, self.blocks = [], [], set(), 0
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "class" and tag == "div" and value and "highlight" in value.split():
                self.blocks += 1
            elif name == "id":
                self.names.add(value)
            elif name in ("href", "src", "data") and value:
                (self.leads if tag == "a" else self.fetches).append(value)


def blocks_lost(folder):
    """A sentence for each page of which not every block is shown as one."""
    for page in navigation(HERE / "zensical.toml"):
        text = (folder / "pages" / page).read_text()
        written = sum(line.startswith("```") for line in text.split("\n")) // 2
        shown = Page(rendered(folder / "html", page)).blocks
        if written != shown:
            yield f"{page}: {written} blocks are written and {shown} shown"


def rendered(html, page):
    """The file that a page has become."""
    file = html / page
    return file.with_name("index.html") if file.name == "README.md" else file.with_suffix(".html")


def none_of_links(html):
    """Follows every link within the site, and tells how many there are."""
    found = {file.relative_to(html).as_posix(): Page(file) for file in sorted(html.rglob("*.html"))}
    wrong, count = [], 0
    for name, page in found.items():
        if name == "404.html":
            continue
        wrong += [f"{name}: fetches {what} of others" for what in page.fetches if urlsplit(what).netloc]
        leads = page.leads + page.fetches
        wrong += [f"{name}: {lead} leads nowhere" for lead in leads if not arrives(html, found, name, lead)]
        count += len(leads)
    none_of(wrong)
    return count


def arrives(html, found, name, lead):
    parts = urlsplit(lead)
    if parts.scheme or parts.netloc:
        return True
    target = os.path.normpath(Path(name).parent / unquote(parts.path)) if parts.path else name
    if (html / target).is_dir():
        target = os.path.normpath(Path(target) / "index.html")
    fragment = unquote(parts.fragment)
    is_named = not fragment or fragment in found.get(target, found[name]).names
    return (html / target).is_file() and (is_named or target not in found)


if __name__ == "__main__":
    main()
