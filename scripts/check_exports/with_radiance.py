"""Illuminance in Radiance, by its own rtrace."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pyradiance

from cases import POINTS, Case

# Lumens that Radiance takes a watt for.
EFFICACY = 179.0

# The mean of many rays that are aimed at a light's parts; or one of many that are not aimed.
AIMED = 256, "-ab 0 -dj 0.7 -ds 0.02 -dt 0 -dc 1"
CENTRED = 1, "-ab 0 -dj 0 -ds 0.02 -dt 0 -dc 1"
FOUND = 1, "-ab 1 -ad 65536 -as 0 -aa 0 -lw 1e-9"

# Radiance aims at a disk or ball as at a square, and blends the colours of what it aims at: with shadows or colours, rays
# that are not aimed must find them, for which the file's `light` becomes `glow`.
NOT_AIMED_WITH_SHADOWS = ("rectangle", "disk", "sphere", "textured")

FOLDER = Path(pyradiance.__file__).parent
ENVIRONMENT = os.environ | {"RAYPATH": f".:{FOLDER / 'lib'}", "PATH": f"{FOLDER / 'bin'}:{os.environ['PATH']}"}


def run(program: str, *arguments: str, folder: Path, data: bytes = b"") -> bytes:
    done = subprocess.run(
        [program, *arguments], cwd=folder, env=ENVIRONMENT, input=data, capture_output=True, timeout=120
    )
    if done.returncode != 0:
        raise RuntimeError(done.stderr.decode())
    return done.stdout


def trace(path: Path, rays: list[str], options: str) -> np.ndarray:
    octree = path.with_suffix(".oct")
    octree.write_bytes(run("oconv", path.name, folder=path.parent))
    data = "".join(f"{ray}\n" for ray in rays).encode()
    lines = run("rtrace", "-h", "-ov", "-u+", *options.split(), octree.name, folder=path.parent, data=data)
    return EFFICACY * np.array([[float(number) for number in line.split()] for line in lines.decode().splitlines()])


def illuminance(path: Path, case: Case) -> np.ndarray:
    text = path.read_text()
    if case.light == "textured-colour" or (case.shadowed and case.light.startswith(NOT_AIMED_WITH_SHADOWS)):
        text = re.sub(r"^(\S+) light (\S+)\n0\n0\n3 (.*)$", r"\1 glow \2\n0\n0\n4 \3 0", text, flags=re.MULTILINE)
        path.write_text(text)
    repeats, options = CENTRED if case.light == "sphere" else AIMED
    if re.search(r"^\S+ glow ", text, flags=re.MULTILINE):
        repeats, options = FOUND
    rays = [f"{x} {y} 1e-4 0 0 1" for x, y in POINTS for _ in range(repeats)]
    return trace(path, rays, f"-I {options}").reshape(len(POINTS), repeats, 3).mean(axis=1)


def radiance(path: Path, eye, repeats: int = 256) -> np.ndarray:
    """What an eye sees of the floor."""
    rays = [f"{eye[0]} {eye[1]} {eye[2]} {x - eye[0]} {y - eye[1]} {-eye[2]}" for x, y in POINTS for _ in range(repeats)]
    return trace(path, rays, AIMED[1]).reshape(len(POINTS), repeats, 3).mean(axis=1)


def faults(path: Path) -> list[str]:
    """What keeps Radiance from rendering a file by its view."""
    view = next(path.parent.glob(f"{path.stem}-view.vf"))
    octree = path.with_suffix(".oct")
    octree.write_bytes(run("oconv", path.name, folder=path.parent))
    run("rpict", "-w", "-x", "64", "-y", "48", "-ab", "0", "-vf", view.name, octree.name, folder=path.parent)
    return []


def broken(text: str) -> str:
    return text.replace(" polygon ", " poligon ").replace(" source ", " sauce ").replace(" sphere ", " spear ")
