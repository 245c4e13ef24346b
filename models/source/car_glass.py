"""Panes, their frit bands, the cabin's shelter and the wipers."""
import bmesh
import numpy as np

import car_shape as shape
from car_mesh import Part, fill, grid_faces, spline, unit

UV_PER_M = 0.6  # keeps every pane's chart metric and within the unit square
SIDE_GLASS_INSET_M = 0.007


def halfplanes_polygon(planes):
    """Convex polygon of {p: n.p <= d} (n unit, 2-D), counter-clockwise."""
    poly = np.array([(-9, -9), (9, -9), (9, 9), (-9, 9)], float)
    for n, d in planes:
        side = poly @ n - d
        out = []
        for k in range(len(poly)):
            a, b, sa, sb = poly[k - 1], poly[k], side[k - 1], side[k]
            if (sa <= 0) != (sb <= 0):
                out.append(a + (b - a) * sa / (sa - sb))
            if sb <= 0:
                out.append(b)
        poly = np.array(out)
    return poly


def planes_left_of(curve, inset):
    """Half-planes left of a polyline, moved inwards by `inset`."""
    curve = np.asarray(curve, float)
    result = []
    for a, b in zip(curve[:-1], curve[1:]):
        t = unit(b - a)
        n = np.array([t[1], -t[0]])
        result.append((n, n @ a - inset))
    return result


def window_outline(which, grow=0.0, round_m=0.022):
    """Daylight opening of the left flank in (x, z), counter-clockwise as seen with x to the right; corners rounded."""
    arch = spline(shape.PILLAR_A + shape.ROOF_RAIL + shape.PILLAR_C, 4)
    inset = 0.042 - grow
    xs = np.linspace(-0.62, 1.95, 9)
    sill = [(x, shape.belt_z(x) + 0.022 - grow) for x in xs]
    planes = planes_left_of(arch, inset + round_m)
    a, b = np.array(sill[0]), np.array(sill[-1])
    planes += planes_left_of([a + [0, 0.004], b + [0, 0.004]], round_m)
    lo, hi = (1.005 - grow, 9.0) if which == "front" else (-0.24, 0.925 + grow)
    planes += [(np.array([-1.0, 0]), -lo - round_m), (np.array([1.0, 0]), hi - round_m)]
    if which == "rear":  # kinked up at its hind end
        planes += planes_left_of([(-0.26, 1.20), (-0.12, 0.98)], round_m - grow)
    poly = halfplanes_polygon(planes)
    poly = poly[np.linalg.norm(poly - np.roll(poly, 1, 0), axis=1) > 1e-5]
    out = []
    for k in range(len(poly)):  # grown back by a disc: round corners
        e0, e1 = unit(poly[k] - poly[k - 1]), unit(poly[(k + 1) % len(poly)] - poly[k])
        a0, a1 = np.arctan2(-e0[0], e0[1]), np.arctan2(-e1[0], e1[1])
        a1 += 2 * np.pi * (a1 < a0 - 1e-9)
        steps = max(1, int((a1 - a0) / 0.3))
        out += [poly[k] + round_m * np.array([np.cos(a), np.sin(a)]) for a in np.linspace(a0, a1, steps + 1)]
    return np.array(out)


def glass_surface(p):
    """Left side glass: (x, z) -> point, a little inside the flank."""
    q = shape.glasshouse(p)
    q[:, 1] -= SIDE_GLASS_INSET_M
    return q


def make_panes(material_of):
    """All panes as nodes; returns nothing."""
    nu, nv = 41, 22
    u, v = np.meshgrid(np.linspace(-1, 1, nu), np.linspace(0, 1, nv))
    flat = np.stack([u.ravel(), v.ravel()], -1)
    p = shape.screen(flat)
    uv = np.stack([0.45 + UV_PER_M * p[:, 1], 0.02 + UV_PER_M * shape.SCREEN_HEIGHT_M * flat[:, 1]], -1)
    pane("windscreen", p, grid_faces(nv, nu), surface_normals(shape.screen, flat), uv, "glass", material_of)

    nu, nv = 25, 12
    u, v = np.meshgrid(np.linspace(-1, 1, nu), np.linspace(0, 1, nv))
    flat = np.stack([u.ravel(), v.ravel()], -1)
    p = shape.rear_screen(flat)
    slope = np.linalg.norm(shape.REAR_TOP - shape.REAR_FOOT)
    uv = np.stack([0.45 - UV_PER_M * p[:, 1], 0.02 + UV_PER_M * slope * flat[:, 1]], -1)
    pane("rear", p, [f[::-1] for f in grid_faces(nv, nu)], -surface_normals(shape.rear_screen, flat), uv, "glass", material_of)

    for which in ("front", "rear"):
        xz, tris, _ = fill([window_outline(which, grow=0.012)], 0.06, 0.04)
        p, n = glass_surface(xz), -surface_normals(glass_surface, xz)
        up = (xz[:, 1] - 0.9) * 1.09  # true length: the flank leans in
        for sign, hand in ((1, "left"), (-1, "right")):
            flip = np.array([1, sign, 1])
            faces = [tuple(t[::-1]) if sign > 0 else tuple(t) for t in tris]
            uv = np.stack([0.5 - sign * UV_PER_M * (xz[:, 0] - 0.85), 0.02 + UV_PER_M * up], -1)
            pane(f"side_{which}_{hand}", p * flip, faces, n * flip, uv, "glass", material_of)


def surface_normals(surface, p, e=1e-4):
    du = surface(p + [e, 0]) - surface(p - [e, 0])
    dv = surface(p + [0, e]) - surface(p - [0, e])
    return unit(np.cross(du, dv))


def pane(name, points, faces, normals, uv, material, material_of):
    part = Part("pane_" + name).add(points, faces, material, normals, uv)
    part.build(material_of, rainglass={"type": "pane", "name": name, "glass": "uncoated"})


def make_shelter(material_of):
    """The cabin's air as a convex hull: it touches the panes' insides and stays inside roof, floor and doors."""
    pts = []
    for v, us in ((0.0, (-1, -0.5, 0, 0.5, 1)), (0.5, (-1, 0, 1)), (1.0, (-1, 0, 1))):
        pts += list(shape.screen(np.array([[u, v] for u in us])))
    for v in (0.0, 1.0):
        pts += list(shape.rear_screen(np.array([[u, v] for u in (-1, 0, 1)])))
    # Found by trying points of the side glass in turn: what leaves the least of it outside the hull.
    for q in glass_surface(np.array([(0.30, 0.985), (0.54, 1.395), (1.74, 0.985), (-0.18, 1.01), (-0.18, 1.33)])):
        q = q + [0, 0.003, 0]
        pts += [q, q * [1, -1, 1]]
    for x, z, y in ((1.95, 0.30, 0.72), (-0.55, 0.35, 0.62)):
        pts += [(x, y, z), (x, -y, z)]
    pts.append((0.4, 0.0, 1.435))
    bm = bmesh.new()
    for q in pts:
        bm.verts.new(q)
    hull = bmesh.ops.convex_hull(bm, input=bm.verts)
    bmesh.ops.delete(bm, geom=list(set(hull["geom_interior"] + hull["geom_unused"])), context="VERTS")
    bm.verts.index_update()
    verts = [tuple(v.co) for v in bm.verts]
    faces = [tuple(v.index for v in f.verts) for f in bm.faces]
    bm.free()
    part = Part("cabin").add(verts, faces, "under")
    part.build(material_of, rainglass={"type": "shelter", "name": "cabin"}, box_uv=False)
    return np.array(verts), faces


def report_shelter(verts, faces):
    """How far the panes stand outside the cabin's hull, and how far they dip into it."""
    planes = []
    for f in faces:
        a, b, c = (verts[i] for i in f[:3])
        n = unit(np.cross(b - a, c - a))
        planes.append((n, n @ a))
    flat = lambda k: np.stack([g.ravel() for g in np.meshgrid(np.linspace(-1, 1, k), np.linspace(0, 1, k))], -1)
    panes = {"windscreen": shape.screen(flat(41)), "rear": shape.rear_screen(flat(31))}
    for which in ("front", "rear"):
        panes["side_" + which] = glass_surface(fill([window_outline(which)], 0.03)[0])
    lines = [f"cabin hull: {len(verts)} vertices"]
    for name, p in panes.items():
        out = np.max([p @ n - d for n, d in planes], axis=0)
        lines.append(f"cabin hull to {name}: {out.min()*1e3:.1f}..{out.max()*1e3:.1f} mm outside")
    return lines
