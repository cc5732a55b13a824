#!/usr/bin/env python3
"""Checks that every comment opens on what the thing is or does: on a noun or a verb.

It may not open on a preposition ("Of each.") nor on a word that only points elsewhere ("The same", "Those", "What",
"Whether", "Which", "That"). Comment lines under each other count once, by their first. A plain `//` comment that is a
sentence may open on a phrase that a comma ends ("At rest, no force is left."), for it tells of the code below; a
doc comment (`///`, `///<`, `/** */`) may not, for it tells what a name stands for.

A violation is printed as "file:line: sentence"; the exit status is then 1.
--self-test plants violations in a scratch tree and expects each to be found.
"""
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCE_FOLDERS = ("core", "cli", "wasm", "native-tests", "bench", "web/src", "web/tests", "web/build-steps")
SOURCE_FILES = "web/*.ts"  # settings of the page's build and tests
SUFFIXES = (".h", ".cpp", ".mjs", ".js", ".ts")
BUILT = "web/src/wasm"
PREPOSITIONS = ("about above across after against along among around as at before behind below beneath beside besides "
                "between beyond by despite down during for from if in inside into of off on onto out outside over past "
                "per since than through to toward towards under until upon where with within without").split()
POINTERS = ["that", "the same", "those", "what", "whatever", "whether", "which", "whichever"]
OPENING = re.compile(r"[(*_]*(?!at least|at most)(" + "|".join(PREPOSITIONS + POINTERS) + r")(?![\w'’(-])",
                     re.IGNORECASE)
INTRODUCTION = re.compile(r"(?!Of\b)[A-Z][^.;]*?[,:]\s")
# Strings are read too, for they may hold "//".
TOKEN = re.compile(r"""R"(?P<end>\w*)\((?:.|\n)*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])*'"""
                   r"""|`(?:\\.|[^`\\])*`|(?P<comment>//[^\n]*|/\*(?:.|\n)*?\*/)""")


class Comment:
    """Comment lines under each other: the line of the first, whether they are a doc comment, and their words."""

    def __init__(self, line, text):
        self.line = line
        self.is_doc = text.startswith(("///", "/**"))
        self.words = ""
        self.add(text)

    def add(self, text):
        for line in text.removesuffix("*/").splitlines():
            self.words += " " + re.sub(r"^\s*(///?<?|/?\*+)", "", line).strip()
        self.words = self.words.strip()


def comments_of(text):
    """The comments of a source; those in the middle of a line of code, as /*x=*/, are none."""
    comments = []
    last = None  # where the last line comment stood: (line, column)
    for match in TOKEN.finditer(text):
        found = match["comment"]
        if found is None or (found.startswith("/*") and not found.startswith("/**")):
            continue
        line = text.count("\n", 0, match.start()) + 1
        line_start = text.rfind("\n", 0, match.start()) + 1
        column = match.start() - line_start
        stands_alone = not text[line_start:match.start()].strip()
        if found.startswith("//") and stands_alone and last == (line - 1, column):
            comments[-1].add(found)
        else:
            comments.append(Comment(line, found))
        last = (line, column)
    return comments


def judge(comment):
    """What is wrong with how a comment opens, or None."""
    opening = OPENING.match(comment.words)
    if opening is None:
        return None
    is_pointer = opening[1].lower() in POINTERS
    if not comment.is_doc and not is_pointer and INTRODUCTION.match(comment.words):
        return None
    kind = "doc comment" if comment.is_doc else "comment"
    return f'a {kind} opens on "{opening[1]}", expected what the thing is or does: "{comment.words[:60]}"'


def check_tree(root):
    """Every violation under `root`, as a printable line."""
    files = [path for folder in SOURCE_FOLDERS for path in (root / folder).rglob("*")
             if path.suffix in SUFFIXES and root / BUILT not in path.parents]
    violations = []
    for path in sorted([*files, *root.glob(SOURCE_FILES)]):
        name = path.relative_to(root).as_posix()
        violations += [f"{name}:{comment.line}: {judge(comment)}"
                       for comment in comments_of(path.read_text(encoding="utf-8")) if judge(comment)]
    return violations


PLANTED = {  # path: (text, expected violation or None)
    "core/mesh/noun.h": ("/// Corners of each face.\nint a;  ///< at least 1\n/// Moves it.\nint b;\n", None),
    "core/mesh/of.h": ("int a;\n/// Of each face.\nint b;\n", ':2: a doc comment opens on "Of"'),
    "core/mesh/pointer.h": ("/// The same for edges.\nint a;\n", ':1: a doc comment opens on "The same"'),
    "core/mesh/bold.h": ("/// *That* which is left.\n", 'opens on "That"'),
    "core/mesh/quoted.h": ("/// `of` is an option.\n/// \"in\", a word.\n", None),
    "core/mesh/compound.h": ("/// In-plane strain.\n///\nint a;\n/// Whichever is less.\n", ":4: "),
    "core/mesh/trailing.h": ("int a;  ///< noun\nint b;  ///< at rest [m]\n", ':2: a doc comment opens on "at"'),
    "core/mesh/goes_on.h": ("int a;  ///< length of a spring\n        ///< at rest [m]\n/// Sum\n/// of all.\n", None),
    "core/mesh/introduced.h": ("/// At rest, the sum of all.\n", 'a doc comment opens on "At"'),
    "core/mesh/sentence.cpp": ("// At rest, no force\n// is left.\n\n// From a to b: two\n", None),
    "core/mesh/fragment.cpp": ("int a;  // in cells, from zero\n", ':1: a comment opens on "in"'),
    "core/mesh/of.cpp": ("// Of these, one is left.\n", 'opens on "Of"'),
    "core/mesh/unended.cpp": ("// Between columns it tears. No, nothing.\n", 'opens on "Between"'),
    "core/mesh/wrapped.cpp": ("int a;\n//\n// Within\n// cells.\n", ':2: a comment opens on "Within"'),
    "core/mesh/text.cpp": ("f(\"// of text\", '\"', 1'000);  // a count\nR\"x(\n// of\n)x\";\ng(/*of=*/1);\n", None),
    "core/mesh/quote.cpp": ("char a = '\"';  // of a quote\n", 'opens on "of"'),
    "web/src/block.ts": ("/** Name of a view. */\n/**\n * Without a name.\n */\n", ':2: a doc comment opens on "With'),
    "web/src/text.ts": ("const a = `\n// of a template\n`;\n/* of no doc */\n", None),
    "web/src/wasm/built.js": ("// Of a tool.\n", None),
    "web/tests/e2e/view.mjs": ("/** Waits. */\n/** What is seen. */\n", ':2: a doc comment opens on "What"'),
    "web/tests/motion/hand.test.ts": ("a(); // at the pins\n", ':1: a comment opens on "at"'),
    "web/build-steps/worker.js": ("// Without a network.\n", 'opens on "Without"'),
    "web/vite.config.ts": ("/** Of the state. */\n", 'opens on "Of"'),
    "bench/row.mjs": ("// What a row says.\n", 'opens on "What"'),
    "bench/parts/part.mjs": ("/** Of a part. */\n", 'opens on "Of"'),
}


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for path, (text, _) in PLANTED.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, encoding="utf-8")
        found = check_tree(root)
    mistakes = []
    for path, (_, expected) in PLANTED.items():
        lines = [line for line in found if line.startswith(path + ":")]
        if expected is None and lines:
            mistakes.append(f"self-test: false alarm: {lines[0]}")
        if expected is not None and not (len(lines) == 1 and expected in lines[0]):
            mistakes.append(f"self-test: {path}: expected one '{expected}', found {lines}")
    return mistakes


def main():
    if sys.argv[1:] not in ([], ["--self-test"]):
        sys.exit("usage: check_comments.py [--self-test]")
    violations = self_test() if sys.argv[1:] else check_tree(ROOT)
    for violation in violations:
        print(violation)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
