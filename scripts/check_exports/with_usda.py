"""OpenUSD's own validators, and the illuminance by the lights of a stage as OpenUSD reads them, summed over small pieces as
the UsdLux schema means them."""

from pathlib import Path

import mitsuba
import numpy as np
from pxr import Usd, UsdGeom, UsdLux, UsdValidation

from cases import POINTS, Case

mitsuba.set_variant("scalar_rgb")

# Pieces of a light along each of its two directions.
PIECES = 192


def faults(path: Path) -> list[str]:
    """What the validators say, and where a light is scaled or its intensity is no luminance."""
    stage = Usd.Stage.Open(str(path))
    found = faults_of(stage)
    sets = [(prim.GetPath(), name) for prim in stage.Traverse() for name in prim.GetVariantSets().GetNames()]
    for path, name in sets:
        choice = stage.GetPrimAtPath(path).GetVariantSet(name)
        for variant in choice.GetVariantNames():
            choice.SetVariantSelection(variant)
            found += faults_of(stage)
    return found


def faults_of(stage: Usd.Stage) -> list[str]:
    """The same of the variants that are chosen."""
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    found = [f"{error.GetName()}: {error.GetMessage()}" for error in context.Validate(stage)]
    if UsdGeom.GetStageUpAxis(stage) != UsdGeom.Tokens.z or UsdGeom.GetStageMetersPerUnit(stage) != 1.0:
        found.append("the stage is not in metres, Z up")
    for prim in (prim for prim in stage.Traverse() if prim.HasAPI(UsdLux.LightAPI)):
        light = UsdLux.LightAPI(prim)
        if not np.allclose(np.linalg.norm(matrix_of(prim)[:3, :3], axis=1), 1.0):
            found.append(f"{prim.GetPath()}: is scaled")
        if light.GetNormalizeAttr().Get() or not light.GetIntensityAttr().HasAuthoredValue():
            found.append(f"{prim.GetPath()}: its intensity is no luminance")
    return found


def broken(text: str) -> str:
    return text.replace("metersPerUnit = 1\n", "metersPerUnit = 0\n").replace('defaultPrim = "World"', "")


def centers(count: int) -> np.ndarray:
    """The middles of equal pieces of 0…1."""
    return (np.arange(count) + 0.5) / count


def grid(columns: int, rows: int) -> tuple[np.ndarray, np.ndarray]:
    u, v = np.meshgrid(centers(columns), centers(rows))
    return u.ravel(), v.ravel()


def matrix_of(prim: Usd.Prim) -> np.ndarray:
    """From the prim's frame to the stage's; acts on row vectors."""
    return np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default()))


def radiance(prim: Usd.Prim) -> np.ndarray:
    light = UsdLux.LightAPI(prim)
    assert not light.GetNormalizeAttr().Get(), "normalized"
    scale = light.GetIntensityAttr().Get() * 2.0 ** light.GetExposureAttr().Get()
    return scale * np.array(light.GetColorAttr().Get())


def texture(prim: Usd.Prim) -> np.ndarray | None:
    """Its picture, linear."""
    attribute = prim.GetAttribute("inputs:texture:file")
    asset = attribute.Get() if attribute else None
    return np.array(mitsuba.Bitmap(asset.resolvedPath))[..., :3] if asset else None


def looked_up(picture: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    rows, columns, _ = picture.shape
    return picture[np.minimum((v * rows).astype(int), rows - 1), np.minimum((u * columns).astype(int), columns - 1)]


def get(prim: Usd.Prim, name: str) -> float:
    return prim.GetAttribute(f"inputs:{name}").Get()


def surface(prim: Usd.Prim) -> tuple[np.ndarray, ...]:
    """Places, normals, areas and shares of the radiance of a light's pieces, in its own frame."""
    kind = prim.GetTypeName()
    u, v = grid(PIECES, PIECES)
    down = np.tile([0.0, 0.0, -1.0], (u.size, 1))
    one = np.ones((u.size, 3))
    if kind == "RectLight":
        width, height = get(prim, "width"), get(prim, "height")
        # The picture's first texel is at +X and +Y.
        places = np.stack([(0.5 - u) * width, (0.5 - v) * height, 0.0 * u], 1)
        picture = texture(prim)
        shares = one if picture is None else looked_up(picture, u, v)
        return places, down, np.full(u.size, width * height / u.size), shares
    if kind == "DiskLight":
        radius = get(prim, "radius") * np.sqrt(u)
        places = np.stack([radius * np.cos(2 * np.pi * v), radius * np.sin(2 * np.pi * v), 0.0 * u], 1)
        return places, down, np.full(u.size, np.pi * get(prim, "radius") ** 2 / u.size), one
    if kind == "SphereLight":
        radius, z = get(prim, "radius"), 2.0 * u - 1.0
        ring = np.sqrt(1.0 - z * z)
        normals = np.stack([ring * np.cos(2 * np.pi * v), ring * np.sin(2 * np.pi * v), z], 1)
        return radius * normals, normals, np.full(u.size, 4 * np.pi * radius**2 / u.size), one
    if kind == "CylinderLight":
        radius, length = get(prim, "radius"), get(prim, "length")
        normals = np.stack([0.0 * u, np.cos(2 * np.pi * v), np.sin(2 * np.pi * v)], 1)
        places = radius * normals + np.stack([(u - 0.5) * length, 0.0 * u, 0.0 * u], 1)
        return places, normals, np.full(u.size, 2 * np.pi * radius * length / u.size), one
    assert kind == "Mesh" and prim.HasAPI(UsdLux.MeshLightAPI), kind
    return mesh(UsdGeom.Mesh(prim))


def mesh(prim: UsdGeom.Mesh) -> tuple[np.ndarray, ...]:
    """As `surface`, of triangles that shine to where they turn counter-clockwise."""
    points = np.array(prim.GetPointsAttr().Get(), dtype=float)
    faces = np.array(prim.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    u, v = grid(PIECES, PIECES)
    # Even in area over a triangle.
    a, b = 1.0 - np.sqrt(u), v * np.sqrt(u)
    parts = []
    for corner, second, third in points[faces]:
        across = np.cross(second - corner, third - corner)
        area = 0.5 * np.linalg.norm(across)
        places = np.outer(a, corner) + np.outer(b, second) + np.outer(1.0 - a - b, third)
        normals = np.tile(across / (2.0 * area), (u.size, 1))
        parts.append((places, normals, np.full(u.size, area / u.size), np.ones((u.size, 3))))
    return tuple(np.concatenate(part) for part in zip(*parts))


def profile(prim: Usd.Prim, ways: np.ndarray) -> np.ndarray:
    """Candelas of a light's IES file in directions of its own frame; 1 without one. Nadir is -Z, C = 0 at +X."""
    attribute = prim.GetAttribute("inputs:shaping:ies:file")
    asset = attribute.Get() if attribute else None
    if not asset:
        return np.ones(len(ways))
    numbers = [float(word) for word in Path(asset.resolvedPath).read_text().split("TILT=NONE")[1].split()]
    rows, planes = int(numbers[3]), int(numbers[4])
    gammas, turns, candelas = np.split(np.array(numbers[13 : 13 + rows + planes + rows * planes]), [rows, rows + planes])
    candelas = numbers[2] * candelas.reshape(planes, rows)
    gamma = np.degrees(np.arctan2(np.hypot(ways[:, 0], ways[:, 1]), -ways[:, 2]))
    turn = np.degrees(np.arctan2(ways[:, 1], ways[:, 0])) % 360.0
    by_plane = np.array([np.interp(gamma, gammas, plane, right=0.0) for plane in candelas])
    if planes == 1:
        return by_plane[0]
    return np.array([np.interp(t, turns, by_plane[:, i]) for i, t in enumerate(turn)])


def directions(prim: Usd.Prim) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Directions to a light that is infinitely far, their solid angles and shares of the radiance, in its own frame."""
    u, v = grid(4 * PIECES, 2 * PIECES)
    if prim.GetTypeName() == "DistantLight":
        half = np.radians(0.5 * get(prim, "angle"))
        if half == 0.0:
            return np.array([[0.0, 0.0, 1.0]]), np.ones(1), np.ones((1, 3))
        cosine = 1.0 - u * (1.0 - np.cos(half))
        ring = np.sqrt(np.maximum(1.0 - cosine**2, 0.0))
        ways = np.stack([ring * np.cos(2 * np.pi * v), ring * np.sin(2 * np.pi * v), cosine], 1)
        return ways, np.full(u.size, 2 * np.pi * (1.0 - np.cos(half)) / u.size), np.ones((u.size, 3))
    # By latitude and longitude: the top is +Y, the middle +Z, the left half +X.
    polar, around = np.pi * v, 2.0 * np.pi * (0.5 - u)
    ways = np.stack([np.sin(polar) * np.sin(around), np.cos(polar), np.sin(polar) * np.cos(around)], 1)
    angles = 2.0 * np.pi**2 / u.size * np.sin(polar)
    return ways, angles, looked_up(texture(prim), u, v)


def is_open(box: np.ndarray | None, start: np.ndarray, ways: np.ndarray, reach: np.ndarray) -> np.ndarray:
    """Where the unit cube does not come between; `box` takes the stage's frame to the cube's."""
    if box is None:
        return np.ones(len(ways))
    here, along = start @ box[:3, :3] + box[3, :3], ways @ box[:3, :3]
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = np.stack([(-0.5 - here) / along, (0.5 - here) / along])
    enter, leave = ends.min(0).max(1), ends.max(0).min(1)
    return ~((enter < leave) & (leave > 0.0) & (enter < reach))


def illuminance(path: Path, case: Case) -> np.ndarray:
    stage = Usd.Stage.Open(str(path))
    cubes = [prim for prim in stage.Traverse() if prim.GetTypeName() == "Cube"]
    assert len(cubes) == int(case.shadowed), "its box"
    box = np.linalg.inv(matrix_of(cubes[0])) if cubes else None
    sum_ = np.zeros((len(POINTS), 3))
    for prim in stage.Traverse():
        if not prim.HasAPI(UsdLux.LightAPI):
            continue
        matrix, level = matrix_of(prim), radiance(prim)
        turn = matrix[:3, :3]
        is_far = prim.GetTypeName() in ("DistantLight", "DomeLight")
        if is_far:
            ways, angles, shares = directions(prim)
            ways = ways @ turn
        else:
            places, normals, areas, shares = surface(prim)
            places, normals = places @ turn + matrix[3, :3], normals @ turn
        for i, (x, y) in enumerate(POINTS):
            start = np.array([x, y, 0.0])
            if is_far:
                weights, reach = angles * np.maximum(ways[:, 2], 0.0), np.full(len(ways), np.inf)
                towards = ways
            else:
                way = places - start
                reach = np.linalg.norm(way, axis=1)
                towards = way / reach[:, None]
                faces = np.maximum(-(towards * normals).sum(1), 0.0)
                if prim.GetAttribute("inputs:shaping:ies:file"):
                    # One direction for all of the little ball.
                    middle = -way.mean(0) @ np.linalg.inv(turn)
                    faces = faces * profile(prim, middle[None])[0]
                weights = areas * faces * np.maximum(towards[:, 2], 0.0) / reach**2
            weights = weights * is_open(box, start, towards, reach)
            sum_[i] += level * (weights @ shares)
    return sum_
