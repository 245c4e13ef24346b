"""The petrol station: forecourt, canopy, pumps, shop, price sign, and the dry air under the roofs."""
import numpy as np

import road_route as route
from road_mesh import Mesh, lamp, local, place, shelter
from road_textures import tile_uv

_MIDDLE = sum(route.CANOPY_S) / 2
_UNDERSIDE, _TOP = 5.0, 5.95
_ISLANDS_D = (-11.9, -19.4)
# The shop's box in the station's frame: x along the road, y to the left.
_SHOP = ((-15.0, -42.0, 0.0), (15.0, -31.5, 4.3))


def _frame():
    return route.frame(_MIDDLE)


def _forecourt(mesh):
    """Paved ground between the road and the shop, widening and narrowing smoothly."""
    s = np.arange(974.0, 1146.1, 4.0)
    d = -3.9 + (route.forecourt_edge(s) + 3.9)[:, None] * np.linspace(0, 1, 4)[None]
    grid = route.point(s[:, None], d, -0.006)
    uv = np.stack(np.broadcast_arrays(d / 3.5, s[:, None] / 7.0), axis=-1)
    mesh.grid(grid, "asphalt", uv, True)


def _kerbed(mesh, frame, outline, top_material, height=0.14):
    """A raised island with a kerb; outline counter-clockwise in the frame's x, y."""
    outline = np.asarray(outline, float)
    n = len(outline)
    low, high = np.column_stack([outline, np.full(n, -0.1)]), np.column_stack([outline, np.full(n, height)])
    for k in range(n):
        q = (k + 1) % n
        mesh.quad(local(frame, [low[k], low[q], high[q], high[k]]), "kerb", (0, 0, np.linalg.norm(outline[q] - outline[k]) / 2, 0.12))
    mesh.add(local(frame, high), [list(range(n))], top_material, local(frame, high)[:, :2] / 2.0)


def _rounded(x0, x1, y0, y1, r):
    a = np.linspace(0, np.pi / 2, 5)
    corners = [((x1 - r, y1 - r), 0), ((x0 + r, y1 - r), 1), ((x0 + r, y0 + r), 2), ((x1 - r, y0 + r), 3)]
    return [(cx + r * np.cos(v + k * np.pi / 2), cy + r * np.sin(v + k * np.pi / 2)) for (cx, cy), k in corners for v in a]


def _islands(mesh, frame):
    _kerbed(mesh, frame, _rounded(-34, 34, -7.3, -4.7, 1.25), "grass")
    for d in _ISLANDS_D:
        _kerbed(mesh, frame, _rounded(-7.5, 7.5, d - 0.65, d + 0.65, 0.6), "kerb", 0.16)
        for x in (-3.8, 3.8):
            _pump(mesh, frame, x, d)
        for x in (-6.6, 6.6):
            mesh.box(frame, (x - 0.2, d - 0.2, 0.1), (x + 0.2, d + 0.2, _UNDERSIDE + 0.1), "white", skip="zZ")


def _pump(mesh, frame, x, d):
    mesh.box(frame, (x - 0.5, d - 0.27, 0.14), (x + 0.5, d + 0.27, 1.95), "white", skip="yYz")
    mesh.box(frame, (x - 0.56, d - 0.3, 1.95), (x + 0.56, d + 0.3, 2.1), "steel_dark")
    for side in (-1, 1):
        y = d + side * 0.27
        ends = (x + 0.5, x - 0.5) if side > 0 else (x - 0.5, x + 0.5)
        mesh.quad(local(frame, [(ends[0], y, 0.14), (ends[1], y, 0.14), (ends[1], y, 1.95), (ends[0], y, 1.95)]), "details", tile_uv("pump"))
        for k in (-0.3, 0.0, 0.3):
            top, low = (x + k, y + side * 0.05, 1.25), (x + k * 1.2, y + side * 0.22, 0.45)
            mesh.tube(local(frame, [top, low, (x + k * 0.6, y + side * 0.10, 0.9)]), 0.022, 4, "black")


def _wrap(mesh, frame, low, high, z0, z1, tile, repeat_m):
    """A tile of the atlas repeated round the four sides of a box."""
    (x0, y0), (x1, y1) = low, high
    ring = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]
    for a, b in zip(ring[:-1], ring[1:]):
        _wall(mesh, frame, a, b, z0, z1, tile, repeat_m)


def _wall(mesh, frame, a, b, z0, z1, tile, repeat_m):
    a, b = np.asarray(a, float), np.asarray(b, float)
    count = max(int(round(np.linalg.norm(b - a) / repeat_m)), 1)
    for k in range(count):
        p, q = a + (b - a) * k / count, a + (b - a) * (k + 1) / count
        mesh.quad(local(frame, [(*p, z0), (*q, z0), (*q, z1), (*p, z1)]), "details", tile_uv(tile))


def _canopy(frame):
    mesh = Mesh()
    x, (y0, y1) = (route.CANOPY_S[1] - route.CANOPY_S[0]) / 2, route.CANOPY_D
    _wrap(mesh, frame, (-x, y0), (x, y1), _UNDERSIDE - 0.1, _TOP, "brand", 4.0)
    mesh.box(frame, (-x, y0, _UNDERSIDE), (x, y1, _TOP - 0.1), "canopy_white", 3.0, skip="xXyYZ")
    mesh.box(frame, (-x, y0, _UNDERSIDE), (x, y1, _TOP - 0.1), "gravel", 3.0, skip="xXyYz")
    for px in (-8.0, 0.0, 8.0):
        for py in (-12.5, -16.5, -20.5):
            corners = [(px - 0.7, py + 0.35, _UNDERSIDE - 0.03), (px + 0.7, py + 0.35, _UNDERSIDE - 0.03),
                       (px + 0.7, py - 0.35, _UNDERSIDE - 0.03), (px - 0.7, py - 0.35, _UNDERSIDE - 0.03)]
            mesh.quad(local(frame, corners), "lamp_white")
    place("canopy", mesh.data("canopy"))
    for k, (px, py) in enumerate((px, py) for px in (-8.0, 0.0, 8.0) for py in (-12.5, -20.5)):
        place_at = (local(frame, [(px, py, _UNDERSIDE - 0.15)])[0], frame[1])
        lamp(f"canopy_light_{k}", place_at, 2500.0, 24.0, (1.0, 0.96, 0.88), 160.0)


def _shop(frame):
    mesh = Mesh()
    (x0, y0, z0), (x1, y1, z1) = _SHOP
    mesh.box(frame, _SHOP[0], _SHOP[1], "plaster_grey", 3.0, skip="zZ")
    mesh.box(frame, (x0 - 0.4, y0 - 0.4, z1 - 0.1), (x1 + 0.4, y1 + 1.6, z1 + 0.1), "steel_dark", skip="Z")
    mesh.box(frame, (x0 - 0.4, y0 - 0.4, z1 + 0.7), (x1 + 0.4, y1 + 1.6, z1 + 0.7), "gravel", 3.0, skip="xXyYz")
    _wrap(mesh, frame, (x0 - 0.4, y0 - 0.4), (x1 + 0.4, y1 + 1.6), z1 + 0.1, z1 + 0.75, "brand", 4.0)
    _wall(mesh, frame, (x1 - 4, y1 + 0.03), (x0 + 4, y1 + 0.03), 0.25, 3.1, "shop", 3.2)
    _wall(mesh, frame, (x0 - 0.03, y1 - 1.0), (x0 - 0.03, y1 - 7.0), 1.0, 3.0, "window", 2.0)
    mesh.box(frame, (x0 - 1, y1, -0.05), (x1 + 1, y1 + 2.6, 0.15), "paving", 2.4, skip="z")
    for x in (-11.5, 11.5):
        mesh.box(frame, (x - 0.6, y1 + 0.1, 0.15), (x + 0.6, y1 + 0.9, 1.7), "steel_dark")
    place("shop", mesh.data("shop"))


def _price_sign(frame):
    mesh = Mesh()
    x, y = -31.0, -6.0
    mesh.box(frame, (x - 0.15, y - 0.15, 0), (x + 0.15, y + 0.15, 6.4), "steel_dark", skip="z")
    mesh.box(frame, (x - 0.2, y - 1.25, 3.0), (x + 0.2, y + 1.25, 6.2), "steel_dark")
    for side in (-1, 1):
        a, b = (x + side * 0.22, y - side * 1.2), (x + side * 0.22, y + side * 1.2)
        _wall(mesh, frame, a, b, 3.05, 6.15, "price", 5.0)
    place("price_sign", mesh.data("price_sign"))


def _slab(mesh, frame):
    """Concrete below the canopy, a drain round it, parking bays before the shop, a kerb along the grass."""
    def patch(x0, x1, y0, y1, material, tile_m, lift):
        points = np.array([(x0, y0, lift), (x1, y0, lift), (x1, y1, lift), (x0, y1, lift)])
        mesh.add(local(frame, points), [(0, 1, 2, 3)], material, points[:, :2] / tile_m)
    patch(-13.5, 13.5, -26.0, -7.6, "concrete_dark", 6.0, 0.004)
    for y in (-26.0, -7.9):
        patch(-13.5, 13.5, y, y + 0.3, "steel_dark", 1.0, 0.008)
    for x in np.arange(-13.0, 13.1, 2.6):
        patch(x - 0.05, x + 0.05, -31.0 + 2.2, -26.4, "paint", 1.0, 0.003)
    s = np.arange(988.0, 1120.1, 4.0)
    profile_d, profile_h = np.array([0.12, 0.12, 0.0, -0.5]), np.array([-0.05, 0.13, 0.13, 0.02])
    grid = route.point(s[:, None], route.forecourt_edge(s)[:, None] + profile_d[None], profile_h[None])
    uv = np.stack(np.broadcast_arrays(s[:, None] / 2.0, np.array([0, 0.1, 0.17, 0.4])[None]), axis=-1)
    mesh.grid(grid, "kerb", uv, True)


def _details(mesh, frame):
    """Lane arrows, bollards and an air pump on the forecourt."""
    for d in (-15.6,):
        for x in (-30.0, 24.0):
            arrow = [(x, d - 0.08), (x + 2.0, d - 0.08), (x + 2.0, d - 0.35), (x + 3.2, d), (x + 2.0, d + 0.35), (x + 2.0, d + 0.08), (x, d + 0.08)]
            points = np.column_stack([np.array(arrow), np.full(len(arrow), 0.01)])
            mesh.add(local(frame, points), [list(range(7))], "paint", points[:, :2])
    for x in (-9.0, 9.0):
        for d in _ISLANDS_D:
            mesh.tube(local(frame, [(x * 0.8, d, 0.1), (x * 0.8, d, 0.95)]), 0.07, 6, "red")
    mesh.box(frame, (19.0, -30.0, 0), (19.5, -29.4, 1.5), "red", skip="z")


def build():
    frame, mesh = _frame(), Mesh()
    _forecourt(mesh)
    _slab(mesh, frame)
    _islands(mesh, frame)
    _details(mesh, frame)
    place("forecourt", mesh.data("forecourt"))
    _canopy(frame)
    _shop(frame)
    _price_sign(frame)
    x, (y0, y1) = (route.CANOPY_S[1] - route.CANOPY_S[0]) / 2, route.CANOPY_D
    shelter("canopy", local(frame, [(a, b, c) for a in (-x, x) for b in (y0, y1) for c in (-0.4, _UNDERSIDE + 0.5)]))
    (x0, y0, _), (x1, y1, z1) = _SHOP
    shelter("shop", local(frame, [(a, b, c) for a in (x0, x1) for b in (y0, y1) for c in (-0.4, z1)]))
