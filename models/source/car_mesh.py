"""Mesh building for the car: collects parts in vehicle coordinates and hands them to Blender.

Vehicle frame: x forward, y left, z up, metres, origin on the ground under the middle of the rear axle.
Blender's exporter turns (x, y, z) into glTF (x, z, -y); a car's front faces glTF +Z, hence `to_blender`.
"""
import bmesh
import bpy
import mathutils
import numpy as np
from mathutils.geometry import delaunay_2d_cdt

TILES_PER_M = 4.0  # textures repeat every 25 cm: a texel is 1 mm
SHARP_RAD = np.radians(38.0)  # edges sharper than this are drawn hard where no normals are given


def to_blender(p):
    p = np.asarray(p, float)
    return np.stack([p[..., 1], -p[..., 0], p[..., 2]], axis=-1)


def unit(v):
    v = np.asarray(v, float)
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)


class Part:
    """One mesh object in the making: vertices, faces with materials, optional normals and uv."""

    def __init__(self, name):
        self.name, self.materials = name, []
        self.verts, self.normals, self.uvs, self.faces, self.face_material = [], [], [], [], []
        self.count = 0

    def add(self, verts, faces, material, normals=None, uvs=None, mirror=False):
        """Appends geometry; `mirror` appends its image in y = 0 as well. Normals of 0 are computed from the faces."""
        verts = np.asarray(verts, float).reshape(-1, 3)
        normals = np.zeros_like(verts) if normals is None else np.asarray(normals, float).reshape(-1, 3)
        uvs = np.full((len(verts), 2), np.nan) if uvs is None else np.asarray(uvs, float).reshape(-1, 2)
        if material not in self.materials:
            self.materials.append(material)
        index = self.materials.index(material)
        self.verts.append(verts), self.normals.append(normals), self.uvs.append(uvs)
        self.faces += [tuple(int(i) + self.count for i in f) for f in faces]
        self.face_material += [index] * len(faces)
        self.count += len(verts)
        if mirror:
            flip = np.array([1.0, -1.0, 1.0])
            self.add(verts * flip, [tuple(f)[::-1] for f in faces], material, normals * flip, uvs)
        return self

    def build(self, material_of, origin=(0, 0, 0), basis=np.eye(3), parent=None, rainglass=None, box_uv=True):
        """Makes the Blender object. `basis` columns are the node's local axes in vehicle coordinates."""
        local = (np.concatenate(self.verts) - np.asarray(origin, float)) @ basis  # a node's mesh lies in its own axes
        normals = np.concatenate(self.normals) @ basis
        mesh = bpy.data.meshes.new(self.name)
        mesh.from_pydata(to_blender(local), [], self.faces)
        for m in self.materials:
            mesh.materials.append(material_of(m))
        mesh.polygons.foreach_set("material_index", self.face_material)
        mesh.polygons.foreach_set("use_smooth", [True] * len(self.faces))
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, SHARP_RAD
        loops = np.zeros(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", loops)
        self._uv(mesh, loops, box_uv)
        shown = to_blender(unit(normals) * (np.linalg.norm(normals, axis=1, keepdims=True) > 0))
        mesh.normals_split_custom_set([tuple(n) for n in np.asarray(shown)[loops]])
        return place(bpy.data.objects.new(self.name, mesh), origin, basis, parent, rainglass)

    def _uv(self, mesh, loops, box_uv):
        given = np.concatenate(self.uvs)
        if np.isnan(given).all() and not box_uv:
            return
        world = np.concatenate(self.verts)
        uv = given[loops]
        for polygon in mesh.polygons:
            span = slice(polygon.loop_start, polygon.loop_start + polygon.loop_total)
            if np.isnan(uv[span]).any():  # metric box projection, so that tiled textures have their true scale
                n = np.abs(polygon.normal)
                keep = [(1, 2), (0, 2), (0, 1)][int(np.argmax([n[0], n[1], n[2]]))]  # Blender's x is our y
                p = world[loops[span]]
                axes = {0: p[:, 1], 1: p[:, 0], 2: p[:, 2]}
                uv[span] = TILES_PER_M * np.stack([axes[keep[0]], axes[keep[1]]], axis=-1)
        mesh.uv_layers.new(name="uv").data.foreach_set("uv", uv.astype(np.float32).ravel())


def place(obj, origin=(0, 0, 0), basis=np.eye(3), parent=None, rainglass=None):
    """Links an object at a vehicle-frame origin with vehicle-frame axes, as a child of `parent` when given."""
    turn = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]], float)  # to_blender as a matrix
    matrix = np.eye(4)
    matrix[:3, :3] = turn @ np.asarray(basis) @ turn.T
    matrix[:3, 3] = to_blender(origin)
    bpy.context.scene.collection.objects.link(obj)
    if parent is not None:
        obj.parent = parent
        obj.matrix_local = mathutils.Matrix((np.linalg.inv(np.array(parent["_world"]).reshape(4, 4)) @ matrix).tolist())
    else:
        obj.matrix_local = mathutils.Matrix(matrix.tolist())
    obj["_world"] = matrix.ravel().tolist()
    if rainglass:
        obj["rainglass"] = rainglass
    return obj


def axes_for(z_axis, x_hint):
    """Vehicle-frame basis whose *Blender* local +Z is z_axis and Blender local +X is as near x_hint as can be.

    Blender local X, Y, Z are a node's vehicle-style axes y, -x, z (see `to_blender`).
    """
    z = unit(z_axis)
    x = unit(np.asarray(x_hint, float) - np.dot(x_hint, z) * z)
    y = np.cross(z, x)  # Blender's local Y
    return np.stack([-y, x, z], axis=-1)


def grid_faces(rows, cols, wrap_rows=False, wrap_cols=False):
    faces = []
    for i in range(rows if wrap_rows else rows - 1):
        for j in range(cols if wrap_cols else cols - 1):
            a, b = i * cols + j, i * cols + (j + 1) % cols
            c, d = ((i + 1) % rows) * cols + (j + 1) % cols, ((i + 1) % rows) * cols + j
            faces.append((a, b, c, d))
    return faces


def flipped(faces):
    return [tuple(f)[::-1] for f in faces]


def resample(points, step):
    """A polyline (open) with no step longer than `step`; its own points stay, doubled ones go."""
    points = np.asarray(points, float)
    out = [points[0]]
    for a, b in zip(points[:-1], points[1:]):
        n = int(np.ceil(np.linalg.norm(b - a) / step - 1e-6))
        out += [a + (b - a) * k / n for k in range(1, n + 1)]
    return np.array(out)


def spline(points, per=8, closed=False):
    """Uniform Catmull-Rom curve through the points."""
    p = np.asarray(points, float)
    n = len(p)
    if closed:
        ext = np.concatenate([p[-1:], p, p[:2]])
    else:
        ext = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
    t = np.arange(per)[:, None] / per
    out = []
    for k in range(n if closed else n - 1):
        a, b, c, d = ext[k:k + 4]
        out.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3))
    if not closed:
        out.append(p[-1:])
    return np.concatenate(out)


def rounded(points, radius, per=4):
    """A closed polygon with its corners rounded; radius is one number or one a corner."""
    p = np.asarray(points, float)
    radii = np.broadcast_to(radius, len(p))
    out = []
    for k in range(len(p)):
        a, b, c = p[k - 1], p[k], p[(k + 1) % len(p)]
        ra = min(radii[k], 0.45 * np.linalg.norm(a - b), 0.45 * np.linalg.norm(c - b))
        s, e = b + unit(a - b) * ra, b + unit(c - b) * ra
        t = np.linspace(0, 1, per + 1)[:, None]
        out.append((1 - t)**2 * s + 2 * t * (1 - t) * b + t**2 * e if ra > 1e-6 else b[None])
    return np.concatenate(out)


def closed_resample(loop, step):
    loop = np.asarray(loop, float)
    return resample(np.concatenate([loop, loop[:1]]), step)[:-1]


def thin(loop, step):
    """Drops points that stand closer than `step` where the loop hardly turns."""
    loop = np.asarray(loop, float)
    kept = [loop[0]]
    for p, q in zip(loop[1:], np.roll(loop, -1, 0)[1:]):
        a, b = p - kept[-1], q - p
        turn = abs(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b))
        if np.linalg.norm(a) > 1e-6 and (np.linalg.norm(a) >= step or turn > 0.16):
            kept.append(p)
    return np.array(kept)


def signed_area(loop):
    x, y = np.asarray(loop, float).T
    return 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)


def offset_loop(loop, distance):
    """Moves a closed counter-clockwise 2-D loop inwards by `distance` (small against its features)."""
    loop = np.asarray(loop, float)
    along = unit(np.roll(loop, -1, 0) - np.roll(loop, 1, 0))
    return loop + np.stack([-along[:, 1], along[:, 0]], -1) * distance


def inside(points, loop):
    """Even-odd rule, vectorised."""
    x, y = np.asarray(points, float).T
    result = np.zeros(len(x), bool)
    for (x0, y0), (x1, y1) in zip(loop, np.roll(loop, -1, 0)):
        if y0 != y1:
            cross = (y0 > y) != (y1 > y)
            result ^= cross & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return result


def loop_distance(points, loop):
    best = np.full(len(points), np.inf)
    for a, b in zip(loop, np.roll(loop, -1, 0)):
        d = b - a
        t = np.clip(((points - a) @ d) / max(d @ d, 1e-12), 0, 1)
        best = np.minimum(best, np.linalg.norm(points - a - t[:, None] * d, axis=1))
    return best


def fill(loops, step, edge_step=None):
    """Triangulates the area inside loops[0] and outside the others. Returns 2-D points, triangles and the loops' indices."""
    loops = [closed_resample(l, edge_step or step) for l in loops]
    loops = [l if (signed_area(l) > 0) == (k == 0) else l[::-1] for k, l in enumerate(loops)]
    low, high = loops[0].min(0), loops[0].max(0)
    gx, gy = np.meshgrid(np.arange(low[0] + step / 2, high[0], step), np.arange(low[1] + step / 2, high[1], step))
    gx[1::2] += step / 2
    inner = np.stack([gx.ravel(), gy.ravel()], -1)
    keep = inside(inner, loops[0]) & (loop_distance(inner, loops[0]) > 0.55 * step)
    for hole in loops[1:]:
        keep &= ~inside(inner, hole) & (loop_distance(inner, hole) > 0.55 * step)
    points, edges, rings = [], [], []
    for l in loops:
        start = len(points)
        ring = list(range(start, start + len(l)))
        points += [tuple(p) for p in l]
        edges += [(a, b) for a, b in zip(ring, ring[1:] + ring[:1])]
        rings.append(ring)
    points += [tuple(p) for p in inner[keep]]
    out = delaunay_2d_cdt([mathutils.Vector(p) for p in points], edges, [], 0, 1e-7)
    xy = np.array([tuple(v) for v in out[0]])
    first = {}
    for k, origins in enumerate(out[3]):
        for o in origins:
            first[o] = k
    rings = [[first[i] for i in ring] for ring in rings]
    tris = np.array([f for f in out[2]])
    middle = xy[tris].mean(1)
    a, b = xy[tris[:, 1]] - xy[tris[:, 0]], xy[tris[:, 2]] - xy[tris[:, 0]]
    ok = inside(middle, loops[0]) & (np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) > 1e-7)  # slivers along straight edges go
    for hole in loops[1:]:
        ok &= ~inside(middle, hole)
    return xy, tris[ok], rings


def normals_of(surface, p, out_hint=None, e=1e-4):
    """Unit normals of a surface (array of 2-D points -> 3-D points), turned like the parameters (right-handed)."""
    du = surface(p + [e, 0]) - surface(p - [e, 0])
    dv = surface(p + [0, e]) - surface(p - [0, e])
    return unit(np.cross(du, dv))


def panel(part, material, surface, loops, step=0.05, gap=0.003, radius=0.004, depth=0.012, edge_step=None, offset=0.0,
          flip=False, mirror=False, edge=True):
    """A sheet-metal panel: the area of `loops` on `surface`, its rims rounded and turned in by `depth`.

    The rim lies `gap` inside the outline, so that neighbours leave a joint of 2 gap. `flip` when the surface's
    parameters are left-handed seen from outside. `edge` "holes" turns in the rims of the openings only.
    """
    sign = -1.0 if flip else 1.0
    loops = [closed_resample(thin(l, 0.6 * (edge_step or step)), edge_step or step) for l in loops]
    loops = [l if signed_area(l) > 0 else l[::-1] for l in loops]
    inset = [gap + (radius if edge is True or (edge and k) else 0.0) for k in range(len(loops))]
    loops = [offset_loop(l, inset[k] if k == 0 else -inset[k]) for k, l in enumerate(loops)]
    xy, tris, rings = fill(loops, step, edge_step)
    normal = sign * normals_of(surface, xy)
    p = surface(xy) + normal * offset
    faces = [tuple(t[::-1]) if flip else tuple(t) for t in tris]
    verts, norms = [p], [normal]
    count = len(p)
    for ring in {True: rings, False: [], "holes": rings[1:]}[edge]:
        q, n = p[ring], normal[ring]
        along = unit(np.roll(q, -1, 0) - np.roll(q, 1, 0))
        out = sign * np.cross(along, n)  # rings turn with the sheet on their left
        rows = [q + radius * (0.7 * out - 0.3 * n), q + radius * (out - n), q + radius * (out - n) - depth * n]
        verts += rows
        norms += [unit(out + n), unit(out), unit(out)]
        m = len(ring)
        ids = [list(ring)] + [list(range(count + k * m, count + (k + 1) * m)) for k in range(3)]
        for a, b in zip(ids[:-1], ids[1:]):
            for j in range(m):
                quad = (a[j], b[j], b[(j + 1) % m], a[(j + 1) % m])
                faces.append(quad[::-1] if flip else quad)
        count += 3 * m
    part.add(np.concatenate(verts), faces, material, np.concatenate(norms), mirror=mirror)


def lathe(profile, segments, origin, axis, start=(0, 0, 1)):
    """Turns a profile of (radius, along) about an axis; counter-clockwise profiles face outward. Vertices, faces."""
    axis = unit(axis)
    start = start if np.linalg.norm(np.cross(start, axis)) > 0.05 else (1.0, 0, 0)
    u = unit(np.asarray(start, float) - np.dot(start, axis) * axis)
    v = np.cross(axis, u)
    profile = np.asarray(profile, float)
    angle = np.arange(segments) * 2 * np.pi / segments
    ring = np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * v
    verts = (np.asarray(origin, float) + profile[:, None, :1] * ring[None] + profile[:, None, 1:] * axis).reshape(-1, 3)
    on_axis = np.repeat(profile[:, 0] < 1e-9, segments)
    first = np.arange(len(verts)) // segments * segments
    faces = []
    for f in grid_faces(len(profile), segments, wrap_cols=True):  # a ring on the axis is one vertex
        g = [int(first[i]) if on_axis[i] else i for i in f]
        faces.append(tuple(i for k, i in enumerate(g) if i != g[k - 1]))
    used = np.unique(np.concatenate([np.array(f) for f in faces]))
    new = np.zeros(len(verts), int)
    new[used] = np.arange(len(used))
    return verts[used], [tuple(int(new[i]) for i in f) for f in faces]


def tube(path, radius, sides=8, closed=False, section=None, up=(0, 0, 1), caps=True):
    """Sweeps a circle (or a 2-D section) along a path; radius is one number or one a point. Vertices, faces."""
    path = np.asarray(path, float)
    n = len(path)
    along = unit(np.roll(path, -1, 0) - np.roll(path, 1, 0)) if closed else unit(np.gradient(path, axis=0))
    if section is None:
        a = np.arange(sides) * 2 * np.pi / sides
        section = np.stack([np.cos(a), np.sin(a)], -1)
    section = np.asarray(section, float)
    if np.ndim(up) == 1 and np.abs(along @ unit(up)).max() > 0.999:
        up = (1.0, 0, 0)
    up = np.broadcast_to(np.asarray(up, float), path.shape)
    side = unit(np.cross(along, up))
    top = np.cross(side, along)
    r = np.broadcast_to(radius, n)[:, None, None]
    verts = path[:, None] + r * (section[None, :, :1] * side[:, None] + section[None, :, 1:] * top[:, None])
    m = len(section)
    faces = flipped(grid_faces(n, m, wrap_rows=closed, wrap_cols=True))
    if caps and not closed:
        faces += [tuple(range(m)), tuple(range((n - 1) * m, n * m))[::-1]]
    return verts.reshape(-1, 3), faces


_boxes = {}


def rounded_box(center, size, radius=0.01, basis=np.eye(3), segments=2):
    """A box with rounded edges; `size` and `basis` in vehicle axes. Vertices, faces."""
    size = np.asarray(size, float)
    radius = min(radius, 0.49 * size.min())
    key = (tuple(np.round(size, 5)), round(radius, 5), segments)
    if key not in _boxes:
        bm = bmesh.new()
        bmesh.ops.create_cube(bm, size=1.0)
        for v in bm.verts:
            v.co = mathutils.Vector(np.array(v.co) * size)
        bmesh.ops.bevel(bm, geom=bm.edges[:], offset=radius, segments=segments, profile=0.5, affect="EDGES")
        bm.verts.index_update()
        _boxes[key] = (np.array([tuple(v.co) for v in bm.verts]), [tuple(v.index for v in f.verts) for f in bm.faces])
        bm.free()
    verts, faces = _boxes[key]
    return verts @ np.asarray(basis).T + np.asarray(center, float), faces


def rotation(axis, angle_deg):
    return np.array(mathutils.Matrix.Rotation(np.radians(angle_deg), 3, mathutils.Vector(axis)))
