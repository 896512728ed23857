#!/usr/bin/env python3
"""Checks what others read of the project: citation, codemeta, the paper, the menu entry, versions, community pages, forms, packaging/debian/.

  packaging/check_papers.py               exit code 1 and one line for each fault
  packaging/check_papers.py --self-test   breaks a copy in every way that is looked for, and expects each to be seen

No network. desktop-file-validate, appstreamcli and cffconvert judge too, where they are installed; PyYAML is needed.
"""
import datetime
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import yaml
except ImportError:
    print("skipped: python3-yaml is not installed")
    sys.exit(0)

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Fields that BibTeX's styles ask of a kind of entry.
BIB_FIELDS = {
    "article": ("author", "title", "journal", "year"),
    "inproceedings": ("author", "title", "booktitle", "year"),
    "incollection": ("author", "title", "booktitle", "publisher", "year"),
    "phdthesis": ("author", "title", "school", "year"),
    "book": ("author", "title", "publisher", "year"),
}
DOI = re.compile(r"^10\.\d{4,9}/\S+$")
COMMUNITY_PAGES = (".github/CODE_OF_CONDUCT.md", ".github/GOVERNANCE.md", ".github/SUPPORT.md")
COMMUNITY_LINES = 12  # a page that nobody has to scroll
PAPER_SECTIONS = ("Summary", "Statement of need", "References")
PAPER_WORDS = (250, 1000)  # what JOSS asks for


def version_of(root):
    return re.search(r"project\(palpate VERSION (\S+)", (root / "CMakeLists.txt").read_text())[1]


def same_version(root):
    """(file, version that it names)"""
    named = {
        "CITATION.cff": r"(?m)^version: (\S+)", "packaging/codemeta.json": r'"version": "([^"]+)"',
        "packaging/vcpkg/vcpkg.json": r'"version-semver": "([^"]+)"', "packaging/conan/conanfile.py": r'version = "([^"]+)"',
        "packaging/debian/changelog": r"^palpate \(([^-]+)-", "packaging/npm/package.json": r'"version": "([^"]+)"',
        "packaging/npm/README.md": r"palpate-([\d.]+)\.tgz", "docs/howto/web.md": r"palpate-([\d.]+)\.tgz",
        "packaging/desktop/org.palpate.palpate.metainfo.xml": r'<release version="([^"]+)"',
    }
    for file, pattern in named.items():
        found = re.search(pattern, (root / file).read_text())
        if not found or found[1] != version_of(root):
            yield f"{file}: version {found[1] if found else 'missing'}; CMakeLists.txt says {version_of(root)}"


def persons(file, where, given):
    if not given:
        yield f"{file}: {where} has no authors"
    for one in given or ():
        if not one.get("name") and not (one.get("family-names") and one.get("given-names")):
            yield f"{file}: {where}: an author needs name, or family-names and given-names"


def citation(root):
    file = "CITATION.cff"
    found = yaml.safe_load((root / file).read_text())
    for key, wanted in (("cff-version", "1.2.0"), ("type", "software"), ("license", "Apache-2.0")):
        if str(found.get(key)) != wanted:
            yield f"{file}: {key} must be {wanted}"
    for key in ("message", "title", "version"):
        if not found.get(key):
            yield f"{file}: {key} is missing"
    yield from persons(file, "it", found.get("authors"))
    entries = [("preferred-citation", found.get("preferred-citation"))]
    entries += [(f"references[{i}]", one) for i, one in enumerate(found.get("references") or ())]
    for where, entry in entries:
        entry = entry or {}
        for key in ("type", "title"):
            if not entry.get(key):
                yield f"{file}: {where}: {key} is missing"
        yield from persons(file, where, entry.get("authors"))
        if "doi" in entry and not DOI.match(entry["doi"]):
            yield f"{file}: {where}: {entry['doi']} is not a DOI"
    if shutil.which("cffconvert"):
        yield from judged(file, ["cffconvert", "--validate", "-i", str(root / file)])


def codemeta(root):
    file = "packaging/codemeta.json"
    found = json.loads((root / file).read_text())
    for key in ("@context", "@type", "name", "description", "version", "license", "author", "programmingLanguage"):
        if not found.get(key):
            yield f"{file}: {key} is missing"
    if "codemeta" not in str(found.get("@context")) or found.get("@type") != "SoftwareSourceCode":
        yield f"{file}: @context and @type must be CodeMeta's SoftwareSourceCode"


def bib_entries(text):
    """Key -> (kind, {field: value})"""
    entries = {}
    for kind, key, body in re.findall(r"@(\w+)\{([^,\s]+),\n(.*?)\n\}", text, re.S):
        entries[key] = (kind.lower(), dict(re.findall(r"(?m)^\s*(\w+) = \{(.*)\},?$", body)))
    return entries


def paper(root):
    folder = root / "packaging/paper"
    text = (folder / "paper.md").read_text()
    head = re.match(r"---\n(.*?)\n---\n", text, re.S)
    if not head:
        yield "paper.md: no YAML head"
        return
    meta, body = yaml.safe_load(head[1]), text[head.end():]
    for key in ("title", "tags", "authors", "affiliations", "date", "bibliography"):
        if not meta.get(key):
            yield f"paper.md: {key} is missing"
    known = {one.get("index") for one in meta.get("affiliations") or ()}
    for author in meta.get("authors") or ():
        if author.get("affiliation") not in known:
            yield f"paper.md: {author.get('name')}: no such affiliation"
    try:
        datetime.datetime.strptime(str(meta.get("date")), "%d %B %Y")
    except ValueError:
        yield "paper.md: date must be like 1 January 2026"
    sections = re.findall(r"(?m)^# (.+)$", body)
    for section in PAPER_SECTIONS:
        if section not in sections:
            yield f"paper.md: no section {section}"
    words = len(body.split())
    if not PAPER_WORDS[0] <= words <= PAPER_WORDS[1]:
        yield f"paper.md: {words} words; JOSS asks for {PAPER_WORDS[0]} to {PAPER_WORDS[1]}"
    entries = bib_entries((folder / "paper.bib").read_text())
    cited = set(re.findall(r"@([\w:-]+)", body))
    for key in sorted(cited - set(entries)):
        yield f"paper.md: @{key} is not in paper.bib"
    for key, (kind, fields) in entries.items():
        if key not in cited:
            yield f"paper.bib: {key} is not cited"
        if kind not in BIB_FIELDS:
            yield f"paper.bib: {key}: unknown kind {kind}"
        for field in BIB_FIELDS.get(kind, ()):
            if not fields.get(field):
                yield f"paper.bib: {key}: {field} is missing"
        if "doi" in fields and not DOI.match(fields["doi"]):
            yield f"paper.bib: {key}: {fields['doi']} is not a DOI"
    # Sizes of models are words there; every other number comes out of a command.
    store = json.loads((root / "docs/quoted/store.json").read_text())
    for name, value in re.findall(r"<!--=([\w.-]+)-->(.*?)<!--=-->", body):
        if store.get(name, {}).get("text") != value:
            yield f"paper.md: {name} is not what docs/quoted/store.json says"
    plain = re.sub(r"<!--=([\w.-]+)-->(.*?)<!--=-->|@[\w:-]+|`[^`]*`", "", body)
    for number in re.findall(r"\d[\d.,]*", plain):
        yield f"paper.md: {number} was computed by no command"


def judged(file, command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        yield f"{file}: {command[0]} says: {' '.join((done.stdout + done.stderr).split())}"


def desktop(root):
    name = "packaging/desktop/org.palpate.palpate"
    entry = dict(re.findall(r"(?m)^([\w-]+)=(.*)$", (root / f"{name}.desktop").read_text()))
    for key in ("Type", "Name", "Comment", "Exec", "Icon", "Categories"):
        if not entry.get(key):
            yield f"{name}.desktop: {key} is missing"
    try:
        component = xml.etree.ElementTree.parse(root / f"{name}.metainfo.xml").getroot()
    except xml.etree.ElementTree.ParseError as error:
        yield f"{name}.metainfo.xml: {error}"
        return
    for key in ("id", "metadata_license", "project_license", "name", "summary", "description", "launchable", "content_rating"):
        if component.find(key) is None:
            yield f"{name}.metainfo.xml: {key} is missing"
    if component.findtext("launchable") != pathlib.Path(name).name + ".desktop":
        yield f"{name}.metainfo.xml: launchable must name the desktop file"
    if shutil.which("desktop-file-validate"):
        yield from judged(f"{name}.desktop", ["desktop-file-validate", "--warn-kde", str(root / f"{name}.desktop")])
    if shutil.which("appstreamcli"):
        yield from judged(f"{name}.metainfo.xml", ["appstreamcli", "validate", "--no-net", str(root / f"{name}.metainfo.xml")])


def community(root):
    for page in COMMUNITY_PAGES:
        lines = [line for line in (root / page).read_text().splitlines() if line.strip()]
        if not 5 <= len(lines) <= COMMUNITY_LINES:
            yield f"{page}: {len(lines)} lines; 5 to {COMMUNITY_LINES} are read"
    forms = sorted((root / ".github/ISSUE_TEMPLATE").glob("*.md"))
    if len(forms) < 2:
        yield ".github/ISSUE_TEMPLATE: two forms are promised in SUPPORT.md"
    support = (root / ".github/SUPPORT.md").read_text()
    for form in forms:
        head = re.match(r"---\n(.*?)\n---\n", form.read_text(), re.S)
        meta = yaml.safe_load(head[1]) if head else {}
        if not meta.get("name") or not meta.get("about"):
            yield f"{form.name}: an issue form needs name and about"
        elif f'"{meta["name"]}"' not in support:
            yield f"SUPPORT.md does not name the form {meta['name']}"
    if not (root / ".github/PULL_REQUEST_TEMPLATE.md").exists():
        yield ".github/PULL_REQUEST_TEMPLATE.md is missing"
    if "SECURITY.md" not in support:
        yield "SUPPORT.md does not lead to SECURITY.md"


# Of what tools/install-dependencies lists: what every Debian build has, and what only drawing at run time needs.
NOT_TO_BUILD = {"g++", "cmake", "pkg-config", "libgl1-mesa-dri"}


def debian(root):
    """Each family has its package, each package its list of files, and what building needs is asked for."""
    control = (root / "packaging/debian/control").read_text()
    packages = set(re.findall(r"(?m)^Package: (\S+)", control))
    for package in sorted(packages ^ {file.stem for file in (root / "packaging/debian").glob("*.install")}):
        yield f"debian: {package} must be in control and have a list of files"
    rows = [line.split("\t") for line in (root / "engine/cli/kit/families.tsv").read_text().splitlines() if line and not line.startswith("#")]
    for family in sorted({row[2] for row in rows}):
        if f"palpate-{family}" not in packages:
            yield f"packaging/debian/control: the family {family} has no package"
    asked = set(re.findall(r"^ *(?:Build-Depends: )?([a-z0-9.+-]+)", control.split("\n\n")[0].split("Build-Depends:")[1], re.M))
    lists = re.sub(r"#.*", "", (root / "tools/install-dependencies").read_text())
    for words in re.findall(r"(?ms)^(?:bare|report|serve|measure|teach|class)=\((.*?)\)", lists):
        for package in words.split():
            if not package.startswith('"') and package not in asked and package not in NOT_TO_BUILD:
                yield f"packaging/debian/control: building needs {package}"


CHECKS = (same_version, citation, codemeta, paper, desktop, community, debian)
FILES = ("CMakeLists.txt", "CITATION.cff", "packaging/codemeta.json", "docs/quoted/store.json", "packaging/vcpkg",
         "packaging/conan", "packaging/npm", "docs/howto/web.md", "packaging/paper", "packaging/desktop", ".github", "packaging/debian", "engine/cli/kit/families.tsv", "tools/install-dependencies")


def faults(root):
    return [fault for check in CHECKS for fault in check(root)]


# File, what stands there, what takes its place, and a word of the fault that must be seen.
BREAKS = (
    ("CITATION.cff", "version: 0", "version: 9", "CMakeLists.txt says"),
    ("CITATION.cff", "message:", "massage:", "message is missing"),
    ("CITATION.cff", "doi: 10.1186/", "doi: 1186/", "is not a DOI"),
    ("packaging/codemeta.json", '"license"', '"licence"', "license is missing"),
    ("packaging/conan/conanfile.py", 'version = "', 'version = "1', "CMakeLists.txt says"),
    ("packaging/debian/changelog", "palpate (", "palpate (9", "CMakeLists.txt says"),
    ("packaging/npm/package.json", '"version": "', '"version": "9', "CMakeLists.txt says"),
    ("packaging/desktop/org.palpate.palpate.metainfo.xml", '<release version="', '<release version="9', "CMakeLists.txt says"),
    ("packaging/debian/control", "Package: palpate-teach", "Package: palpate-learn", "the family teach"),
    ("packaging/debian/control", "Package: palpate-teach", "Package: palpate-learn", "palpate-learn must be in control"),
    ("packaging/debian/control", "               libvpx-dev,\n", "", "building needs libvpx-dev"),
    ("packaging/paper/paper.md", "@ji2008", "@jo2008", "is not in paper.bib"),
    ("packaging/paper/paper.md", "@ho1999", "@zilles1995", "is not cited"),
    ("packaging/paper/paper.md", "# Statement of need", "# Need", "no section Statement of need"),
    ("packaging/paper/paper.md", "a thousand times", "1000 times", "computed by no command"),
    ("packaging/paper/paper.md", "growth-->", "growth-->9", "store.json"),
    ("packaging/paper/paper.bib", "school =", "schule =", "school is missing"),
    ("packaging/desktop/org.palpate.palpate.desktop", "Icon=", "Image=", "Icon is missing"),
    ("packaging/desktop/org.palpate.palpate.metainfo.xml", "</name>", "</nome>", "metainfo.xml"),
    ("packaging/desktop/org.palpate.palpate.metainfo.xml", "palpate.desktop</launchable", "other.desktop</launchable", "must name the desktop file"),
    (".github/SUPPORT.md", "Something is wrong", "Wrong", "does not name the form"),
    (".github/ISSUE_TEMPLATE/missing.md", "about:", "about", "missing.md"),
)


def copy_of(root, folder):
    for name in FILES:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (root / name).is_dir() else shutil.copyfile)(root / name, folder / name)


def self_test():
    unseen = 0
    for file, old, new, word in BREAKS:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            copy_of(ROOT, root)
            text = (root / file).read_text()
            (root / file).write_text(text.replace(old, new))
            try:
                seen = old in text and any(word in fault for fault in faults(root))
            except yaml.YAMLError as error:
                seen = word in file or word in str(error)
        if not seen:
            unseen += 1
            print(f"{file}: {old!r} -> {new!r} is not seen as {word!r}")
    print(f"papers: {len(BREAKS) - unseen} of {len(BREAKS)} faults are seen")
    return 1 if unseen else 0


def main(words):
    if words == ["--self-test"]:
        return self_test()
    if words:
        print(__doc__)
        return 0 if words[0] in ("-h", "--help") else 2
    found = faults(ROOT)
    print("\n".join(found) if found else "papers: nothing wrong")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
