"""Renders frames of a particle cache with Blender's Cycles. Started by the script `render` beside this file.

Snow is drawn as grains: every particle becomes a handful of small balls scattered through the volume that the particle
stands for, so cracks, chunks and debris are those of the simulation and only the texture below the particle spacing is
invented. Elastic bodies are drawn as surfaces, one colour per piece. Planes and boxes among the scene's colliders are
drawn where the scene puts them. The axes are the scene's: y is up.
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
from render_points import SCRATCH, neighbours, pieces, read_cache, read_ply, tool, write_ply  # noqa: E402

# Camera and light per scene, by the scene's file name. Metres; the light's place is relative to the target.
VIEWS = {
    "snowball": dict(eye=(2.7, 1.15, 0.75), target=(-0.05, 0.43, 0.06), lens=44, key=(1.0, 2.0, 2.0), power=185),
    "snow_on_wedge": dict(eye=(0.75, 1.2, 2.6), target=(0.02, 0.44, 0.0), lens=36, key=(-2.1, 1.8, 1.1), power=205),
    "elastic_cubes": dict(eye=(0.5, 0.9, 3.2), target=(0.0, 0.0, 0.0), lens=66, key=(-1.2, 2.2, 1.4), power=85),
}
SKY = (0.085, 0.110, 0.150)
BODY_COLOURS = [(0.62, 0.05, 0.02), (0.01, 0.12, 0.42), (0.75, 0.50, 0.05), (0.10, 0.40, 0.15)]


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


# ---- objects ----


def material(name, colour, roughness=0.8, grain=0.0, grain_size=1.0, subsurface=0.0, specular=0.2):
    """A plain surface; `grain` varies its brightness by that fraction on the scale of grain_size metres."""
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    surface = nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = (*colour, 1)
    surface.inputs["Roughness"].default_value = roughness
    surface.inputs["Specular"].default_value = specular
    if subsurface:
        surface.inputs["Subsurface"].default_value = subsurface
        surface.inputs["Subsurface Color"].default_value = (*colour, 1)
        surface.inputs["Subsurface Radius"].default_value = (0.03, 0.02, 0.015)
    if grain:
        place = nodes.new("ShaderNodeTexCoord")
        noise = nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value = 1 / grain_size
        noise.inputs["Detail"].default_value = 9
        noise.inputs["Roughness"].default_value = 0.65
        ramp = nodes.new("ShaderNodeValToRGB")
        for end, sign in ((0, -1), (1, 1)):
            ramp.color_ramp.elements[end].color = (*(c * (1 + sign * grain) for c in colour), 1)
            ramp.color_ramp.elements[end].position = 0.5 + sign * 0.25
        links.new(place.outputs["Object"], noise.inputs["Vector"])
        links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
        links.new(ramp.outputs["Color"], surface.inputs["Base Color"])
    return m


def fade(m, near, far):
    """Lets a surface go over into the colour of the sky between two distances from the camera."""
    nodes, links = m.node_tree.nodes, m.node_tree.links
    end = nodes["Material Output"]
    ramp = nodes.new("ShaderNodeMapRange")
    ramp.interpolation_type = "SMOOTHSTEP"
    ramp.inputs["From Min"].default_value, ramp.inputs["From Max"].default_value = near, far
    haze = nodes.new("ShaderNodeEmission")
    haze.inputs["Color"].default_value = (*SKY, 1)
    mix = nodes.new("ShaderNodeMixShader")
    links.new(nodes.new("ShaderNodeCameraData").outputs["View Distance"], ramp.inputs["Value"])
    links.new(ramp.outputs[0], mix.inputs["Fac"])
    links.new(nodes["Principled BSDF"].outputs[0], mix.inputs[1])
    links.new(haze.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], end.inputs["Surface"])


def mesh_object(name, points, polygons, surface, smooth=False):
    mesh = bpy.data.meshes.new(name)
    loops = sum(p.size for p in polygons)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", np.asarray(points, np.float32).ravel())
    mesh.loops.add(loops)
    mesh.loops.foreach_set("vertex_index", np.concatenate([p.ravel() for p in polygons]))
    totals = np.concatenate([np.full(len(p), p.shape[1], np.int32) for p in polygons])
    mesh.polygons.add(len(totals))
    mesh.polygons.foreach_set("loop_start", np.cumsum(totals) - totals)
    mesh.polygons.foreach_set("loop_total", totals)
    mesh.polygons.foreach_set("use_smooth", np.full(len(totals), smooth))
    mesh.update(calc_edges=True)
    mesh.materials.append(surface)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def balls_object(name, centres, radii, surface):
    """Perfect balls: a mesh of loose points that a node group turns into a point cloud."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(centres))
    mesh.vertices.foreach_set("co", centres.astype(np.float32).ravel())
    mesh.attributes.new("ball_radius", "FLOAT", "POINT").data.foreach_set("value", radii.astype(np.float32))
    mesh.materials.append(surface)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)

    group = bpy.data.node_groups.new(name, "GeometryNodeTree")
    group.inputs.new("NodeSocketGeometry", "Geometry")
    group.outputs.new("NodeSocketGeometry", "Geometry")
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    to_points = group.nodes.new("GeometryNodeMeshToPoints")
    radius = group.nodes.new("GeometryNodeInputNamedAttribute")
    radius.data_type = "FLOAT"
    radius.inputs["Name"].default_value = "ball_radius"
    dress = group.nodes.new("GeometryNodeSetMaterial")
    dress.inputs["Material"].default_value = surface
    group.links.new(start.outputs[0], to_points.inputs["Mesh"])
    group.links.new(next(o for o in radius.outputs if o.enabled), to_points.inputs["Radius"])
    group.links.new(to_points.outputs[0], dress.inputs["Geometry"])
    group.links.new(dress.outputs[0], end.inputs[0])
    thing.modifiers.new(name, "NODES").node_group = group
    return thing


def snow(points, spacing):
    rng = np.random.default_rng(1)

    def in_ball(n, radius):
        direction = rng.normal(size=(n, 3))
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        return direction * (radius * rng.random((n, 1)) ** (1 / 3))

    surface = material("snow", (0.90, 0.92, 0.95), roughness=0.6, specular=0.3)
    # A particle alone in the air is a small clod; among its like it fills its share of the volume.
    size = spacing * np.interp(neighbours(points, 1.5 * spacing), (4, 30), (0.5, 1.0))
    many = 60
    grains = np.repeat(points, many, axis=0) + in_ball(len(points) * many, 0.76) * np.repeat(size, many)[:, None]
    radii = np.repeat(size, many) * (0.06 + 0.12 * rng.random(len(grains)) ** 3)
    hearts = points + in_ball(len(points), 0.25) * size[:, None]
    heart_radii = size * (0.33 + 0.12 * rng.random(len(hearts)))
    balls_object("snow", np.concatenate([hearts, grains]), np.concatenate([heart_radii, radii]), surface)


def rubber(points, spacing):
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
        colour = BODY_COLOURS[i % len(BODY_COLOURS)]
        look = material(f"rubber {i}", colour, roughness=0.38, specular=0.5)
        mesh_object(f"piece {i}", *read_ply(SCRATCH / "surface.ply"), look, smooth=True)


def colliders(scene):
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
            thing.matrix_world = Matrix.Translation(shape["point"]) @ turn
        elif shape["type"] == "box":
            low, high = shape["min"], shape["max"]
            corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
            faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
            thing = mesh_object(c["name"], corners, [np.array(faces, np.int32)], metal)
            turn = Euler([math.radians(a) for a in shape.get("rotate", (0, 0, 0))], "XYZ").to_matrix().to_4x4()
            scale = shape.get("scale", 1)
            scale = Matrix.Diagonal((*(scale if isinstance(scale, list) else [scale] * 3), 1))
            thing.matrix_world = Matrix.Translation(shape.get("translate", (0, 0, 0))) @ turn @ scale
            edge = thing.modifiers.new("edge", "BEVEL")
            edge.width, edge.segments = 0.004, 2
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
    is_snow = "snow" in scene["materials"][body["material"]]["model"]

    across, up = np.linspace(-1, 1, args.size[0]), np.linspace(-1, 1, args.size[1])
    vignette = 1 - 0.11 * (across[None, :, None] ** 2 + up[:, None, None] ** 2)
    panels = []
    for cache in args.cache:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.preferences.addon_enable(module="cycles")
        points, cell = read_cache(cache)
        (snow if is_snow else rubber)(points, cell / body.get("particles_per_cell", 8) ** (1 / 3))
        colliders(scene)
        stage(args, view)
        s = bpy.context.scene
        s.render.image_settings.file_format = "PNG"
        s.render.filepath = str(SCRATCH / "panel.png")
        bpy.ops.render.render(write_still=True)
        panels.append((pixels(SCRATCH / "panel.png") * vignette).astype(np.float32))
    save(panels, args.out, args.quality)
    print(f"render: {args.out}: {args.out.stat().st_size // 1024} kB")


main()
