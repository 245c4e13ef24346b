"""Makes models/road.glb: 1.7 km of country road with a village, a bridge overhead, a tunnel and a petrol station.

    blender -b --python models/source/road.py -- OUT.glb

Parts: road_route (where the road runs), road_terrain, road_carriageway, road_village, road_bridge, road_tunnel, road_station,
road_plants; they use road_mesh (meshes and nodes), road_materials, road_textures, road_foliage, road_font.
Everything is drawn from fixed seeds: the same script makes the same file. What lies where along the route stands in
models/README.md; running this script prints it.
"""
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import road_bridge
import road_carriageway
import road_plants
import road_route as route
import road_station
import road_terrain
import road_tunnel
import road_village
from road_mesh import Chunks, place


def _route_node():
    points, _ = route.route_points()
    gltf_axes = [round(float(v), 3) for x, y, z in points for v in (x, z, -y)]
    place("route", None, extras={"type": "route", "points_m": gltf_axes, "closed": False})


def landmarks():
    """(what, distance along the route in m) in the order in which they are passed."""
    at = {"village, first lamp": 112, "bridge, in": route.BRIDGE_S - route.BRIDGE_HALF_WIDTH, "bridge, out": route.BRIDGE_S + route.BRIDGE_HALF_WIDTH,
          "tunnel, in": route.TUNNEL_IN, "tunnel, out": route.TUNNEL_OUT, "bends, from": 745, "bends, to": 965,
          "slip road, in": route.SLIP_IN, "canopy, in": route.CANOPY_S[0], "canopy, middle": sum(route.CANOPY_S) / 2,
          "canopy, out": route.CANOPY_S[1], "back on the road": route.SLIP_OUT + route.SLIP_LENGTH, "end": route.ROUTE_LAST}
    return [(name, route.route_arc(s)) for name, s in at.items()]


def build():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    ground, furniture = Chunks("ground"), Chunks("roadside")
    road_terrain.build(ground)
    road_carriageway.build(ground, furniture)
    road_village.build(furniture)
    road_bridge.build()
    road_tunnel.build()
    road_station.build()
    plants = road_plants.build(furniture)
    ground.build()
    furniture.build()
    _route_node()
    print(f"plants: {plants}")


def export(path):
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", export_extras=True, export_lights=True, export_yup=True,
                              export_animations=False, export_skins=False, export_morph=False, export_image_format="AUTO")


if __name__ == "__main__":
    build()
    for name, arc in landmarks():
        print(f"{arc:8.1f} m  {name}")
    export(os.path.abspath(sys.argv[sys.argv.index("--") + 1]))
