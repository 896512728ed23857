"""The notes of a release, cut from CHANGELOG.md: a page that people read, and the entries below it."""
import re

MAX_LINES = 40  # a page; a line is up to MAX_LETTERS
MAX_LETTERS = 160
HOW = """
## Verify and install

`./verify KEY` in this folder checks every file against the maintainers' public key; take KEY from another place than this one.

| file | what it is | how to use it |
|---|---|---|
| `*.deb` | Debian 12: `apt install ./palpate_*.deb` | `palpate run` |
| `*.whl` | Python 3.11 or 3.13 on Linux: `pip install ./palpate-*.whl` | `import palpate` |
| `palpate-{version}.tar.gz` | Python from source: compiles for a quarter of an hour | `pip install ./palpate-{version}.tar.gz` |
| `palpate-{version}.tgz` | node and browsers: `npm install ./palpate-{version}.tgz` | `import {{ load }} from 'palpate'` |
| `palpate-c-*-linux-*.tar.gz` | C library for Linux on x86-64 and ARM64, self-contained | its README |
| `palpate-c-*-windows-x86_64.zip` | C library for Windows; not tried on Windows itself | its README |
| `org.palpate.unity-{version}.tgz` | Unity: *Package Manager > Add package from tarball*; not tried in Unity itself | its README |
| `palpate-{version}-linux-x86_64.tar.gz` | the command in a folder for Linux with glibc 2.35 | `bin/palpate` |
| `palpate-{version}-source.tar.gz` | everything | `./run`, `./test` |
| `*.spdx.json`, `*-bits.jsonl` | bill of materials; hashes of forces that every platform gives | |
"""


class NoNotes(Exception):
    pass


def section(changelog: str, name: str) -> str:
    """What stands under the heading of a version, or under Unreleased; "" when there is nothing."""
    found = re.search(rf"(?ms)^## \[{re.escape(name)}\][^\n]*\n(.*?)(?=^## \[|\Z)", changelog)
    return found[1].strip() + "\n" if found and found[1].strip() else ""


def found_brief(entries: str) -> re.Match:
    brief = re.match(r"### In short\n+(.*?)(?=^### )", entries, re.S | re.M)
    if not brief:
        raise NoNotes("the section of CHANGELOG.md must begin with '### In short': what a user wants to know, one page at most")
    return brief


def brief(changelog: str, version: str) -> str:
    """What is in short, of what is unreleased, while there is something; then of the version."""
    return found_brief(section(changelog, "Unreleased") or section(changelog, version))[1].strip()


def cut(changelog: str, version: str) -> str:
    """Of what is unreleased, while there is something; then of the version."""
    unreleased = section(changelog, "Unreleased")
    title = f"{version}, and what came after it" if unreleased else version
    entries = unreleased or section(changelog, version)
    brief = found_brief(entries)
    page = f"# Palpate {title}\n\n{brief[1].strip()}\n{HOW.format(version=version)}"
    lines = page.splitlines()
    if len(lines) > MAX_LINES or max(map(len, lines)) > MAX_LETTERS:
        raise NoNotes(f"the page of the notes has {len(lines)} lines, the longest {max(map(len, lines))} letters; at most {MAX_LINES} of {MAX_LETTERS}")
    rest = entries[brief.end():]
    return page + f"\n---\n\n# All {len(re.findall('(?m)^- ', rest))} changes\n\n{rest}"
