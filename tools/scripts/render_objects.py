"""What render.py builds pictures of: surfaces, meshes and balls."""

import bpy
import numpy as np

# The haze that the far ground goes over into.
SKY = (0.085, 0.110, 0.150)


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
