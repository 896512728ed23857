"""What each product of ARCHITECTURE.md consists of, counted from the sources alone. Folding lines, files or folders together
changes none of it; only having less does. tools/weight holds the figures against weights.toml.

  lines         of code outside tests: not blank, not a comment alone
  test_lines    the same in tests
  characters    of those lines, blanks left out
  names         different words of headers that others include, outside strings: what a reader of the interface meets
  data_bytes    of numbers that are kept as text of C++: .inc files, and rows of numbers in files that have over 2 kB of them
  second_heads  files that hold another file's opening comment after their own code began
  options       of commands, counted where they are declared
  keys          of scene files, by kSceneKeys of engine/host/palpate/scene/detail/scene_keys.h, which a test holds
  words         of documents
"""
import collections
import pathlib
import re
import subprocess

COMMENTS = {".h": "//", ".cpp": "//", ".c": "//", ".cs": "//", ".js": "//", ".mjs": "//", ".ts": "//", ".py": "#", ".cmake": "#", ".sh": "#"}
COMPILED = {".h", ".cpp", ".c"}
NUMBER = r"[-+]?(?:0[xX][0-9a-fA-F.]+(?:p[-+]?\d+)?|\d[\d.]*(?:e[-+]?\d+)?)[fFuUlL]*"
PACKED = r'R?"[^"\s]{60,}"'  # a long string without a blank
NUMBER_ROW = re.compile(rf"[\s{{}}]*(?:{NUMBER}|{PACKED})(?:[\s{{}},]+(?:{NUMBER}|{PACKED}))*[\s{{}},;]*")
NUMBER_ROWS = 4  # in a row are a table
SMALL_TABLES = 2048  # bytes in a file: they are read with its code
FIGURES = ("lines", "test_lines", "characters", "names", "data_bytes", "second_heads", "options", "keys", "words")
SCENE_KEYS = "engine/host/palpate/scene/detail/scene_keys.h"

PLACES = ("engine", "instruments", "instruments/study")  # where houses lie; the other products lie at the top


def is_test(path):
    return path.startswith("tests/") or "/tests/" in path


def product_of(path, products):
    """The product that a path of the sources or of the build lies in, or None."""
    parts = path.split("/")
    below = max((len(place.split("/")) for place in PLACES if path.startswith(place + "/")), default=0)
    return parts[below] if parts[below] in products else None


def folder_of(root, product):
    """Where a product lies below the root: engine/core, instruments/study/lab, examples."""
    return next((f"{place}/{product}" for place in PLACES if (pathlib.Path(root) / place / product).is_dir()), product)


def listed(root):
    """The files that git knows, so that what a build leaves behind is not weighed."""
    said = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, text=True, check=True).stdout
    return [path for path in said.split("\0") if path and (root / path).is_file()]


def language_of(file):
    """The suffix that tells how its comments begin. Scripts of tools/ have none and say it in their first line."""
    if file.suffix or file.parent.name != "tools":
        return file.suffix
    with file.open("rb") as opened:
        first = opened.readline()
    return ".py" if b"python" in first else ".sh" if first.startswith(b"#!") else ""


def code_of(lines, comment):
    return [line for line in lines if line.strip() and not line.strip().startswith(comment)]


def words_of(header):
    """The different words of a header's code."""
    code = re.sub(r'"(\\.|[^"\\])*"', "", "\n".join(line.split("//", 1)[0] for line in header.splitlines() if not line.startswith("#")))
    return set(re.findall(r"[A-Za-z_]\w+", code))


def has_second_head(text):
    """Whether a comment of two lines or more stands by itself, at the margin, after the first line of code."""
    lines = text.splitlines()
    begun, at = False, 0
    while at < len(lines):
        if not lines[at].startswith("//") or lines[at].startswith("///"):
            begun = begun or bool(lines[at].strip() and not lines[at].startswith("#"))
            at += 1
            continue
        first = at
        while at < len(lines) and lines[at].startswith("//") and not lines[at].startswith("///"):
            at += 1
        if begun and at - first >= 2 and not lines[first - 1].strip() and at < len(lines) and not lines[at].strip():
            return True
    return False


def bytes_of_tables(lines):
    """What a file's tables of numbers take, where that is not small."""
    total = at = 0
    while at < len(lines):
        first = at
        while at < len(lines) and NUMBER_ROW.fullmatch(lines[at].split("//", 1)[0].rstrip()):
            at += 1
        if at - first >= NUMBER_ROWS:
            total += sum(len(line) + 1 for line in lines[first:at])
        at = max(at, first + 1)
    return total if total > SMALL_TABLES else 0


def weigh_code(path, text, language, found):
    code = code_of(text.splitlines(), COMMENTS[language])
    if is_test(path):
        found["test_lines"] += len(code)
        return
    found["lines"] += len(code)
    found["characters"] += sum(len("".join(line.split())) for line in code)
    if language in COMPILED:
        found["data_bytes"] += bytes_of_tables(text.splitlines())
        found["second_heads"] += has_second_head(text)
        found["options"] += len(re.findall(r'"(?:-\w,)?--[a-z][a-z0-9-]*"', "\n".join(code)))


def weigh(root, products):
    """product -> figure -> count. Documents belong to `docs`, files at the top to none but that."""
    root = pathlib.Path(root)
    found = collections.defaultdict(collections.Counter)
    names = collections.defaultdict(set)
    for path in listed(root):
        file = root / path
        product = product_of(path, products)
        if file.suffix == ".md":
            found["docs"]["words"] += len(file.read_text(encoding="utf-8").split())
        if product is None:
            continue
        if file.suffix == ".inc":
            found[product]["data_bytes"] += file.stat().st_size
        language = language_of(file)
        if language not in COMMENTS:
            continue
        text = file.read_text(encoding="utf-8", errors="replace")
        weigh_code(path, text, language, found[product])
        if language == ".h" and not is_test(path) and "/detail/" not in path:
            names[product] |= words_of(text)
    for product, words in names.items():
        found[product]["names"] = len(words)
    keys = root / SCENE_KEYS
    if keys.exists():
        found["host"]["keys"] = int(re.search(r"kSceneKeys = (\d+);", keys.read_text(encoding="utf-8"))[1])
    return {product: dict(counts) for product, counts in found.items()}
