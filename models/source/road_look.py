"""Pictures of a road model from the driver's eye, to judge it by; not needed to make it.

    blender -b --python models/source/road_look.py -- road.glb OUT_DIR [distance along the route in m]...
"""
import os
import sys

import bpy
import numpy as np

np.bool = bool  # the importer of Blender 3.4 asks for a name that numpy 1.24 no longer has
from mathutils import Vector

SIZE, SAMPLES, EYE_M = (640, 360), 24, 1.2
PLACES = [0, 70, 150, 300, 420, 500, 630, 735, 850, 1000, 1060, 1300]


def _sky(scene):
    """Overcast: brightest above (CIE overcast sky, 1 + 2 sin elevation over 3), pale at the horizon."""
    world = bpy.data.worlds.new("overcast")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    where, split, ramp = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeSeparateXYZ"), nodes.new("ShaderNodeValToRGB")
    links.new(where.outputs["Generated"], split.inputs[0])
    links.new(split.outputs["Z"], ramp.inputs[0])
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (0.36, 0.39, 0.42, 1), (0.92, 0.97, 1.0, 1)
    links.new(ramp.outputs[0], nodes["Background"].inputs[0])
    nodes["Background"].inputs[1].default_value = 1.1
    scene.world = world


def _setup(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", SAMPLES, False
    scene.cycles.max_bounces, scene.cycles.transparent_max_bounces = 3, 16
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.view_settings.view_transform, scene.view_settings.exposure = "Filmic", 0.3
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    _sky(scene)
    for light in bpy.data.lights:
        light.energy *= 8  # by day the lamps of a street would not show
    for thing in scene.objects:
        kind = thing.get("rainglass", {}).get("type") if thing.get("rainglass") else None
        if kind == "shelter":
            thing.hide_render = True
        if kind == "route":
            flat = np.array(thing["rainglass"]["points_m"]).reshape(-1, 3)
            line = np.stack([flat[:, 0], -flat[:, 2], flat[:, 1]], axis=1)
    return scene, line


def main(path, folder, places):
    scene, line = _setup(path)
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    camera = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
    camera.data.angle, camera.data.clip_end = np.radians(62), 5000
    scene.collection.objects.link(camera)
    scene.camera = camera
    for place in places:
        at, ahead = ([np.interp(place + more, arc, line[:, k]) for k in range(3)] for more in (0.0, 12.0))
        eye = Vector(at) + Vector((0, 0, EYE_M))
        gaze = Vector(ahead) + Vector((0, 0, EYE_M)) - eye
        camera.location, camera.rotation_euler = eye, gaze.to_track_quat("-Z", "Y").to_euler()
        scene.render.filepath = os.path.join(folder, f"road_{place:04.0f}.png")
        bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1:]
    main(given[0], given[1], [float(v) for v in given[2:]] or PLACES)
