"""Path-traced look at a model. Run: blender -b --python models/source/car_look.py -- MODEL.glb OUT_PREFIX SAMPLES [WIDTH] [VIEW...]

Views: eye (from the node with extras type eye), front, rear, side, or any "x,y,z>x,y,z:fov" in the car's vehicle frame.
"""
import sys

import bpy
import mathutils
import numpy as np

np.bool = bool  # Debian 12: this Blender's importer still uses the name that its numpy has dropped


def to_blender(p):
    return mathutils.Vector((p[1], -p[0], p[2]))


def look(camera, eye, target, fov_deg):
    camera.location = to_blender(eye)
    camera.rotation_euler = (to_blender(target) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.angle = np.radians(fov_deg)


def surroundings(scene):
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    sky.sky_type, sky.sun_elevation, sky.sun_rotation, sky.sun_intensity, sky.dust_density = "NISHITA", np.radians(38), np.radians(120), 0.25, 3.0
    world.node_tree.links.new(sky.outputs[0], world.node_tree.nodes["Background"].inputs[0])
    world.node_tree.nodes["Background"].inputs[1].default_value = 0.18

    def box(name, size, at, color):
        bpy.ops.mesh.primitive_cube_add(size=1, location=to_blender(at))
        o = bpy.context.object
        o.scale = (size[1], size[0], size[2])
        m = bpy.data.materials.new(name)
        m.use_nodes = True
        m.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*color, 1)
        o.data.materials.append(m)

    box("asphalt", (400, 400, 0.1), (0, 0, -0.05), (0.09, 0.09, 0.09))
    for k in range(12):
        box("line", (3, 0.12, 0.01), (12 * k - 20, -1.9, 0.001), (0.6, 0.6, 0.6))
    rng = np.random.default_rng(5)
    for k in range(26):
        side = 1 if k % 2 else -1
        h = rng.uniform(5, 14)
        box("house", (9, 9, h), (12 * (k // 2) - 30, side * rng.uniform(13, 18) - 1.9, h / 2), tuple(rng.uniform(0.08, 0.4, 3)))


def main(model, prefix, samples, width, views):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.import_scene.gltf(filepath=model)
    eye = None
    for o in list(bpy.data.objects):
        said = o.get("rainglass")
        if said and said["type"] == "shelter":
            o.hide_render = True
        if said and said["type"] == "eye":
            eye = o
        if o.type == "LIGHT":
            o.hide_render = True
    surroundings(scene)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.clip_start = 0.02
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces, scene.cycles.transparent_max_bounces = samples, False, 5, 16
    scene.cycles.sample_clamp_indirect = 4
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, width * 9 // 16, 100
    scene.view_settings.view_transform = "Filmic"
    for view in views:
        if view == "eye":
            e = eye.matrix_world.translation
            e = np.array([-e.y, e.x, e.z])
            a = np.radians(eye["rainglass"]["pitch_deg"])
            look(camera, e, e + [np.cos(a), 0, np.sin(a)], eye["rainglass"]["fov_deg"])
        elif view in NAMED:
            look(camera, *NAMED[view])
        else:
            a, b = view.split(">")
            b, fov = b.split(":")
            look(camera, *[tuple(map(float, q.split(","))) for q in (a, b)], float(fov))
        scene.render.filepath = f"{prefix}_{view if view in NAMED or view == 'eye' else 'view%d' % views.index(view)}.png"
        bpy.ops.render.render(write_still=True)


NAMED = {"front": ((7.3, 3.4, 1.55), (1.35, 0, 0.68), 38), "rear": ((-4.4, 3.3, 1.6), (1.3, 0, 0.66), 38), "side": ((1.36, 8.5, 1.3), (1.36, 0, 0.72), 32)}

if __name__ == "__main__":
    args = sys.argv[sys.argv.index("--") + 1:]
    main(args[0], args[1], int(args[2]), int(args[3]) if len(args) > 3 else 480, args[4:] or ["eye", "front", "rear", "side"])
