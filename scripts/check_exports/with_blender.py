"""Illuminance in Blender's Cycles, from a picture of the floor that the exported script builds with the light."""

from pathlib import Path

import bpy
import numpy as np

from cases import DIFFUSE, POINTS, Case

SAMPLES = 8192

# Blender's pictures have four rows or more; the middle one is rendered.
ROWS = 5


def build(path: Path):
    """The scene that a script builds in an empty Blender."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="cycles")
    script = {"__name__": "__main__", "__file__": str(path)}
    exec(compile(path.read_text(), str(path), "exec"), script)
    return script["scene"]


def illuminance(path: Path, case: Case) -> np.ndarray:
    scene = build(path)
    look_down(scene)
    scene.cycles.samples = SAMPLES
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.light_sampling_threshold = 0.0
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path.with_suffix(".exr"))
    bpy.ops.render.render(write_still=True, scene=scene.name)
    picture = bpy.data.images.load(scene.render.filepath)
    pixels = np.array(picture.pixels[:]).reshape(ROWS, len(POINTS), picture.channels)
    return pixels[ROWS // 2, :, :3] * np.pi / DIFFUSE


def look_down(scene) -> None:
    """A camera just over the floor, each of whose pixels sees one of the points."""
    (first, y), (last, _) = POINTS[0], POINTS[-1]
    camera = bpy.data.cameras.new("meter")
    camera.type = "ORTHO"
    camera.sensor_fit = "HORIZONTAL"
    camera.ortho_scale = (last - first) * len(POINTS) / (len(POINTS) - 1)
    camera.clip_start = 1e-3
    scene.camera = bpy.data.objects.new("meter", camera)
    scene.camera.location = (0.5 * (first + last), y, 0.02)
    scene.collection.objects.link(scene.camera)
    scene.render.resolution_x, scene.render.resolution_y = len(POINTS), ROWS
    scene.render.use_border = True
    scene.render.border_min_y, scene.render.border_max_y = (ROWS // 2) / ROWS, (ROWS // 2 + 1) / ROWS
    scene.cycles.pixel_filter_type = "GAUSSIAN"
    scene.cycles.filter_width = 0.01


def faults(path: Path) -> list[str]:
    """What keeps Blender from running a script."""
    scene = build(path)
    skies = [node for node in scene.world.node_tree.nodes if node.type == "BACKGROUND"]
    is_whole = scene.camera is not None and len(scene.objects) + len(skies) > 1
    return [] if is_whole else ["its scene is empty"]


def broken(text: str) -> str:
    return text.replace("\nscene = start(", "\nscene = stort(")
