"""Meshes built from numpy: quads, grids, boxes and tubes, collected and turned into Blender objects."""
import bpy
import numpy as np
from mathutils import Matrix

import road_materials


class Mesh:
    """Collects faces with materials and uvs. uvs are given per corner, in tiles of the material's texture."""

    def __init__(self):
        self.points, self.normals, self.faces, self.uvs, self.materials, self.names = [], [], [], [], [], []
        self.count = 0

    def add(self, points, faces, material, uvs, normals=None):
        """points (n,3), faces lists of indices into points, uvs (n,2) one for each point."""
        points, uvs = np.asarray(points, float).reshape(-1, 3), np.asarray(uvs, float).reshape(-1, 2)
        if material not in self.names:
            self.names.append(material)
        slot = self.names.index(material)
        self.points.append(points)
        self.normals.append(np.zeros_like(points) if normals is None else np.asarray(normals, float).reshape(-1, 3))
        for face in faces:
            self.faces.append([int(i) + self.count for i in face])
            self.uvs.extend(uvs[list(face)])
            self.materials.append(slot)
        self.count += len(points)

    def quad(self, corners, material, uv=(0, 0, 1, 1), normals=None):
        """One quad; corners counter-clockwise from its lower left, uv = (u0, v0, u1, v1)."""
        u0, v0, u1, v1 = uv
        self.add(corners, [(0, 1, 2, 3)], material, [(u0, v0), (u1, v0), (u1, v1), (u0, v1)], normals)

    def grid(self, points, material, uvs, flip=False):
        """points (n,m,3), uvs (n,m,2). Seen from the side where axis 0 x axis 1 points."""
        n, m = points.shape[:2]
        i, j = np.meshgrid(np.arange(n - 1), np.arange(m - 1), indexing="ij")
        a = (i * m + j).ravel()
        faces = np.stack([a, a + m, a + m + 1, a + 1], axis=1)
        self.add(points, faces[:, ::-1] if flip else faces, material, uvs)

    def box(self, frame, low, high, material, tile_m=1.0, skip=""):
        """A box between corners low and high in a frame (origin, axes). skip: faces left out, of "xXyYzZ" (lower case: low side)."""
        low, high = np.asarray(low, float), np.asarray(high, float)
        for axis, (u, v) in enumerate(((1, 2), (2, 0), (0, 1))):
            for side in (0, 1):
                if "xXyYzZ"[2 * axis + side] in skip:
                    continue
                corners = np.empty((4, 3))
                corners[:, axis] = (low, high)[side][axis]
                corners[:, u] = [low[u], high[u], high[u], low[u]]
                corners[:, v] = [low[v], low[v], high[v], high[v]]
                horizontal, vertical = (v, u) if axis == 1 else (u, v)
                uv = corners[:, [horizontal, vertical]] / tile_m
                order = (0, 1, 2, 3) if side else (3, 2, 1, 0)
                self.add(local(frame, corners), [order], material, uv)

    def tube(self, line, radii, sides, material, tile_m=1.0):
        """A round bar along line (n,3) with a radius for each point; open ends."""
        line, radii = np.asarray(line, float), np.broadcast_to(radii, len(line))
        along = np.gradient(line, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        helper = np.where(np.abs(along[:, 2:]) < 0.9, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
        side = np.cross(along, helper)
        side /= np.linalg.norm(side, axis=1, keepdims=True)
        other = np.cross(side, along)
        angle = np.linspace(0, 2 * np.pi, sides + 1)
        ring = side[:, None] * np.cos(angle)[:, None] + other[:, None] * np.sin(angle)[:, None]
        points = line[:, None] + ring * radii[:, None, None]
        length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
        uvs = np.stack(np.broadcast_arrays(np.arange(sides + 1) / sides, length[:, None] / tile_m), axis=-1)
        self.grid(points, material, uvs)

    def triangles(self):
        return sum(len(face) - 2 for face in self.faces)

    def data(self, name, smooth_deg=35.0):
        """A Blender mesh. Corners sharper than smooth_deg stay sharp; normals given with add() are kept."""
        mesh = bpy.data.meshes.new(name)
        points = np.concatenate(self.points)
        mesh.from_pydata(points.tolist(), [], self.faces)
        layer = mesh.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", np.asarray(self.uvs, np.float32).ravel())
        mesh.polygons.foreach_set("material_index", self.materials)
        mesh.polygons.foreach_set("use_smooth", [True] * len(self.faces))
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, np.radians(smooth_deg)
        for material in self.names:
            mesh.materials.append(road_materials.get(material))
        normals = np.concatenate(self.normals)
        if np.any(normals):
            mesh.normals_split_custom_set_from_vertices(normals.tolist())
        mesh.update()
        return mesh


def local(frame, points):
    """World points of a frame's own coordinates."""
    origin, axes = frame
    return np.asarray(origin) + np.asarray(points, float) @ np.asarray(axes)


def place(name, data, frame=None, scale=1.0, extras=None):
    """An object (node) with shared data at a frame, with rainglass extras if any."""
    thing = bpy.data.objects.new(name, data)
    if frame is not None:
        origin, axes = frame
        matrix = np.eye(4)
        matrix[:3, :3] = np.asarray(axes).T * scale
        matrix[:3, 3] = origin
        thing.matrix_world = Matrix(matrix.tolist())
    if extras:
        thing["rainglass"] = extras
    bpy.context.scene.collection.objects.link(thing)
    return thing


class Chunks:
    """One mesh for each stretch of road, so that a host can leave out what it does not see."""

    def __init__(self, kind, length_m=120.0):
        self.kind, self.length_m, self.meshes = kind, length_m, {}

    def at(self, s):
        return self.meshes.setdefault(int(np.floor(s / self.length_m)), Mesh())

    def build(self):
        for index in sorted(self.meshes):
            name = f"{self.kind}_{index:+03d}"
            place(name, self.meshes[index].data(name))


def shelter(name, points):
    """A convex volume of air that rain does not reach: the hull of points."""
    import bmesh
    hull = bmesh.new()
    for p in points:
        hull.verts.new([float(v) for v in p])
    bmesh.ops.convex_hull(hull, input=hull.verts)
    mesh = bpy.data.meshes.new("shelter_" + name)
    hull.to_mesh(mesh)
    hull.free()
    return place("shelter_" + name, mesh, extras={"type": "shelter", "name": name})


_LAMP_DATA = {}


def lamp(name, frame, candela, reach_m, colour, spot_deg=150.0, blend=0.6):
    """A street light shining down from the frame's origin (KHR_lights_punctual spot, cone spot_deg wide)."""
    key = (candela, reach_m, colour, spot_deg, blend)
    if key not in _LAMP_DATA:
        light = bpy.data.lights.new(f"street_{len(_LAMP_DATA)}", "SPOT")
        # The exporter writes candela = W / 4 pi * 683 lm/W.
        light.energy = candela * 4 * np.pi / 683.0
        light.color, light.spot_size, light.spot_blend = colour, np.radians(spot_deg), blend
        light.use_custom_distance, light.cutoff_distance, light.shadow_soft_size = True, reach_m, 0.15
        _LAMP_DATA[key] = light
    return place(name, _LAMP_DATA[key], (frame[0], np.eye(3)), extras={"type": "light", "role": "street"})
