"""The scenes that are compared: one light each over a floor, alone and with a turned box in its way."""

from dataclasses import dataclass

# Of the floor.
DIFFUSE = 0.5

HEAD = """format = 1
name = "{name}"

[[material]]
name = "floor"
diffuse = [0.5, 0.5, 0.5]

[[surface]]
name = "floor"
material = "floor"
shape = {{ plane = {{}} }}
"""

BOX = """
[[surface]]
name = "box"
material = "floor"
position = [0.25, 0.35, 0.6]
rotation_deg = [0.0, 0.0, 30.0]
shape = { box = { size = [0.5, 0.3, 0.4] } }
"""

# Along x, at this y, on the floor.
POINTS = [(-2.0 + 0.1 * i, 0.2) for i in range(41)]

TILTED = 'position = [0.3, -0.2, 1.9]\nrotation_deg = [12.0, -18.0, 25.0]\n'
CONCAVE = "[[-0.6, -0.5], [0.7, -0.5], [0.7, 0.0], [0.1, 0.1], [0.0, 0.6], [-0.6, 0.6]]"
RECTANGLE = "[[-0.8, -0.4], [0.8, -0.4], [0.8, 0.4], [-0.8, 0.4]]"
PATTERN = 'size = [1.6, 0.9], pattern = "textures/asymmetric.png"'
COLOR = 'size = [1.6, 0.9], pattern = "textures/colour.png"'

LIGHTS = {
    "rectangle": TILTED + f"luminance = 1000.0\nshape = {{ polygon = {{ vertices = {RECTANGLE} }} }}",
    "rectangle-tinted": TILTED + "color = [1.0, 0.6, 0.2]\n"
    f"luminance = 1000.0\nshape = {{ polygon = {{ vertices = {RECTANGLE} }} }}",
    "rectangle-two-sided": "position = [0.0, 0.9, 1.2]\nrotation_deg = [100.0, 0.0, 10.0]\n"
    f"luminance = 1000.0\nshape = {{ polygon = {{ two_sided = true, vertices = {RECTANGLE} }} }}",
    "polygon-concave": TILTED + f"luminance = 1000.0\nshape = {{ polygon = {{ vertices = {CONCAVE} }} }}",
    "polygon-two-sided": "position = [0.0, 0.9, 1.2]\nrotation_deg = [80.0, 0.0, 10.0]\n"
    f"luminance = 1000.0\nshape = {{ polygon = {{ two_sided = true, vertices = {CONCAVE} }} }}",
    "disk": TILTED + "luminance = 1000.0\nshape = { disk = { radius = 0.45 } }",
    "disk-two-sided": "position = [0.0, 0.9, 1.3]\nrotation_deg = [100.0, 10.0, 10.0]\n"
    "luminance = 1000.0\nshape = { disk = { radius = 0.45, two_sided = true } }",
    "textured": TILTED + f"luminance = 1000.0\nshape = {{ textured = {{ {PATTERN} }} }}",
    "textured-colour": TILTED + f"luminance = 1000.0\nshape = {{ textured = {{ {COLOR} }} }}",
    "textured-two-sided": "position = [0.0, 0.9, 1.2]\nrotation_deg = [100.0, 0.0, 10.0]\n"
    f"luminance = 1000.0\nshape = {{ textured = {{ two_sided = true, {PATTERN} }} }}",
    "sphere": "position = [0.2, -0.1, 2.0]\nluminance = 1000.0\nshape = { sphere = { radius = 0.25 } }",
    "tube": TILTED + 'luminance = 100000.0\nshape = { line = { length = 1.5, emission = "tube", radius = 0.001 } }',
    "line": TILTED + "intensity_per_metre = 200.0\nshape = { line = { length = 1.5 } }",
    "line-falloff-1": TILTED + "intensity_per_metre = 200.0\nshape = { line = { length = 1.5, falloff = 1.0 } }",
    "cap-sun": "rotation_deg = [30.0, 20.0, 0.0]\nilluminance = 1000.0\nshape = { cap = { half_angle_deg = 0.27 } }",
    "cap": "rotation_deg = [30.0, 20.0, 0.0]\nluminance = 1000.0\nshape = { cap = { half_angle_deg = 30.0 } }",
    "cap-wide": "rotation_deg = [30.0, 20.0, 0.0]\nluminance = 1000.0\nshape = { cap = { half_angle_deg = 85.0 } }",
    "sky": "luminance = 1000.0\nshape = { sky = { uniform = 0.3333333333333333, cosine = 0.6666666666666666 } }",
    "sky-tilted": "rotation_deg = [40.0, 10.0, 0.0]\nluminance = 1000.0\nshape = { sky = { uniform = 0.2, cosine = 0.8 } }",
    "point": "position = [0.3, -0.2, 1.9]\nintensity = 100.0\nshape = { point = {} }",
    "point-ies": TILTED + 'intensity = 100.0\nshape = { point = { ies = "lamp.ies" } }',
    "directional": "rotation_deg = [20.0, -25.0, 0.0]\nilluminance = 100.0\nshape = { directional = {} }",
}


@dataclass(frozen=True)
class Case:
    light: str
    shadowed: bool

    @property
    def name(self) -> str:
        return f"{self.light}{' with a box' if self.shadowed else ''}"

    def toml(self) -> str:
        box = BOX if self.shadowed else ""
        return f'{HEAD.format(name=self.name)}{box}\n[[light]]\nname = "{self.light}"\n{LIGHTS[self.light]}\n'


def cases() -> list[Case]:
    return [Case(light, shadowed) for light in LIGHTS for shadowed in (False, True)]
