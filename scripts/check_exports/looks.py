"""The highlights of each reflection model in Radiance, whose functions hold them: radiance against `softbox probe`."""

import with_radiance
from cases import HEAD, LIGHTS, POINTS
from lights import difference
from softbox import Softbox

# RMS of the difference, as a share of the radiance's own RMS.
BOUND = 0.01

EYE = (0.4, 0.9, 1.6)

MODELS = {
    "phong": "exponent = 20.0",
    "blinn": "exponent = 40.0\nmodel = { blinn = {} }",
    "cook-torrance": "model = { cook-torrance = { roughness = 0.3, reflectance = 0.4 } }",
    "lafortune": "exponent = 12.0\nmodel = { lafortune = { tangential = -0.9, normal = 1.0 } }",
}


def check(softbox: Softbox) -> list[str]:
    """What is wrong."""
    wrong = []
    for model, keys in MODELS.items():
        head = HEAD.format(name=model).replace("[0.5, 0.5, 0.5]", f"[0.1, 0.2, 0.3]\nspecular = [0.3, 0.2, 0.1]\n{keys}")
        scene = softbox.scene(f'{head}\n[[light]]\nname = "light"\n{LIGHTS["rectangle"]}\n')
        path = softbox.export(scene, "radiance", "look.rad")
        expected = softbox.probe(scene, POINTS, EYE)
        error = difference(with_radiance.radiance(path, EYE), expected)
        print(f"radiance: {model}: {100 * error:.2f} %")
        if error > BOUND:
            wrong.append(f"radiance: a {model} highlight is {100 * error:.3f} % off")
        # The same bound must see a highlight that is missing.
        without = softbox.probe(softbox.scene(scene.read_text().replace("specular = [0.3, 0.2, 0.1]", "")), POINTS, EYE)
        if difference(without, expected) <= 2.0 * BOUND:
            wrong.append(f"radiance: a missing {model} highlight is not seen")
    return wrong
