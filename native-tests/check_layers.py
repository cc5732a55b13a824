#!/usr/bin/env python3
"""Checks every #include of the C++ sources, and who prints, against core/LAYERS.

A violation is printed as "file:line: sentence"; the exit status is then 1.
--self-test plants one violation of every kind in a scratch tree and expects each to be found.
"""
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCE_FOLDERS = ("core", "cli", "wasm", "native-tests")
OUTER_MODULES = ("cli", "wasm", "native-tests")  # folders of their own, beside core/
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:<([^>]+)>|"([^"]+)")')


class Rules:
    """core/LAYERS, read: the height of each module and of the rooms inside it, who may include which
    installed header, and who may call which function."""

    def __init__(self, text):
        self.height = {}
        self.floors = {}  # folder with rooms, below core/: {file or folder in it: height}
        self.reserved = []  # (header or folder ending in "/", places)
        self.calls = []  # (function, places)
        n_layers = 0
        for number, line in enumerate(text.splitlines(), start=1):
            words = line.split("#")[0].split()
            if not words:
                continue
            if words[0] == "layer" and len(words) > 1:
                self.height.update({module: n_layers for module in words[1:]})
                n_layers += 1
            elif words[0] == "room" and len(words) > 2:
                floors = self.floors.setdefault(words[1], {})
                floors.update(dict.fromkeys(words[2:], 1 + max(floors.values(), default=-1)))
            elif words[0] in ("only", "call") and "in" in words[2:-1]:
                split = words.index("in")
                rules = self.reserved if words[0] == "only" else self.calls
                rules += [(name, words[split + 1:]) for name in words[1:split]]
            else:
                sys.exit(f"core/LAYERS:{number}: expected 'layer MODULE…', 'room FOLDER NAME…', 'only HEADER… in PLACE…' "
                         f"or 'call FUNCTION… in PLACE…', found '{line.strip()}'")

    def places_for(self, header):
        """Where this header may be included, or None when everywhere."""
        for reserved, places in self.reserved:
            if header == reserved or (reserved.endswith("/") and header.startswith(reserved)):
                return places
        return None


def module_of(path):
    """The module a repository path belongs to: core/mesh/x.h is mesh, cli/run.cpp is cli."""
    parts = path.split("/")
    if parts[0] == "core" and len(parts) > 2:
        return parts[1]
    return parts[0] if parts[0] in OUTER_MODULES else None


def judge_rooms(rules, path, header):
    """What is wrong with including `header` from `path`, both files of core, by the rooms of a folder that
    holds both; or None."""
    seer, seen = (name.removeprefix("core/").rsplit(".", 1)[0].split("/") for name in (path, header))
    depth = 0
    while seer[depth] == seen[depth] and depth < min(len(seer), len(seen)) - 1:
        depth += 1
    folder = "/".join(seen[:depth])
    floors = rules.floors.get(folder)
    if floors is None or seer[depth] == seen[depth]:
        return None
    for name in (seer[depth], seen[depth]):
        if name not in floors:
            return f"{folder}/{name} stands in no room of core/LAYERS"
    higher = floors[seen[depth]] - floors[seer[depth]]
    beside_folder = higher == 0 and len(seer) + len(seen) > 2 * depth + 2
    if higher > 0 or beside_folder:
        return f"{folder}/{seer[depth]} may not see {folder}/{seen[depth]}: it is not in a lower room"
    return None


def is_in(path, places):
    return any(path == place or (place.endswith("/") and path.startswith(place))
               for place in places)


def judge_own(root, rules, path, header):
    """What is wrong with including this repository's `header` from `path`, or None."""
    target = module_of(header)
    if target is None or ".." in header.split("/"):
        return f'"{header}": expected a path from the repository\'s root'
    if not (root / header).is_file():
        return f'"{header}": there is no such file'
    module = module_of(path)
    for name in (module, target):
        if name not in rules.height:
            return f"module {name} stands in no layer of core/LAYERS"
    if target != module and rules.height[target] >= rules.height[module]:
        return f"{module} may not see {target}: it is not in a lower layer"
    return judge_rooms(rules, path, header) if path.startswith("core/") and module == target else None


def judge_installed(rules, path, header):
    """What is wrong with including the installed `header` from `path`, or None."""
    if header.split("/")[0] in SOURCE_FOLDERS:
        return f'<{header}>: this repository\'s own files are included with ""'
    places = rules.places_for(header)
    if places is not None and not is_in(path, places):
        return f"<{header}> is only for {', '.join(places)}"
    return None


def check_calls(rules, path, text):
    """Calls of functions that are not for this file, as (line number, sentence)."""
    forbidden = {name: places for name, places in rules.calls if not is_in(path, places)}
    if not forbidden:
        return
    call = re.compile(r"\b(" + "|".join(forbidden) + r")\s*\(")
    for number, line in enumerate(text.splitlines(), start=1):
        for name in call.findall(line.split("//")[0]):
            yield number, f"{name}() is only for {', '.join(forbidden[name])}"


def check_includes(root, rules, path, text):
    """Includes that break a rule, as (line number, sentence)."""
    own_header = str(Path(path).with_suffix(".h"))
    expects_own_first = path.endswith(".cpp") and (root / own_header).is_file()
    for number, line in enumerate(text.splitlines(), start=1):
        match = INCLUDE.match(line)
        if not match:
            continue
        installed, own = match.groups()
        if expects_own_first and own != own_header:
            yield number, f'expected its own header "{own_header}" to come first'
        expects_own_first = False
        sentence = (judge_installed(rules, path, installed) if installed
                    else judge_own(root, rules, path, own))
        if sentence:
            yield number, sentence


def check_file(root, rules, path):
    text = (root / path).read_text(encoding="utf-8")
    return sorted([*check_includes(root, rules, path, text), *check_calls(rules, path, text)])


def check_tree(root):
    """Every violation under `root`, as a printable line."""
    rules = Rules((root / "core/LAYERS").read_text(encoding="utf-8"))
    files = sorted(path.relative_to(root).as_posix() for folder in SOURCE_FOLDERS
                   for path in (root / folder).rglob("*") if path.suffix in (".h", ".cpp"))
    return [f"{path}:{number}: {sentence}" for path in files
            for number, sentence in check_file(root, rules, path)]


PLANTED = {  # path: (text, expected violation or None)
    "core/base/vec.h": ("#include <Eigen/Core>\n", None),
    "core/mesh/quad.h": ('#include "core/base/vec.h"\n', None),
    "core/mesh/quad.cpp": ('#include "core/mesh/quad.h"\n#include <vector>\n', None),
    "core/mesh/order.h": ("", None),
    "core/mesh/order.cpp": ('#include <vector>\n#include "core/mesh/order.h"\n',
                            ":1: expected its own header"),
    "core/base/down.h": ('\n#include "core/mesh/quad.h"\n', ":2: base may not see mesh"),
    "core/linalg/beside.h": ('#include "core/mesh/quad.h"\n', ":1: linalg may not see mesh"),
    "core/mesh/relative.h": ('#include "quad.h"\n', ":1: \"quad.h\": expected a path from"),
    "core/mesh/upward.h": ('#include "core/../core/mesh/quad.h"\n', "expected a path from"),
    "core/mesh/angle.h": ("#include <core/base/vec.h>\n", "own files are included with"),
    "core/mesh/gone.h": ('#include "core/base/gone.h"\n', "there is no such file"),
    "core/mesh/clock.cpp": ("#  include <chrono>\n", ":1: <chrono> is only for core/run/part_timer.cpp"),
    "core/mesh/json.cpp": ("#include <nlohmann/json.hpp>\n", "<nlohmann/json.hpp> is only for"),
    "core/mesh/commented.cpp": ("// #include <iostream>\n", None),
    "core/mesh/printing.cpp": ('std::printf ("%d", 1);\n', ":1: printf() is only for cli/"),
    "core/mesh/formatting.cpp": ("std::snprintf(text, 9, format);  // not printf()\n", None),
    "cli/report.cpp": ("std::puts(text);\n", None),
    "core/linalg/direct/cholmod_solver.cpp": ("#include <cholmod.h>\n", None),
    "core/linalg/sparse.h": ("", None),
    "core/linalg/solve_report.h": ('#include "core/linalg/sparse.h"\n', None),
    "core/linalg/iterative/sweep.h": ('#include "core/linalg/sparse.h"\n', None),
    "core/linalg/aggregation/multigrid.h": ('#include "core/linalg/iterative/sweep.h"\n',
                                            "linalg/aggregation may not see linalg/iterative"),
    "core/linalg/direct/beside.h": ('#include "core/linalg/aggregation/multigrid.h"\n',
                                    "linalg/direct may not see linalg/aggregation"),
    "core/linalg/attic.h": ('#include "core/linalg/sparse.h"\n', "linalg/attic stands in no room"),
    "core/dynamics/position_based/lanes/springs.h": ("", None),
    "core/dynamics/position_based/lane_layout.h": (
        '#include "core/dynamics/position_based/lanes/springs.h"\n',
        "dynamics/position_based/lane_layout may not see dynamics/position_based/lanes"),
    "core/linalg/direct/other_solver.cpp": ("#include <cholmod.h>\n", "<cholmod.h> is only for"),
    "core/attic/new.h": ('#include "core/base/vec.h"\n', "module attic stands in no layer"),
    "cli/main.cpp": ('#include <iostream>\n#include "core/mesh/quad.h"\n', None),
    "native-tests/mesh/quad_test.cpp": ('#include "cli/main.h"\n', "there is no such file"),
    "native-tests/cli/main_test.cpp": ('#include "cli/main.cpp"\n', None),
    "cli/loop.cpp": ('#include "native-tests/mesh/quad_test.cpp"\n',
                     "cli may not see native-tests"),
}


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for path, (text, _) in PLANTED.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, encoding="utf-8")
        (root / "core/LAYERS").write_text((ROOT / "core/LAYERS").read_text(encoding="utf-8"))
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
        sys.exit("usage: check_layers.py [--self-test]")
    violations = self_test() if sys.argv[1:] else check_tree(ROOT)
    for violation in violations:
        print(violation)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
