"""Softbox on the command line."""

import csv
import io
import subprocess
from pathlib import Path

import numpy as np

# Of pictures, where a file says one.
SIZE = "64x48"


class Softbox:
    """The program, and the folder where it works."""

    def __init__(self, program: Path, work: Path):
        self.program = program
        self.work = work
        work.mkdir(parents=True, exist_ok=True)

    def run(self, *arguments, text: str = "") -> subprocess.CompletedProcess:
        command = [str(self.program), *map(str, arguments)]
        return subprocess.run(command, input=text, capture_output=True, text=True, timeout=120)

    def scene(self, text: str, name: str = "scene.toml") -> Path:
        path = self.work / name
        path.write_text(text)
        return path

    def probe(self, scene: Path, points: list[tuple[float, float]], eye=None) -> np.ndarray:
        """Irradiance at points on the floor, or, for an eye, the radiance that it sees there: a row a point."""
        rows = ["x,y,z,nx,ny,nz,vx,vy,vz"]
        for x, y in points:
            view = (0.0, 0.0, 1.0) if eye is None else (eye[0] - x, eye[1] - y, eye[2])
            rows.append(f"{x},{y},0,0,0,1,{view[0]},{view[1]},{view[2]}")
        done = self.run("probe", scene, "--points", "-", text="\n".join(rows) + "\n")
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        what = "irradiance" if eye is None else "radiance"
        rows = csv.DictReader(io.StringIO(done.stdout))
        return np.array([[float(row[f"{what}_{channel}"]) for channel in "rgb"] for row in rows])

    def export(self, scene: Path, target: str, output: str, allow_loss: bool = False) -> Path | None:
        """The main file, or none where the target says that it would lose something."""
        path = self.work / output
        path.unlink(missing_ok=True)
        done = self.run("export", scene, "--to", target, "-o", path, "--size", SIZE, *["--allow-loss"] * allow_loss)
        if done.returncode == 0:
            return path
        if "would be lost" not in done.stderr or path.exists():
            raise RuntimeError(done.stderr)
        return None
