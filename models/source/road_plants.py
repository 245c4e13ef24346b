"""Trees, bushes, hedges and grass: few meshes, many places; forest edges as upright pictures further off."""
import numpy as np

import road_route as route
import road_terrain as terrain
from road_foliage import leaf_uv
from road_mesh import Chunks, Mesh, place
from road_village import PLOTS


def _card(mesh, centre, right, up, tile, middle, lift=0.25):
    """A leaf card; its normals point out of the crown's middle, so that the crown is lit as one round body."""
    centre, right, up = (np.asarray(v, float) for v in (centre, right, up))
    corners = np.array([centre - right - up, centre + right - up, centre + right + up, centre - right + up])
    normals = corners - middle
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    normals[:, 2] += lift
    mesh.quad(corners, "leaves", leaf_uv(tile), normals / np.linalg.norm(normals, axis=1, keepdims=True))


def _basis(out, rng, wild):
    """Right and up of a card that looks roughly outwards."""
    n = out / (np.linalg.norm(out) + 1e-9) + rng.normal(0, wild, 3)
    n /= np.linalg.norm(n)
    right = np.cross(rng.normal(0, 1, 3), n)
    right /= np.linalg.norm(right)
    return right, np.cross(n, right)


def _crown(mesh, rng, middle, radii, cards, size, tile, dark):
    """Leaf cards over an ellipsoid, dark ones inside."""
    middle, radii = np.asarray(middle, float), np.asarray(radii, float)
    for k in range(cards):
        z = 1 - 2 * (k + 0.5) / cards
        a = k * 2.39996 + rng.normal(0, 0.2)
        out = np.array([np.sqrt(1 - z * z) * np.cos(a), np.sqrt(1 - z * z) * np.sin(a), z])
        depth = rng.uniform(0.35, 0.6) if k % 4 == 0 else rng.uniform(0.72, 1.0)
        right, up = _basis(out, rng, 0.65)
        half = size * rng.uniform(0.8, 1.2)
        _card(mesh, middle + out * radii * depth, right * half, up * half, dark if k % 4 == 0 or z < -0.55 else tile, middle)


def _trunk(mesh, rng, height, radius, material, branches, reach):
    sway = np.cumsum(rng.normal(0, 0.12, (5, 2)), axis=0)
    z = np.linspace(0, height, 5)
    line = np.column_stack([sway * (z / height)[:, None], z])
    line[0, 2] = -0.4
    mesh.tube(line, radius * np.array([1.35, 1.0, 0.8, 0.6, 0.35]), 6, material, 1.5)
    for k in range(branches):
        a, start = k * 2.4 + rng.normal(0, 0.3), line[2 + k % 2]
        tip = start + np.array([np.cos(a) * reach, np.sin(a) * reach, reach * 1.1])
        mesh.tube([start, 0.5 * (start + tip) + [0, 0, 0.2], tip], radius * np.array([0.5, 0.35, 0.15]), 4, material, 1.5)


def _broadleaf(seed, height, wide, cards, tile="broad", dark="broad_dark"):
    mesh, rng = Mesh(), np.random.default_rng(seed)
    _trunk(mesh, rng, height * 0.72, height * 0.026, "bark", 5, wide * 0.5)
    parts = 8
    for k in range(parts):
        t = k / (parts - 1)
        a = k * 2.39996 + rng.normal(0, 0.3)
        off = np.array([np.cos(a), np.sin(a), 0]) * wide * 0.58 * np.sqrt(1 - t) * rng.uniform(0.75, 1.15)
        level, size = height * (0.42 + 0.42 * t + 0.03 * rng.normal()), wide * rng.uniform(0.43, 0.58) * (1 - 0.25 * t)
        _crown(mesh, rng, off + [0, 0, level], (size, size, 0.8 * size), cards // parts, 0.53 * size, tile, dark)
    return mesh.data(f"tree_{seed}")


def _birch(seed):
    mesh, rng = Mesh(), np.random.default_rng(seed)
    _trunk(mesh, rng, 10.5, 0.13, "bark_birch", 4, 1.0)
    for level, wide in ((3.9, 1.4), (5.3, 2.0), (6.8, 2.1), (8.3, 1.7), (9.7, 1.2), (10.9, 0.7)):
        _crown(mesh, rng, (rng.normal(0, 0.3), rng.normal(0, 0.3), level), (wide, wide, 1.2), 19, 0.78, "birch", "broad")
    return mesh.data(f"birch_{seed}")


def _spruce(seed, height):
    """Whorls of drooping boughs around a dark core, so that no sky shows through the middle."""
    mesh, rng = Mesh(), np.random.default_rng(seed)
    mesh.tube([(0, 0, -0.4), (0, 0, 0.25 * height)], [0.2, 0.15], 5, "bark", 1.5)
    _spruce_core(mesh, height)
    tiers = 13
    for tier in range(tiers):
        t = tier / (tiers - 1)
        reach, level = (0.22 * (1 - t) ** 0.9 + 0.045) * height * rng.uniform(0.9, 1.1), height * (0.11 + 0.83 * t)
        count = 7 if t < 0.75 else 5
        for k in range(count):
            a = k * 2 * np.pi / count + tier * 0.9 + rng.normal(0, 0.15)
            out, across = np.array([np.cos(a), np.sin(a), 0]), np.array([-np.sin(a), np.cos(a), 0])
            along = (out * 0.92 + [0, 0, -0.42 + 0.25 * t]) * reach / 2 * rng.uniform(0.85, 1.15)
            side = across * reach * (0.34 if k % 2 else -0.34) + np.array([0, 0, max(0.30 * reach, 0.045 * height)])
            _card(mesh, np.array([0, 0, level]) + along, along, side, "spruce_dark" if (k + tier) % 3 == 0 else "spruce",
                  np.array([0, 0, level - 0.35 * height * (1 - t) - 0.4]))
    for a in (0.3, 1.9):
        across = np.array([np.cos(a), np.sin(a), 0.0])
        _card(mesh, (0, 0, 0.955 * height), (0, 0, 0.075 * height), across * 0.045 * height, "spruce", np.array([0, 0, 0.6 * height]))
    return mesh.data(f"spruce_{seed}")


def _spruce_core(mesh, height):
    a = np.linspace(0, 2 * np.pi, 8)
    z, r = np.array([0.07, 0.10, 0.5, 0.97]) * height, np.array([0.03, 0.105, 0.062, 0.004]) * height
    grid = np.stack([np.cos(a)[None] * r[:, None], np.sin(a)[None] * r[:, None], np.broadcast_to(z[:, None], (4, 8))], axis=-1)
    u0, v0, u1, v1 = leaf_uv("spruce_dark", 0.36)
    uv = np.stack(np.broadcast_arrays(np.linspace(u0, u1, 8)[None], np.linspace(v0, v1, 4)[:, None]), axis=-1)
    mesh.grid(grid, "leaves", uv, True)


def _bush(seed, wide, tall):
    mesh, rng = Mesh(), np.random.default_rng(seed)
    _crown(mesh, rng, (0, 0, tall * 0.42), (wide, wide, tall * 0.5), 44, wide * 0.40, "bush", "broad_dark")
    return mesh.data(f"bush_{seed}")


def _hedge():
    """4 m of clipped hedge along x."""
    mesh, rng = Mesh(), np.random.default_rng(77)
    u0, v0, u1, v1 = leaf_uv("bush", 0.3)
    for y in (-0.4, 0.4):
        a, b = (2.0, -2.0) if y > 0 else (-2.0, 2.0)
        for k in range(2):
            p, q = a + (b - a) * k / 2, a + (b - a) * (k + 1) / 2
            mesh.quad([(p, y, -0.3), (q, y, -0.3), (q, y, 1.35), (p, y, 1.35)], "leaves", (u0, v0, u1, v1))
    for x, y in ((-2.0, 0.4), (2.0, -0.4)):
        mesh.quad([(x, y, -0.3), (x, -y, -0.3), (x, -y, 1.35), (x, y, 1.35)], "leaves", (u0, v0, u1, v1))
    mesh.quad([(-2, -0.4, 1.35), (2, -0.4, 1.35), (2, 0.4, 1.35), (-2, 0.4, 1.35)], "leaves", (u0, v0, u1, v1))
    for k in range(16):
        spot = np.array([rng.uniform(-2, 2), rng.choice([-0.42, 0.42, 0.0]), 0])
        spot[2] = 1.35 if spot[1] == 0 else rng.uniform(0.3, 1.2)
        right, up = _basis(np.array([0, spot[1], 0.5 if spot[1] == 0 else 0.1]), rng, 0.25)
        _card(mesh, spot, right * 0.45, up * 0.45, "bush", np.array([spot[0], 0, 0.6]))
    return mesh.data("hedge")


# Stretches of planting: first s, last s, side, nearest and furthest d, how many, kinds.
STANDS = [(-190, 95, 1, 16, 46, 20, "ooqb"), (-190, 95, -1, 10, 44, 24, "oqqbs"), (20, 98, -1, 8.5, 13, 8, "uuq"), (-150, 100, 1, 8.5, 12, 12, "uu"),
          (110, 325, 1, 27, 55, 17, "oqbu"), (110, 325, -1, 27, 55, 17, "oqbu"), (125, 320, 1, 8.5, 12, 9, "ubu"), (125, 320, -1, 8.5, 12, 9, "uub"),
          (332, 346, 1, 13, 40, 6, "uoq"), (332, 346, -1, 13, 40, 6, "uqo"), (365, 470, 1, 12, 50, 16, "oqsb"), (365, 470, -1, 11, 50, 18, "osqb"),
          (366, 540, -1, 8.8, 11, 8, "uu"), (470, 545, 1, 22, 55, 16, "ssoq"), (470, 545, -1, 22, 55, 16, "ssob"),
          (552, 728, 1, 3, 55, 24, "ssoq"), (552, 728, -1, 3, 55, 24, "ssoq"), (736, 800, 1, 24, 55, 12, "ssq"), (736, 800, -1, 24, 55, 12, "sso"),
          (790, 960, 1, 12, 45, 22, "osqb"), (790, 975, -1, 12, 48, 24, "sqob"), (800, 960, 1, 8.8, 12, 6, "uu"),
          (985, 1150, 1, 12, 40, 14, "oqbu"), (1000, 1130, -1, 47, 60, 18, "osqb"), (1096, 1146, -1, 10, 44, 34, "uuqbu"),
          (968, 1000, -1, 12, 44, 16, "uuqb"), (1150, 1220, -1, 11, 40, 10, "oqb"),
          (1160, 1400, 1, 12, 50, 16, "oqb"), (1250, 1450, -1, 16, 55, 14, "oqbs"), (1420, 1600, 1, 10, 45, 18, "sosq"),
          (1480, 1700, -1, 17, 55, 12, "oqb"), (1620, 1950, 1, 10, 55, 24, "ossqb"), (1720, 1950, -1, 16, 55, 18, "ossq")]
# Rows of trees at even spacing (an avenue): first s, last s, d, spacing, kind.
ROWS = [(-150, 98, -9.6, 19, "o"), (1210, 1400, 9.8, 18, "q"), (1560, 1740, -9.8, 18, "b")]


def _is_free(s, d, wide):
    """Whether a plant of that radius keeps clear of road, crossing road, houses and forecourt."""
    over_tunnel = route.TUNNEL_IN + 3 < s < route.TUNNEL_OUT - 3
    if abs(d) < 7.6 + wide * 0.35 and not over_tunnel:
        return False
    if abs(s - route.BRIDGE_S) < 13 + wide and abs(d) < 190:
        return False
    if route.FORECOURT_IN - 12 < s < route.FORECOURT_OUT + 12 and route.forecourt_edge(s) - 1.2 - 0.5 * wide < d < 0:
        return False
    return all(max(abs(s - hs), abs(d - hd)) > 7.5 + 0.4 * wide for hs, hd, *_ in PLOTS)


def _kinds():
    return {"o": ([_broadleaf(1, 12.0, 4.4, 176), _broadleaf(2, 10.0, 4.0, 152)], 3.5), "q": ([_broadleaf(3, 7.5, 2.8, 104), _broadleaf(13, 8.6, 2.9, 104)], 2.5),
            "b": ([_birch(4), _birch(5)], 2.0), "s": ([_spruce(6, 13.0), _spruce(7, 10.5)], 2.3), "u": ([_bush(8, 1.3, 1.7), _bush(9, 1.8, 2.2)], 1.2)}


class _Planter:
    def __init__(self):
        self.kinds, self.taken, self.count = _kinds(), [], 0

    def put(self, s, d, kind, rng):
        data, wide = self.kinds[kind]
        if not _is_free(s, d, wide):
            return
        where = terrain.at(s, d)
        if any(np.hypot(where[0] - x, where[1] - y) < 0.62 * (wide + w) for x, y, w in self.taken):
            return
        self.taken.append((where[0], where[1], wide))
        axes = route.frame(s, turn=rng.uniform(0, 6.283))[1]
        place(f"plant_{self.count}", data[rng.integers(len(data))], (where - [0, 0, 0.15], axes), rng.uniform(0.8, 1.25))
        self.count += 1


def _stands(planter):
    for k, (first, last, side, near, far, count, kinds) in enumerate(STANDS):
        rng = np.random.default_rng(1000 + k)
        for _ in range(count):
            s, d = rng.uniform(first, last), side * (near + (far - near) * rng.random() ** 1.4)
            planter.put(s, d, kinds[rng.integers(len(kinds))], rng)


def _rows(planter):
    for k, (first, last, d, spacing, kind) in enumerate(ROWS):
        rng = np.random.default_rng(2000 + k)
        for s in np.arange(first, last, spacing):
            planter.put(s + rng.normal(0, 0.6), d + rng.normal(0, 0.3), kind, rng)


def _hedges():
    data = _hedge()
    for first, last, d in ((128, 180, -7.2), (222, 250, 7.4), (270, 318, -7.2), (992, 1030, -46.5), (1090, 1130, -46.5), (1290, 1420, -7.8)):
        for s in np.arange(first, last, 3.95):
            if any(abs(s - hs) < 3.5 and d * hd > 0 and abs(hd) < 30 for hs, hd, *_ in PLOTS):
                continue
            place(f"hedge_{s:.0f}_{d:.0f}", data, (terrain.at(s, d), route.frame(s)[1]))


def _both_sides(mesh, corners, material, uv, normal=None):
    """An upright card seen from either side, lit alike: normals as given, or half up and half towards the viewer."""
    corners = np.asarray(corners, float)
    out = np.cross(corners[1] - corners[0], corners[3] - corners[0])
    out /= np.linalg.norm(out)
    for order, side in (((0, 1, 2, 3), 1), ((1, 0, 3, 2), -1)):
        facing = np.asarray(normal) if normal is not None else side * out + [0, 0, 0.7]
        u0, v0, u1, v1 = uv
        mesh.quad(corners[list(order)], material, (u0, v0, u1, v1) if side > 0 else (u1, v0, u0, v1), np.tile(facing / np.linalg.norm(facing), (4, 1)))


def _tufts(chunks):
    """Taller grass on verge and ditch: pairs of crossing cards, normals up so that they melt into the ground."""
    rng = np.random.default_rng(55)
    for s in np.arange(-60, 1800, 1.0):
        side = rng.choice([-1, 1])
        d, s = side * (5.3 + 3.6 * rng.random()), s + rng.uniform(-1, 1)
        wet = route.VILLAGE_IN - 8 < s < route.VILLAGE_OUT + 8 or route.TUNNEL_IN - 6 < s < route.TUNNEL_OUT + 6
        if wet or abs(s - route.BRIDGE_S) < 12 or (d < 0 and route.FORECOURT_IN - 10 < s < route.FORECOURT_OUT + 10):
            continue
        foot, size = terrain.at(s, d), rng.uniform(0.22, 0.55)
        a = rng.uniform(0, 3.14)
        for turn in (0.0, 1.57):
            right = np.array([np.cos(a + turn), np.sin(a + turn), 0]) * size
            up = np.array([0, 0, size * rng.uniform(0.7, 1.1)])
            corners = [foot - right - [0, 0, 0.05], foot + right - [0, 0, 0.05], foot + right + up, foot - right + up]
            tile = leaf_uv("reed" if rng.random() < 0.15 else "grass")
            _both_sides(chunks.at(s), corners, "leaves_upright", tile, [0.0, 0.0, 1.0])


def _forest_card(chunks, s0, s1, d0, d1, tall, rng, low_end=None):
    """An upright picture of a forest's edge between two places beside the road; low_end: the end (0, 1) where the trees are young."""
    a, b = terrain.at(s0, d0), terrain.at(s1, d1)
    long = np.linalg.norm((b - a)[:2])
    u0 = rng.random()
    up = [np.array([0, 0, tall * (0.35 if low_end == end else 1.0)]) for end in (0, 1)]
    low = np.array([0, 0, 2.0])
    _both_sides(chunks.at(min(s0, s1)), [a - low, b - low, b + up[1], a + up[0]], "forest", (u0, 0.0, u0 + long / (4.4 * tall), 0.99))


def _forest(chunks):
    """Woods on both sides beyond the strip: edge, and rows behind and across so that they have depth from every side."""
    rng = np.random.default_rng(66)
    woods = [(-190, 60, 1, 75), (-190, -20, -1, 95), (110, 330, 1, 120), (90, 300, -1, 130), (380, 560, 1, 66), (380, 560, -1, 66),
             (560, 730, 1, 64), (560, 730, -1, 64), (730, 960, 1, 70), (720, 990, -1, 75), (1010, 1140, -1, 66), (1000, 1180, 1, 110),
             (1230, 1420, -1, 85), (1300, 1480, 1, 140), (1480, 1750, 1, 75), (1560, 1780, -1, 120), (1700, 1950, 1, 66), (1760, 1950, -1, 66)]
    for first, last, side, near in woods:
        for row, back in enumerate((0, 22, 50)):
            s = np.arange(first - 4 * row, last, 34.0)
            for k, (a, b) in enumerate(zip(s[:-1], s[1:])):
                d = side * (near + back + rng.uniform(-5, 5, 2))
                _forest_card(chunks, a, b + 3, d[0], d[1], rng.uniform(12, 15), rng, 0 if k == 0 else 1 if k == len(s) - 2 else None)
        for s in (first, 0.5 * (first + last), last - 6):
            _forest_card(chunks, s, s + rng.uniform(-8, 8), side * (near - 4), side * (near + 70), 13, rng)


def build(furniture):
    planter = _Planter()
    _rows(planter)
    _stands(planter)
    _hedges()
    _tufts(furniture)
    forest = Chunks("forest", 150.0)
    _forest(forest)
    forest.build()
    return planter.count
