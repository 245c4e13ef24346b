"""Makes car.glb. Run: blender -b --python models/source/car.py -- OUT.glb

A made-up hatchback, left-hand drive, modelled by formulae so that it can be read and changed; see car_shape.py for its form.
"""
import json
import os
import struct
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True

import bpy  # noqa: E402

import car_body  # noqa: E402
import car_cabin  # noqa: E402
import car_camera  # noqa: E402
import car_controls  # noqa: E402
import car_dash  # noqa: E402
import car_glass  # noqa: E402
import car_instruments  # noqa: E402
import car_seat  # noqa: E402
import car_shape  # noqa: E402
import car_wheel  # noqa: E402
import car_wiper  # noqa: E402
from car_material import material  # noqa: E402
from car_mesh import place  # noqa: E402


def main(out):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    car_glass.make_panes(material)
    hull = car_glass.make_shelter(material)
    wipers = car_wiper.make_wipers(material)
    for part in (car_body, car_wheel, car_cabin, car_dash, car_instruments, car_controls, car_seat, car_camera):
        part.make(material)
    place(bpy.data.objects.new("eye", None), car_shape.EYE, rainglass={"type": "eye", "pitch_deg": -3.0, "fov_deg": 74.0})
    print("\n".join(car_wiper.report(wipers) + car_glass.report_shelter(*hull)))
    export(out)


def export(out):
    for o in bpy.data.objects:  # what the scripts keep for themselves
        if "_world" in o:
            del o["_world"]
    bpy.ops.export_scene.gltf(filepath=out, export_format="GLB", export_extras=True, export_yup=True, export_lights=True, export_cameras=False,
                              export_apply=False, export_animations=False, export_tangents=False)
    correct_booleans(out)


def correct_booleans(path):
    """Blender 3.4 keeps a boolean property as an integer; the convention wants true or false."""
    data = open(path, "rb").read()
    size = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + size])
    for node in document["nodes"]:
        said = node.get("extras", {}).get("rainglass", {})
        for key in ("steers", "inside", "wet"):
            if key in said:
                said[key] = bool(said[key])
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + size:]
    with open(path, "wb") as f:
        f.write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
