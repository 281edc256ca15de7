"""Illuminance in Mitsuba, from the radiance of the floor that was exported with the light."""

from pathlib import Path

import mitsuba
import numpy as np

from cases import DIFFUSE, POINTS, Case

SAMPLES = 4096
# Mitsuba does not aim at the bright parts of a pattern.
SAMPLES_OF_PATTERNS = 65536

mitsuba.set_variant("scalar_rgb")
mitsuba.set_log_level(mitsuba.LogLevel.Error)


def illuminance(path: Path, case: Case) -> np.ndarray:
    film = {"type": "hdrfilm", "height": 1, "rfilter": {"type": "box"}}
    meters = {
        f"meter {i:02}": {"type": "radiancemeter", "origin": [x, y, 0.02], "direction": [0, 0, -1], "film": film | {"width": 1}}
        for i, (x, y) in enumerate(POINTS)
    }
    samples = SAMPLES_OF_PATTERNS if case.light.startswith("textured") else SAMPLES
    sampler = {"type": "multijitter", "sample_count": samples}
    sensor = {"type": "batch", "film": film | {"width": len(POINTS), "pixel_format": "rgb"}, "sampler": sampler} | meters
    picture = mitsuba.render(mitsuba.load_file(str(path)), sensor=mitsuba.load_dict(sensor), spp=samples)
    return np.array(picture)[0] * np.pi / DIFFUSE


def faults(path: Path) -> list[str]:
    """What keeps Mitsuba from rendering a file."""
    picture = np.array(mitsuba.render(mitsuba.load_file(str(path)), spp=1))
    return [] if np.isfinite(picture).all() else ["its picture is not finite"]


def broken(text: str) -> str:
    return text.replace('type="perspective"', 'type="prespective"')
