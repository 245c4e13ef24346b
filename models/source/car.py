"""Makes car.glb. Run: blender -b --python models/source/car.py -- OUT.glb

A made-up hatchback, left-hand drive, modelled by formulae so that it can be read and changed; see car_shape.py for its form.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True

import bpy  # noqa: E402

import car_glass  # noqa: E402
import car_shape  # noqa: E402
import car_wiper  # noqa: E402
from car_material import material  # noqa: E402
from car_mesh import place  # noqa: E402


def main(out):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    car_glass.make_panes(material)
    car_glass.make_shelter(material)
    wipers = car_wiper.make_wipers(material)
    for maker in MAKERS:
        maker(material)
    place(bpy.data.objects.new("eye", None), car_shape.EYE, rainglass={"type": "eye", "pitch_deg": -3.0, "fov_deg": 74.0})
    print("\n".join(car_wiper.report(wipers)))
    export(out)


def export(out):
    for o in bpy.data.objects:  # what the scripts keep for themselves
        if "_world" in o:
            del o["_world"]
    bpy.ops.export_scene.gltf(filepath=out, export_format="GLB", export_extras=True, export_yup=True, export_lights=True, export_cameras=False,
                              export_apply=False, export_animations=False, export_tangents=False)


try:
    import car_body
    import car_cabin
    import car_wheel
    MAKERS = [car_body.make, car_wheel.make, car_cabin.make]
except ImportError as e:
    print(e); MAKERS = []

if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
