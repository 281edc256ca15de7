"""The same light in another renderer: illuminance along a line against `softbox probe`."""

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cases import POINTS, Case, cases
from softbox import Softbox

# RMS of the difference, as a share of the illuminance's own RMS.
OPEN = 0.005
SHADOWED = 0.01

PATTERNS = {
    "asymmetric": [[(255, 255, 255), (120, 120, 120)], [(180, 180, 180), (0, 0, 0)]],
    "colour": [[(255, 20, 0), (120, 255, 0), (0, 200, 90)], [(180, 0, 220), (0, 0, 0), (255, 255, 255)]],
}

# Candela of a lamp without symmetry, by planes of 90 degrees.
LAMP = """IESNA:LM-63-2002
TILT=NONE
1 -1 1 5 5 1 2 0 0 0
1 1 0
0 20 40 60 90
0 90 180 270 360
1000 900 700 300 100
1000 800 400 200 50
1000 950 800 700 300
1000 600 300 100 0
1000 900 700 300 100
"""

# What a target says that it cannot hold; all else must be there.
LOST = {
    "usda": {"line-falloff-1"},
    "mitsuba": {"line-falloff-1"},
    "radiance": set(),
    "blender": set(),
}


@dataclass(frozen=True)
class Row:
    """What a case measured; no error where the target said that it could not hold it."""

    target: str
    case: Case
    error: float | None

    @property
    def is_right(self) -> bool:
        if self.case.light in LOST[self.target]:
            return self.error is None
        return self.error is not None and self.error <= (SHADOWED if self.case.shadowed else OPEN)


def png(path: Path, rows) -> None:
    """Writes a picture of 8 bits a channel."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    data = b"".join(b"\0" + bytes(channel for texel in row for channel in texel) for row in rows)
    path.parent.mkdir(exist_ok=True)
    chunks = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunks)


def difference(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.sqrt(((found - expected) ** 2).mean() / (expected**2).mean()))


def check(softbox: Softbox, target: str, extension: str, illuminance) -> tuple[list[Row], list[str]]:
    """Compares every case; `illuminance` renders the file of a case. Gives what it measured, and what is wrong."""
    for name, rows in PATTERNS.items():
        png(softbox.work / f"textures/{name}.png", rows)
    (softbox.work / "lamp.ies").write_text(LAMP)
    measured, wrong = [], []
    for case in cases():
        scene = softbox.scene(case.toml())
        path = softbox.export(scene, target, f"light.{extension}")
        error = None if path is None else difference(illuminance(path, case), softbox.probe(scene, POINTS))
        measured.append(Row(target, case, error))
        if not measured[-1].is_right:
            wrong.append(f"{target}: {case.name}: {'is lost' if error is None else f'{100 * error:.3f} % off'}")
    return measured, wrong + plants(softbox, target, extension, illuminance)


def plants(softbox: Softbox, target: str, extension: str, illuminance) -> list[str]:
    """Files that are not those of the scene: a mirrored pattern and a light brighter by 2 %, which must be seen."""
    pattern = softbox.work / "textures/asymmetric.png"
    mirrored = [row[::-1] for row in PATTERNS["asymmetric"]]
    plain = Case("textured", False)
    brighter = plain.toml().replace("luminance = 1000.0", "luminance = 1020.0")
    wrong = []
    for what, rows, text in [("a mirrored pattern", mirrored, plain.toml()), ("2 % more", PATTERNS["asymmetric"], brighter)]:
        png(pattern, rows)
        found = illuminance(softbox.export(softbox.scene(text), target, f"planted.{extension}"), plain)
        png(pattern, PATTERNS["asymmetric"])
        if difference(found, softbox.probe(softbox.scene(plain.toml()), POINTS)) <= 2.0 * OPEN:
            wrong.append(f"{target}: {what} is not seen")
    return wrong
