#!/usr/bin/env python3
"""Prints one hash for every shipped result, to the bit.

usage: result_hashes.py PLEAT [--quick] > before.txt

PLEAT is the built command. Every scene of assets/scenes runs as it is and by every other stepper that takes it;
every experiment of assets/deform is solved; the short hard cases run; a plan, modes, frames between keys, a
hierarchy, a convergence study and a sweep are made. Hashed are frames, files and JSON, bit by bit, but no times.
Run it before and after a change that must not change results, and compare with diff.
--quick runs half a second of each scene.
"""
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ASSETS = ROOT / "assets"
OTHER_STEPPERS_S = "0.05"  # what every other stepper runs for
GARMENTS_S = "3"
TOO_SLOW = {("skirt", "explicit"), ("skirt", "rk4")}  # minutes a step
# Keys of what differs from run to run, or names the sources.
UNSTABLE_KEY = re.compile(r"(^|_)(ms|spread|commit|core)(_|$)")


def short_hash(data):
    return hashlib.sha256(data).hexdigest()[:20]


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(part) for key, part in value.items() if not UNSTABLE_KEY.search(key)}
    return [without_times(part) for part in value] if isinstance(value, list) else value


def json_hash(lines):
    """One hash over JSON texts, one in each line, without their times."""
    kept = [json.dumps(without_times(json.loads(line)), sort_keys=True) for line in lines]
    return short_hash("\n".join(kept).encode())


def folder_hash(folder):
    """One hash over the names and bytes of all frames in a folder."""
    total = b""
    for path in sorted(path for path in folder.rglob("*") if path.suffix in (".obj", ".ply", ".bin", ".frames")):
        total += path.name.encode() + path.read_bytes()
    return short_hash(total)


class Command:
    """The built command; each method returns what one of its commands made, in words."""

    def __init__(self, path):
        self.path = path

    def call(self, *words):
        return subprocess.run([self.path, *map(str, words)], capture_output=True, text=True, check=False)

    def steppers(self):
        """The names of all steppers, from the sentence that refuses one that is none."""
        refusal = self.call("run", ASSETS / "scenes/ball.json", "--stepper", "none").stderr
        return re.findall(r'"(\w+)"', refusal.split("one of")[1].split("got")[0])

    def run(self, scene, *options):
        with tempfile.TemporaryDirectory() as folder:
            done = self.call("run", scene, "--out", folder, "--json", *options)
            if done.returncode == 2:
                return "refused"
            metrics = json.loads(done.stdout)
            return f'{folder_hash(Path(folder))} {metrics["n_steps"]} {metrics["status"]} {metrics["iterations_per_step"]!r}'

    def made(self, *words, out):
        """The files that a command writes under the name `out`, or its exit code."""
        with tempfile.TemporaryDirectory() as folder:
            done = self.call(*words, "--out", Path(folder) / out)
            plans = [short_hash(path.read_bytes()) for path in sorted(Path(folder).rglob("*.json"))]
            rows = [json_hash(path.read_text(encoding="utf-8").splitlines())
                    for path in sorted(Path(folder).rglob("*.jsonl"))]
            return " ".join([folder_hash(Path(folder)), *plans, *rows, f"exit {done.returncode}"])

    def printed(self, *words):
        return json_hash([self.call(*words, "--json").stdout])

    def hard_cases(self, name):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "outcomes.jsonl"
            self.call("hard-cases", name, "--short", "--json", out)
            return json_hash(out.read_text(encoding="utf-8").splitlines())


def jobs(pleat, quick):
    """Every result as (name, how to make it)."""
    steppers = pleat.steppers()
    for scene in sorted((ASSETS / "scenes").rglob("*.json")):
        name = scene.relative_to(ASSETS / "scenes")
        is_garment = scene.parent.name == "garments"
        length = ["--duration", "0.5"] if quick else ["--duration", GARMENTS_S] if is_garment else []
        yield str(name), lambda scene=scene, length=length: pleat.run(scene, *length)
        own = json.loads(scene.read_text(encoding="utf-8")).get("method", {}).get("stepper", "implicit")
        for stepper in steppers:
            if stepper != own and not is_garment and (name.stem, stepper) not in TOO_SLOW:
                yield f"{name} by {stepper}", lambda scene=scene, stepper=stepper: pleat.run(
                    scene, "--stepper", stepper, "--duration", OTHER_STEPPERS_S)
    for scene in sorted((ASSETS / "deform").glob("*.json")):
        yield f"deform {scene.name}", lambda scene=scene: pleat.made("deform", scene, out="shape.obj")
    for scene in sorted((ASSETS / "hard_cases").glob("*.json")):
        yield f"hard case {scene.stem}", lambda scene=scene: pleat.hard_cases(scene.stem)
    skirt, sheet = ASSETS / "meshes/skirt.obj", ASSETS / "scenes/swinging_sheet.json"
    yield "refine tablecloth", lambda: pleat.made(
        "refine", ASSETS / "scenes/tablecloth.json", "--duration", "1", "--demand", "0.0005", out="plan.json")
    yield "refine skirt", lambda: pleat.made(
        "refine", ASSETS / "scenes/garments/skirt_walk.json", "--level", "1", "--duration", "1.5", "--from", "0.5", out="plan.json")
    yield "modes of a shirt", lambda: pleat.made("modes", ASSETS / "meshes/t_shirt.obj", out="modes")
    yield "modes of a scene", lambda: pleat.made("modes", sheet, "--duration", "0.5", out="modes")
    yield "hierarchy", lambda: pleat.made("hierarchy", skirt, out="levels")
    yield "convergence", lambda: pleat.printed("convergence", sheet, "--rounds", "65")
    yield "sweep", lambda: pleat.made(
        "sweep", ASSETS / "scenes/ball.json", "--duration", "0.1", "--repeat", "1", "--steppers",
        ",".join(name for name in steppers if name not in ("explicit", "rk4")), "--reference", "same_mesh", out="sweep")
    yield "inbetween", lambda: inbetween(pleat, skirt)


def inbetween(pleat, mesh):
    """Frames between a mesh and its third mode."""
    with tempfile.TemporaryDirectory() as folder:
        pleat.call("modes", mesh, "--modes", "4", "--out", folder)
        keys = sorted(Path(folder).glob("*.obj"))
        return pleat.made("inbetween", keys[0], keys[-1], "--frames", "9", out="frames")


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--quick"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    pleat = Command(str(Path(arguments[0]).resolve()))
    named = list(jobs(pleat, "--quick" in sys.argv))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for (name, _), result in zip(named, pool.map(lambda job: job[1](), named)):
            print(f"{name}: {result}", flush=True)


if __name__ == "__main__":
    main()
