"""Every preset and a scene of variants in every format: does the program that reads it find fault with the file?"""

from pathlib import Path

from softbox import Softbox

FOLDER = Path(__file__).parents[2] / "presets"

# Lights linked to surfaces, and in several states.
VARIANTS = Path(__file__).parents[2] / "tests/data/evening.toml"


def check(softbox: Softbox, target: str, extension: str, faults, broken) -> list[str]:
    """What `faults` finds in the files of a target; `broken` damages a file's text, which must be seen."""
    wrong, last = [], None
    for scene in [VARIANTS, *sorted(FOLDER.glob("*/*.toml"))]:
        path = softbox.export(scene, target, f"{scene.parent.name}-{scene.stem}.{extension}", allow_loss=True)
        wrong += [f"{target}: {scene.stem}: {fault}" for fault in faults_of(path, faults)]
        last = path
    if last is None:
        return [f"{target}: no presets"]
    text = last.read_text()
    damaged = broken(text)
    last.write_text(damaged)
    if damaged == text or not faults_of(last, faults):
        wrong.append(f"{target}: a broken file is not seen")
    return wrong


def faults_of(path: Path, faults) -> list[str]:
    try:
        return list(faults(path))
    except Exception as error:  # Whatever a reader raises is a fault of the file.
        return [f"{type(error).__name__}: {error}"]
