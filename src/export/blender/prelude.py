import math
import os

import bmesh
import bpy
from mathutils import Matrix, Vector

# How often light is passed on: Softbox shows direct light only, as 0 does; Blender's own default is 12.
BOUNCES = 0

FOLDER = os.path.dirname(os.path.abspath(__file__))


def link(thing, matrix, surfaces=None):
    """Puts an object into the scene; a light that is linked lights only the surfaces of these names."""
    thing.matrix_world = Matrix(matrix)
    scene.collection.objects.link(thing)
    if surfaces is not None:
        LINKED.append((thing, surfaces))
    return thing


def nodes_of(owner):
    """An empty node tree of a material, light or world."""
    if bpy.app.version < (5, 0, 0) or owner.node_tree is None:
        owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree


def node(tree, kind, inputs=(), **properties):
    """A node; an input that is an output socket is linked, any other is a value."""
    new = tree.nodes.new(kind)
    for name, value in properties.items():
        setattr(new, name, value)
    for key, value in dict(inputs).items():
        if isinstance(value, bpy.types.NodeSocket):
            tree.links.new(value, new.inputs[key])
        else:
            new.inputs[key].default_value = value
    return new


def math_node(tree, operation, *inputs):
    """A number from one or two."""
    return node(tree, "ShaderNodeMath", dict(enumerate(inputs)), operation=operation).outputs[0]


def dot(tree, a, b):
    """The dot product of two vectors."""
    return node(tree, "ShaderNodeVectorMath", {0: a, 1: b}, operation="DOT_PRODUCT").outputs["Value"]


def polygons(name, points, faces, normals=None):
    """A mesh of corners and faces, smooth where it has normals at its faces' corners."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([Vector(point) for point in points], [], faces)
    if normals is not None:
        mesh.shade_smooth()
        mesh.normals_split_custom_set(normals)
    mesh.update()
    return mesh


def surface(name, mesh, material, matrix):
    """A thing that reflects."""
    thing = bpy.data.objects.new(name, mesh)
    thing.data.materials.append(MATERIALS[material])
    SURFACES.setdefault(name, []).append(link(thing, matrix))


def material(name, diffuse, specular, alpha):
    """Lambert's reflection, and Beckmann's microfacets of this slope."""
    MATERIALS[name] = bpy.data.materials.new(name)
    tree = nodes_of(MATERIALS[name])
    shader = node(tree, "ShaderNodeBsdfDiffuse", {"Color": (*diffuse, 1.0)})
    if any(specular):
        inputs = {"Color": (*specular, 1.0), "Roughness": math.sqrt(alpha)}
        gloss = node(tree, "ShaderNodeBsdfAnisotropic", inputs, distribution="BECKMANN")
        shader = node(tree, "ShaderNodeAddShader", {0: shader.outputs[0], 1: gloss.outputs[0]})
    node(tree, "ShaderNodeOutputMaterial", {"Surface": shader.outputs[0]})


def emitter(name, mesh, matrix, surfaces, radiance, two_sided=False, picture=None, axis=None, falloff=2.0):
    """A mesh that shines by its material. An axis makes a thin cylinder shine alike in all directions."""
    shader = bpy.data.materials.new(name)
    tree = nodes_of(shader)
    geometry = node(tree, "ShaderNodeNewGeometry")
    strength = 1.0 if two_sided else math_node(tree, "SUBTRACT", 1.0, geometry.outputs["Backfacing"])
    if axis is not None:
        cosine = dot(tree, geometry.outputs["Incoming"], axis)
        square = math_node(tree, "MINIMUM", math_node(tree, "MULTIPLY", cosine, cosine), 1.0 - 1e-6)
        sine = math_node(tree, "SQRT", math_node(tree, "SUBTRACT", 1.0, square))
        strength = math_node(tree, "DIVIDE", strength, sine)
    if falloff != 2.0:
        distance = node(tree, "ShaderNodeLightPath").outputs["Ray Length"]
        strength = math_node(tree, "MULTIPLY", strength, math_node(tree, "POWER", distance, 2.0 - falloff))
    # A colour's numbers are kept small, as a radiance may be beyond what Blender's colours hold.
    most = max(radiance)
    color = (*(channel / most if most > 0.0 else 0.0 for channel in radiance), 1.0)
    if picture is not None:
        image = bpy.data.images.load(os.path.join(FOLDER, picture))
        image.colorspace_settings.is_data = True
        color, most = node(tree, "ShaderNodeTexImage", image=image, interpolation="Closest").outputs["Color"], 1.0
    inputs = {"Color": color, "Strength": math_node(tree, "MULTIPLY", strength, most)}
    node(tree, "ShaderNodeOutputMaterial", {"Surface": node(tree, "ShaderNodeEmission", inputs).outputs[0]})
    thing = link(bpy.data.objects.new(name, mesh), matrix, surfaces)
    mesh.materials.append(shader)
    thing.visible_shadow = False


def lamp(name, kind, matrix, surfaces, power, **properties):
    """A lamp of Blender's; its colour and its power come from the power of each channel."""
    light = bpy.data.lights.new(name, kind)
    most = max(power)
    light.energy = most
    light.color = [channel / most if most > 0.0 else 1.0 for channel in power]
    for key, value in properties.items():
        setattr(light, key, value)
    link(bpy.data.objects.new(name, light), matrix, surfaces)
    return light


# What Cycles takes a watt for in photometric files, in lumens; a candela of theirs is 4 pi of it in a lamp's watts.
EFFICACY = 177.83


def web(name, matrix, surfaces, intensity, file):
    """A point lamp with a photometric file: its intensity is the greatest, which is 1 cd in the file."""
    power = [channel * EFFICACY for channel in intensity]
    light = lamp(name, "POINT", matrix, surfaces, power, shadow_soft_size=0.0)
    tree = nodes_of(light)
    away = node(tree, "ShaderNodeTexCoord").outputs["Normal"]
    x, y, z = node(tree, "ShaderNodeSeparateXYZ", {0: away}).outputs
    # Blender's half-planes begin at -Y and turn the other way: ours at +X.
    turned = {0: math_node(tree, "MULTIPLY", y, -1.0), 1: math_node(tree, "MULTIPLY", x, -1.0), 2: z}
    vector = node(tree, "ShaderNodeCombineXYZ", turned).outputs[0]
    path = os.path.join(FOLDER, file)
    share = node(tree, "ShaderNodeTexIES", {"Vector": vector}, mode="EXTERNAL", filepath=path).outputs["Fac"]
    shader = node(tree, "ShaderNodeEmission", {"Strength": share}).outputs[0]
    node(tree, "ShaderNodeOutputLight", {"Surface": shader})


def rectangle(name, size):
    """A rectangle that faces +Z, with the picture's coordinates."""
    x, y = 0.5 * size[0], 0.5 * size[1]
    mesh = polygons(name, [(-x, -y, 0.0), (x, -y, 0.0), (x, y, 0.0), (-x, y, 0.0)], [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new()
    for i, corner in enumerate([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]):
        layer.data[i].uv = corner
    return mesh


def ball(name, radius):
    """A smooth ball."""
    mesh = bpy.data.meshes.new(name)
    shape = bmesh.new()
    bmesh.ops.create_uvsphere(shape, u_segments=64, v_segments=32, radius=radius)
    shape.to_mesh(mesh)
    shape.free()
    mesh.shade_smooth()
    return mesh


def disk(name, radius, sides=256):
    """A disk that faces +Z, of the same area."""
    reach = radius * math.sqrt(2.0 * math.pi / (sides * math.sin(2.0 * math.pi / sides)))
    turns = [2.0 * math.pi * side / sides for side in range(sides)]
    return polygons(name, [(reach * math.cos(turn), reach * math.sin(turn), 0.0) for turn in turns], [range(sides)])


def cylinder(name, length, radius, sides=64):
    """A cylinder about X without caps, as wide around as a round one; in one piece, which Cycles samples best."""
    reach = radius * math.pi / (sides * math.sin(math.pi / sides))
    turns = [2.0 * math.pi * side / sides for side in range(sides)]
    ring = [(reach * math.cos(turn), reach * math.sin(turn)) for turn in turns]
    points = [(x, y, z) for x in (-0.5 * length, 0.5 * length) for y, z in ring]
    faces = [(i, sides + i, sides + (i + 1) % sides, (i + 1) % sides) for i in range(sides)]
    return polygons(name, points, faces)


def sky(zenith, radiance, uniform, cosine):
    """Adds a sky to the world: radiance times (uniform + cosine times the cosine from the zenith), none from below."""
    tree = scene.world.node_tree
    output = next(node for node in tree.nodes if node.type == "OUTPUT_WORLD")
    direction = node(tree, "ShaderNodeTexCoord").outputs["Generated"]
    height = dot(tree, direction, zenith)
    above = math_node(tree, "GREATER_THAN", height, 0.0)
    luminance = math_node(tree, "ADD", uniform, math_node(tree, "MULTIPLY", cosine, height))
    most = max(radiance)
    color = (*(channel / most for channel in radiance), 1.0)
    strength = math_node(tree, "MULTIPLY", math_node(tree, "MULTIPLY", above, luminance), most)
    shader = node(tree, "ShaderNodeBackground", {"Color": color, "Strength": strength}).outputs[0]
    if output.inputs["Surface"].is_linked:
        before = output.inputs["Surface"].links[0].from_socket
        shader = node(tree, "ShaderNodeAddShader", {0: before, 1: shader}).outputs[0]
    tree.links.new(shader, output.inputs["Surface"])


def link_lights():
    """Links lights to the surfaces that they light."""
    for thing, names in LINKED:
        receivers = bpy.data.collections.new(f"lit by {thing.name}")
        for name in names:
            for surface in SURFACES.get(name, []):
                receivers.objects.link(surface)
        thing.light_linking.receiver_collection = receivers


def camera(matrix, fov, width, height):
    """The camera, by its vertical field of view in radians, and the picture's size."""
    view = bpy.data.cameras.new("camera")
    view.sensor_fit = "VERTICAL"
    view.angle = fov
    scene.camera = link(bpy.data.objects.new("camera", view), matrix)
    scene.render.resolution_x = width
    scene.render.resolution_y = height
    scene.render.resolution_percentage = 100


def start(name, exposure):
    """A scene of its own, rendered by Cycles; what is open stays."""
    new = bpy.data.scenes.new(name)
    new.unit_settings.system = "METRIC"
    if bpy.context.window is not None:
        bpy.context.window.scene = new
    new.render.engine = "CYCLES"
    for bounces in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces"):
        setattr(new.cycles, bounces, BOUNCES)
    new.view_settings.view_transform = "Khronos PBR Neutral"
    # 100 cd/m² are white in Softbox.
    new.view_settings.exposure = exposure - math.log2(100.0)
    new.world = bpy.data.worlds.new(name)
    node(nodes_of(new.world), "ShaderNodeOutputWorld")
    return new


MATERIALS = {}
SURFACES = {}
LINKED = []
