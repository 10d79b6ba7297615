"""Renders frames of a particle cache with Blender's Cycles. Started by the script `render` beside this file.

Snow is drawn as grains: every particle becomes a handful of small balls scattered through the volume that the
particle stands for, so cracks, chunks and debris are those of the simulation and only the texture below the particle
spacing is invented. Sand is drawn as grains too. All else is drawn as surfaces, one colour per piece from left to
right. Planes and boxes among the scene's colliders are drawn where the scene puts them, the cones that a difference
leaves hollow as glass. The axes are the scene's: y is up.
"""

import argparse
import math
import os
import sys
import tomllib
from pathlib import Path

import _cycles
import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # Blender has another
from render_objects import SKY, balls_object, fade, material, mesh_object  # noqa: E402
from render_points import SCRATCH, neighbours, pieces, read_cache, read_ply, tool, write_ply  # noqa: E402
from render_views import BODY_COLOURS, COLOURS, VIEWS  # noqa: E402


def arguments():
    def triple(text):
        x, y, z = (float(part) for part in text.split(","))
        return x, y, z

    def size(text):
        width, height = (int(part) for part in text.split("x"))
        return width, height

    p = argparse.ArgumentParser(prog="render", description="A picture of one frame, or several side by side.")
    p.add_argument("cache", nargs="+", type=Path, help="particles.NNNN.vdb, one for each panel")
    p.add_argument("out", type=Path, help=".jpg or .png")
    p.add_argument("--scene", type=Path, required=True, help="the scene file that made the cache")
    p.add_argument("--size", type=size, default=(960, 540), metavar="WxH", help="of one panel (%(default)s)")
    p.add_argument("--samples", type=int, default=192, help="paths a pixel (%(default)s)")
    p.add_argument("--quality", type=int, default=88, help="of a .jpg (%(default)s)")
    p.add_argument("--eye", type=triple, metavar="X,Y,Z", help="where the camera is")
    p.add_argument("--target", type=triple, metavar="X,Y,Z", help="what it looks at")
    p.add_argument("--lens", type=float, help="mm, of a 36 mm sensor")
    p.add_argument("--exposure", type=float, default=0.0, help="stops (%(default)s)")
    try:
        return p.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    except SystemExit as e:  # of --help or a mistake, printed already
        sys.stdout.flush()
        os._exit(e.code)


def grains(points, spacing, surface):
    rng = np.random.default_rng(1)

    def in_ball(n, radius):
        direction = rng.normal(size=(n, 3))
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        return direction * (radius * rng.random((n, 1)) ** (1 / 3))

    # A particle alone in the air is a small clod; among its like it fills its share of the volume.
    size = spacing * np.interp(neighbours(points, 1.5 * spacing), (4, 30), (0.5, 1.0))
    many = 60
    small = np.repeat(points, many, axis=0) + in_ball(len(points) * many, 0.76) * np.repeat(size, many)[:, None]
    radii = np.repeat(size, many) * (0.06 + 0.12 * rng.random(len(small)) ** 3)
    hearts = points + in_ball(len(points), 0.25) * size[:, None]
    heart_radii = size * (0.33 + 0.12 * rng.random(len(hearts)))
    balls_object("grains", np.concatenate([hearts, small]), np.concatenate([heart_radii, radii]), surface)


def rubber(points, spacing, colours):
    groups = [g for g in pieces(points, 1.5 * spacing) if len(g) > 8]
    for i, group in enumerate(sorted(groups, key=lambda g: g[:, 0].mean())):
        write_ply(SCRATCH / "piece.ply", group)
        # Balls that overlap well, grown together, smoothed, and shrunk to half a spacing beyond the outer particles.
        voxel = spacing / 3
        tool(
            "vdb_tool", "-read", SCRATCH / "piece.ply", "-points2ls", f"voxel={voxel}", "radius=3", "width=4",
            "-dilate", "radius=1.5", "-gauss", "iter=4", "size=2", "-erode", "radius=3",
            "-ls2mesh", "adapt=0", "-write", SCRATCH / "surface.ply",
        )  # fmt: skip
        colour = colours[i % len(colours)]
        look = material(f"rubber {i}", colour, roughness=0.38, specular=0.5)
        mesh_object(f"piece {i}", *read_ply(SCRATCH / "surface.ply"), look, smooth=True)


def glass(cones):
    """The mantles of cones on the y axis, but for what lies in another of them."""
    surface = bpy.data.materials.new("glass")
    surface.use_nodes = True
    nodes, links = surface.node_tree.nodes, surface.node_tree.links
    rim = nodes.new("ShaderNodeLayerWeight")
    rim.inputs["Blend"].default_value = 0.25
    shine, mix = nodes.new("ShaderNodeBsdfGlossy"), nodes.new("ShaderNodeMixShader")
    shine.inputs["Roughness"].default_value = 0.08
    links.new(rim.outputs["Facing"], mix.inputs["Fac"])
    links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[1])
    links.new(shine.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], nodes["Material Output"].inputs["Surface"])

    def radius(cone, y):
        return cone["radius"] * max((cone["apex"][1] - y) / (cone["apex"][1] - cone["base"][1]), 0)

    angles = np.linspace(0, 2 * math.pi, 96, endpoint=False)
    for cone in cones:
        rings = []
        for y in np.linspace(cone["base"][1], cone["apex"][1], 200):
            r = radius(cone, y)
            if all(r >= radius(other, y) for other in cones):
                rings.append(np.stack([r * np.cos(angles), np.full(96, y), r * np.sin(angles)], axis=1))
        here = np.arange(96)
        ring = np.stack([here, np.roll(here, -1), np.roll(here, -1) + 96, here + 96], axis=1)
        quads = np.concatenate([ring + 96 * k for k in range(len(rings) - 1)]).astype(np.int32)
        mesh_object("glass", np.concatenate(rings), [quads], surface, smooth=True)


def motion(collider, time):
    """What key frames do to a collider, linear in between: places it as the simulation does."""
    keys = collider.get("keyframes", [])
    if not keys:
        return Matrix()

    def at(name):
        return [np.interp(time, [k["time"] for k in keys], [k.get(name, (0, 0, 0))[a] for k in keys]) for a in range(3)]

    turn = Euler([math.radians(a) for a in at("rotation")], "XYZ").to_matrix().to_4x4()
    return Matrix.Translation(at("position")) @ turn


def colliders(scene, time):
    ground = material("ground", (0.060, 0.066, 0.075), roughness=0.55, grain=0.35, grain_size=0.5)
    fade(ground, 3.0, 11.0)
    wall = material("wall", (0.155, 0.145, 0.135), roughness=0.9, grain=0.30, grain_size=0.4)
    metal = material("collider", (0.16, 0.055, 0.028), roughness=0.6, grain=0.25, grain_size=0.15)
    quad = [np.array([[0, 1, 2, 3]], np.int32)]
    for c in scene.get("colliders", []):
        shape = c["shape"]
        if shape["type"] == "plane":
            normal = Vector(shape["normal"]).normalized()
            far = 40.0
            thing = mesh_object(
                c["name"],
                [(-far, -far, 0), (far, -far, 0), (far, far, 0), (-far, far, 0)],
                quad,
                ground if normal.y > 0.7 else wall,
            )
            turn = normal.to_track_quat("Z", "Y").to_matrix().to_4x4()
            thing.matrix_world = motion(c, time) @ Matrix.Translation(shape["point"]) @ turn
        elif shape["type"] == "box":
            low, high = shape["min"], shape["max"]
            corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
            faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
            thing = mesh_object(c["name"], corners, [np.array(faces, np.int32)], metal)
            turn = Euler([math.radians(a) for a in shape.get("rotate", (0, 0, 0))], "XYZ").to_matrix().to_4x4()
            scale = shape.get("scale", 1)
            scale = Matrix.Diagonal((*(scale if isinstance(scale, list) else [scale] * 3), 1))
            place = Matrix.Translation(shape.get("translate", (0, 0, 0)))
            thing.matrix_world = motion(c, time) @ place @ turn @ scale
            edge = thing.modifiers.new("edge", "BEVEL")
            edge.width, edge.segments = 0.004, 2
        elif shape["type"] == "difference":
            glass([part for part in shape["of"][1:] if part["type"] == "cone"])
        else:
            print(f"render: collider {c['name']}: a {shape['type']} is not drawn")


def looking(eye, target):
    """The matrix of a camera or light at eye that faces target, with y up."""
    back = (Vector(eye) - Vector(target)).normalized()
    right = Vector((0, 1, 0)).cross(back).normalized()
    m = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    m.translation = Vector(eye)
    return m


def light(name, place, target, size, power, colour):
    lamp = bpy.data.lights.new(name, "AREA")
    lamp.shape, lamp.size, lamp.energy, lamp.color = "DISK", size, power, colour
    thing = bpy.data.objects.new(name, lamp)
    thing.matrix_world = looking(place, target)
    bpy.context.scene.collection.objects.link(thing)


def sky(tree):
    """What the camera sees is the haze, even to the horizon; what lights the scene is stronger and bluer."""
    nodes, links = tree.nodes, tree.links
    seen, mix, path = nodes["Background"], nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeLightPath")
    seen.inputs["Color"].default_value = (*SKY, 1)
    dome = nodes.new("ShaderNodeBackground")
    dome.inputs["Color"].default_value = (0.36, 0.50, 0.80, 1)
    dome.inputs["Strength"].default_value = 0.5
    links.new(path.outputs["Is Camera Ray"], mix.inputs["Fac"])
    links.new(dome.outputs[0], mix.inputs[1])
    links.new(seen.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], nodes["World Output"].inputs["Surface"])


def stage(args, view):
    s = bpy.context.scene
    camera = bpy.data.cameras.new("camera")
    camera.sensor_width, camera.sensor_fit, camera.lens = 36, "HORIZONTAL", view["lens"]
    s.camera = bpy.data.objects.new("camera", camera)
    s.camera.matrix_world = looking(view["eye"], view["target"])
    s.collection.objects.link(s.camera)

    target = Vector(view["target"])
    light("key", target + Vector(view["key"]), target, 0.8, view["power"], (1.0, 0.93, 0.84))
    s.world = bpy.data.worlds.new("sky")
    s.world.use_nodes = True
    sky(s.world.node_tree)

    s.render.engine = "CYCLES"
    s.cycles.samples = args.samples
    s.cycles.use_denoising = _cycles.with_openimagedenoise  # Debian builds Blender without
    s.cycles.use_adaptive_sampling = True
    s.cycles.adaptive_threshold = 0.012
    s.cycles.max_bounces, s.cycles.diffuse_bounces = 6, 4
    s.cycles.caustics_reflective = s.cycles.caustics_refractive = False
    s.cycles.sample_clamp_indirect = 0.7
    s.render.resolution_x, s.render.resolution_y = args.size
    s.view_settings.view_transform = "Filmic"
    s.view_settings.look = "Medium High Contrast"
    s.view_settings.exposure = args.exposure


# ---- pictures ----


def pixels(file):
    image = bpy.data.images.load(str(file))
    width, height = image.size
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(height, width, 4)


def save(panels, out, quality):
    height = panels[0].shape[0]
    gap = np.ones((height, 4, 4), np.float32)
    row = np.concatenate([part for panel in panels for part in (gap, panel)][1:], axis=1)
    image = bpy.data.images.new("strip", row.shape[1], height)
    image.pixels.foreach_set(row.ravel())
    s = bpy.context.scene.render.image_settings
    s.file_format, s.color_mode, s.quality = "JPEG" if out.suffix in (".jpg", ".jpeg") else "PNG", "RGB", quality
    bpy.context.scene.view_settings.view_transform = "Standard"
    bpy.context.scene.view_settings.look = "None"
    bpy.context.scene.view_settings.exposure = 0
    image.save_render(str(out.resolve()), scene=bpy.context.scene)


def main():
    args = arguments()
    scene = tomllib.loads(args.scene.read_text())
    view = dict(VIEWS.get(args.scene.stem, VIEWS["snowball"]))
    view.update({k: getattr(args, k) for k in ("eye", "target", "lens") if getattr(args, k) is not None})
    body = scene["bodies"][0]
    model = scene["materials"][body["material"]]["model"]
    colours = COLOURS.get(args.scene.stem, BODY_COLOURS)

    across, up = np.linspace(-1, 1, args.size[0]), np.linspace(-1, 1, args.size[1])
    vignette = 1 - 0.11 * (across[None, :, None] ** 2 + up[:, None, None] ** 2)
    panels = []
    for cache in args.cache:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.preferences.addon_enable(module="cycles")
        points, cell = read_cache(cache)
        spacing = cell / body.get("particles_per_cell", 8) ** (1 / 3)
        if "snow" in model:
            grains(points, spacing, material("snow", (0.90, 0.92, 0.95), roughness=0.6, specular=0.3))
        elif "sand" in model:
            grains(points, spacing, material("sand", colours[0], roughness=0.9))
        else:
            rubber(points, spacing, colours)
        # Frame 1 is the start.
        number = int(cache.stem.rpartition(".")[2])
        colliders(scene, (number - 1) / scene["simulation"].get("frame_rate", 24))
        stage(args, view)
        s = bpy.context.scene
        s.render.image_settings.file_format = "PNG"
        s.render.filepath = str(SCRATCH / "panel.png")
        bpy.ops.render.render(write_still=True)
        panels.append((pixels(SCRATCH / "panel.png") * vignette).astype(np.float32))
    save(panels, args.out, args.quality)
    print(f"render: {args.out}: {args.out.stat().st_size // 1024} kB")


main()
