#!/usr/bin/env python3
"""Prints one hash for every shipped scene's result, to the bit.

usage: result_hashes.py PLEAT [--quick] > before.txt

PLEAT is the built command. Every scene of assets/scenes runs as it is and with every other stepper that
takes it, every experiment of assets/deform is solved; what is hashed are the frames, bit by bit, and the
steps taken. Run it before and after a change that must not change results, and compare with diff.
--quick runs half a second of each scene.
"""
import hashlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STEPPERS = ("explicit", "rk4", "implicit", "newton", "projective", "xpbd")
OTHER_STEPPERS_S = "0.05"  # what every other stepper runs for
GARMENTS_S = "3"
TOO_SLOW = {("skirt", "explicit"), ("skirt", "rk4")}  # minutes a step


def digest(folder):
    """One hash over the names and bytes of all frames in a folder."""
    total = hashlib.sha256()
    for path in sorted(path for path in folder.rglob("*") if path.suffix in (".obj", ".ply", ".bin", ".frames")):
        total.update(path.name.encode() + path.read_bytes())
    return total.hexdigest()[:20]


def run(pleat, scene, options):
    """The result of one run in words: hash of its frames, steps and status; or that it was refused."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([pleat, "run", scene, "--out", folder, "--json", *options],
                              capture_output=True, text=True, check=False)
        if done.returncode == 2:
            return "refused"
        metrics = json.loads(done.stdout)
        return f'{digest(Path(folder))} {metrics["n_steps"]} {metrics["status"]} {metrics["iterations_per_step"]!r}'


def deform(pleat, scene):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "shape.obj"
        done = subprocess.run([pleat, "deform", scene, "--out", out], capture_output=True, text=True, check=False)
        return f"{digest(Path(folder))} exit {done.returncode}"


def main():
    arguments = sys.argv[1:]
    quick = "--quick" in arguments
    arguments = [argument for argument in arguments if argument != "--quick"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    pleat = str(Path(arguments[0]).resolve())
    for scene in sorted((ROOT / "assets/scenes").rglob("*.json")):
        name = scene.relative_to(ROOT / "assets/scenes")
        is_garment = scene.parent.name == "garments"
        length = ["--duration", "0.5"] if quick else ["--duration", GARMENTS_S] if is_garment else []
        print(f"{name}: {run(pleat, scene, length)}", flush=True)
        own = json.loads(scene.read_text(encoding="utf-8")).get("method", {}).get("stepper", "implicit")
        for stepper in STEPPERS:
            if stepper != own and not is_garment and (name.stem, stepper) not in TOO_SLOW:
                options = ["--stepper", stepper, "--duration", OTHER_STEPPERS_S]
                print(f"{name} by {stepper}: {run(pleat, scene, options)}", flush=True)
    for scene in sorted((ROOT / "assets/deform").glob("*.json")):
        print(f"deform {scene.name}: {deform(pleat, scene)}", flush=True)


if __name__ == "__main__":
    main()
