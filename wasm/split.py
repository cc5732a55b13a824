#!/usr/bin/env python3
"""Splits the linked module into what a first visit needs and the rest, and makes both small.

split.py WHOLE FIRST OUTPUT_FIRST OUTPUT_REST

WHOLE   the module as it was linked, with names of functions
FIRST   a module of the same objects linked with the bindings of a first visit alone, with names

A function of WHOLE whose name FIRST lacks goes to the rest, but for what initialises the module. Where WHOLE has
several of one name, all stay. What CHOLMOD does with matrices that are complex or not symmetric goes there too: core
has none of them. So do self-contact and solids that are met by their surfaces, which few scenes ask for: a worker joins
the rest before it makes one of them.
"""
import re
import subprocess
import sys
import tempfile

# Those that the compiler is told to use, and its defaults.
FEATURES = ["--enable-simd", "--enable-exception-handling", "--enable-bulk-memory", "--enable-sign-ext",
            "--enable-mutable-globals", "--enable-nontrapping-float-to-int"]
# As Emscripten calls it for its modules; then again, which takes another hundredth.
SMALL = ["-Oz", "--converge", "--low-memory-unused", "--zero-filled-memory"]
# Parts of CHOLMOD for matrices that are complex, and for such as are not symmetric.
OTHER_MATRICES = re.compile(r"[cz]t?_(change|cholmod|ldl|ll|simplicial)_|"
                            r"([rp]_)?cholmod_transpose_unsym$|cholmod_(aat|colamd)$|colamd")
# What is only called where a scene asks for self-contact, boxes or meshes, as Binaryen writes names. Whether there is
# any is asked of an optional in every scene.
SELF_CONTACT = re.compile(r"(?!.*__optional|pleat::EquilibriumCheck).*pleat::"
                          r"(ClothContact|PairHold|MotionGuard|Movers|WatchedPair|SurfacePair|NearPairs|SurfaceCrossing|"
                          r"Corridors|MovingBox|PairResponse|SignedDistance|BodyDepth)|"
                          r"pleat::(separator|separates|closest_points|pair_way|json_cloth_contact|"
                          r"crossings|own_crossings|cloth_in_bodies|box_body|enclosed_volume|read_surface)\\28|"
                          r"pleat::\\28anonymous\\20namespace\\29::(part_separator|hull_normal|nearest_with|plane_point)\\28")
STRIPPED = ["--post-emscripten", "--strip-debug", "--strip-producers"]


def calls(module):
    """Names of the module's own functions, each with those that it calls by name, in Binaryen's writing."""
    graph = subprocess.run(["wasm-opt", *FEATURES, "--print-call-graph", module], check=True, stdout=subprocess.PIPE,
                           text=True).stdout
    found = {name: set() for name in re.findall(r'^  "([^"]+)" \[.*fillcolor="white"', graph, re.MULTILINE)}
    for caller, called in re.findall(r'^  "([^"]+)" -> "([^"]+)"', graph, re.MULTILINE):
        found[caller].add(called)
    return found


def reached(graph, start):
    """Start and all that it calls, and they call."""
    found, open_names = set(start), list(start)
    while open_names:
        for name in graph.get(open_names.pop(), ()):
            if name not in found:
                found.add(name)
                open_names.append(name)
    return found


def main():
    whole, first, output_first, output_rest = sys.argv[1:]
    graph = calls(whole)
    needed = reached(graph, [*calls(first), "__wasm_call_ctors"])
    rest = [name for name in graph
            if OTHER_MATRICES.match(name) or SELF_CONTACT.match(name) or (name not in needed and re.sub(r"_\d+$", "", name) not in needed)]
    with tempfile.NamedTemporaryFile(mode="w", suffix=".functions") as names:
        names.write("\n".join(rest))
        names.flush()
        subprocess.run(["wasm-split", *FEATURES, whole, f"--split-funcs=@{names.name}", "-o1", output_first,
                        "-o2", output_rest], check=True)
    for part in (output_first, output_rest):
        for once in (STRIPPED, []):
            subprocess.run(["wasm-opt", *FEATURES, *once, *SMALL, part, "-o", part], check=True)


main()
