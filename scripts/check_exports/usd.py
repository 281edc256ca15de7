"""Hold exported .usda files to OpenUSD's own validators, and their lights to what UsdLux says of them.

usage: usd.py FILE...   (needs usd-core from PyPI)
"""

import sys

from pxr import Usd, UsdGeom, UsdLux, UsdValidation


def faults(path):
    """What is wrong with a file: one line each."""
    stage = Usd.Stage.Open(path)
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    for error in context.Validate(stage):
        yield f"{error.GetName()}: {error.GetMessage()}"
    if UsdGeom.GetStageUpAxis(stage) != UsdGeom.Tokens.z or UsdGeom.GetStageMetersPerUnit(stage) != 1.0:
        yield "the stage is not in metres, Z up"
    for prim in stage.Traverse():
        if not prim.HasAPI(UsdLux.LightAPI):
            continue
        light = UsdLux.LightAPI(prim)
        matrix = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default())
        rows = [matrix.GetRow3(i).GetLength() for i in range(3)]
        if any(abs(length - 1.0) > 1e-9 for length in rows):
            yield f"{prim.GetPath()}: is scaled by {rows}"
        if light.GetNormalizeAttr().Get() or not light.GetIntensityAttr().HasAuthoredValue():
            yield f"{prim.GetPath()}: its intensity is no luminance"


def main(paths):
    wrong = False
    for path in paths:
        for fault in faults(path):
            print(f"{path}: {fault}")
            wrong = True
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
