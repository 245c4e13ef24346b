"""The ground: heights everywhere, a strip along the road, fields beyond, and hills at the horizon."""
import numpy as np

import road_route as route
from road_mesh import Mesh, place

STRIP_M = 60.0
_ACROSS = np.array([3.9, 4.5, 5.3, 6.7, 8.4, 11.0, 15.0, 21.0, 30.0, 43.0, 60.0])
_TILE_M = {"grass": 5.0, "meadow": 14.0, "crop": 12.0, "soil": 12.0}
_HILL = [(440, 0), (490, 3), (550, 9.2), (590, 16), (640, 23), (690, 17), (730, 9.2), (780, 4), (850, 0)]


def undulation(x, y):
    return (2.4 * np.sin(x / 190 + 1.0) * np.cos(y / 230) + 1.6 * np.sin((x + 2 * y) / 310) + 0.5 * np.sin(x / 57 + y / 71)
            + 0.35 * np.sin(y / 33 - x / 90))


def hill(s, d):
    """The ridge that the tunnel goes through."""
    reach = 1 - route.smoothstep((np.abs(d) - 150) / 330)
    swell = 1 + 0.35 * np.sin(d / 95.0 + 0.6) * route.smoothstep(np.abs(d) / 80)
    return np.interp(s, *np.array(_HILL).T) * reach * swell


def _ditch_depth(s, d):
    """1 where a ditch runs beside the road, 0 where pavements or the forecourt are."""
    def outside(first, last, blend=12.0):
        return 1 - route.smoothstep((s - first + blend) / blend) * (1 - route.smoothstep((s - last) / blend))
    depth = outside(route.VILLAGE_IN - 5, route.VILLAGE_OUT + 5) * outside(route.TUNNEL_IN - 12, route.TUNNEL_OUT + 12)
    depth = depth * outside(route.BRIDGE_S - 9, route.BRIDGE_S + 9)
    return np.where(d < 0, depth * outside(route.FORECOURT_IN - 6, route.FORECOURT_OUT + 6), depth)


def ground(x, y, s, d, over_tunnel):
    """Height of the ground at world (x, y), which lies at (s, d) by the road; over_tunnel: on the hill, not in its cutting."""
    reach = np.abs(d)
    road = route.height(np.clip(s, route.S_FIRST, route.S_LAST))
    near = 1 - route.smoothstep((reach - 14) / 190)
    out = road * near + (1.5 + undulation(x, y)) * (1 - near) + hill(s, d)
    out = out + 0.18 * np.sin(x / 7.3 + y / 9.1) * route.smoothstep((reach - 9) / 10)
    cut = road + np.maximum(reach - 7.4, 0) * 0.75
    out = np.where(over_tunnel, out, np.minimum(out, cut))
    side = np.interp(reach, [3.5, 4.4, 5.3, 6.7, 8.4, 11.5], [-0.05, -0.05, -0.12, -0.60, -0.15, 0.0])
    flat = np.interp(reach, [3.5, 8.0], [-0.05, 0.0])
    depth = _ditch_depth(s, d)
    out = np.where(over_tunnel, out, out + side * depth + flat * (1 - depth))
    pad = (d < 0) * route.smoothstep((48 - reach) / 8) * route.smoothstep((s - 965) / 14) * (1 - route.smoothstep((s - 1146) / 14))
    return out * (1 - pad) + (road - 0.12) * pad


def at(s, d):
    """World point on the ground by the road."""
    p = route.point(s, d)
    over = (np.asarray(s) > route.TUNNEL_IN) & (np.asarray(s) < route.TUNNEL_OUT)
    p[..., 2] = ground(p[..., 0], p[..., 1], np.asarray(s, float), np.asarray(d, float), over)
    return p


def _strip(chunks, first, last, across, over):
    """One side's grass between two stations of the road (or the hill's top over the tunnel)."""
    s = np.arange(first, last + 0.1, 10.0)
    grid = route.point(s[:, None], across[None, :])
    sd = np.broadcast_arrays(s[:, None], across[None, :])
    grid[..., 2] = ground(grid[..., 0], grid[..., 1], sd[0], sd[1], over)
    edge = np.abs(across) > STRIP_M
    grid[:, edge, 2] -= 2.5
    chunks.at(first).grid(grid, "grass", grid[..., :2] / _TILE_M["grass"])


def _strips(chunks):
    outer = np.concatenate([_ACROSS, [STRIP_M + 5]])
    over_top = np.concatenate([-outer[:4:-1], [0.0], outer[5:]])
    for first in np.arange(route.S_FIRST, route.S_LAST, 10.0):
        if route.TUNNEL_IN <= first < route.TUNNEL_OUT:
            _strip(chunks, first, first + 10, over_top, True)
        else:
            _strip(chunks, first, first + 10, outer, False)
            _strip(chunks, first, first + 10, -outer[::-1], False)


def _axis(low, high, far_low, far_high, step):
    """Grid lines: even between low and high, wider and wider beyond."""
    lines = list(np.arange(low, high + step, step))
    for sign, limit in ((1, far_high), (-1, far_low)):
        gap = step
        while (lines[-1] < limit) if sign > 0 else (lines[0] > limit):
            gap *= 1.35
            lines.append(lines[-1] + gap) if sign > 0 else lines.insert(0, lines[0] - gap)
    return np.array(lines)


def _field(i, j):
    """Which crop grows on a cell: blocks of cells are fields."""
    a = i // 9 + (j // 6) * 7
    kind = (a * 2654435761 >> 7) % 10
    return "crop" if kind in (1, 6) else "soil" if kind == 4 else "meadow"


def _fields():
    """Ground away from the road; below the strip where both lie, so that no gap opens."""
    line = route.point(np.arange(route.S_FIRST, route.S_LAST, 20.0))
    x = _axis(line[:, 0].min() - 80, line[:, 0].max() + 80, line[:, 0].min() - 700, line[:, 0].max() + 700, 20.0)
    y = _axis(line[:, 1].min() - 140, line[:, 1].max() + 140, line[:, 1].min() - 750, line[:, 1].max() + 750, 20.0)
    gx, gy = np.meshgrid(x, y, indexing="ij")
    s, d = route.nearest(gx, gy)
    over = (s >= route.TUNNEL_IN) & (s <= route.TUNNEL_OUT)
    z = ground(gx, gy, s, d, over) - 2.5 * (1 - route.smoothstep((np.abs(d) - 50) / 10))
    points = np.stack([gx, gy, z], axis=-1)
    block = 24
    for i0 in range(0, len(x) - 1, block):
        for j0 in range(0, len(y) - 1, block):
            _field_block(points, np.abs(d), s, i0, min(i0 + block, len(x) - 1), j0, min(j0 + block, len(y) - 1))
    return points


def _field_block(points, reach, s, i0, i1, j0, j1):
    mesh = Mesh()
    part = points[i0:i1 + 1, j0:j1 + 1]
    columns = j1 - j0 + 1
    kinds = {}
    for i in range(i0, i1):
        for j in range(j0, j1):
            if reach[i:i + 2, j:j + 2].min() > 29.0 or not route.S_FIRST + 5 < s[i, j] < route.S_LAST - 25:
                a = (i - i0) * columns + (j - j0)
                kinds.setdefault(_field(i, j), []).append((a, a + columns, a + columns + 1, a + 1))
    for kind, faces in kinds.items():
        mesh.add(part, faces, kind, part[..., :2].reshape(-1, 2) / _TILE_M[kind])
    if kinds:
        name = f"fields_{i0}_{j0}"
        place(name, mesh.data(name, 180))


def _horizon(points):
    """Hills all round: rings from the fields' border outwards."""
    border = np.concatenate([points[:, 0], points[-1, 1:], points[-2::-1, -1], points[0, -2:0:-1]])
    border = np.concatenate([border, border[:1]])
    centre = border[:, :2].mean(axis=0)
    out = border[:, :2] - centre
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    angle = np.arctan2(out[:, 1], out[:, 0])
    crest = 62 + 26 * np.sin(3 * angle + 1) + 17 * np.sin(7 * angle + 2) + 9 * np.sin(17 * angle) + 5 * np.sin(31 * angle + 1)
    rings = [border]
    for outward, rise in ((160, 0.10), (330, 0.42), (520, 0.80), (760, 1.0), (1100, 0.75)):
        ring = np.concatenate([border[:, :2] + out * outward, (crest * rise)[:, None]], axis=1)
        ring[:, 2] += (1 - rise) * border[:, 2] + 4 * np.sin(angle * 60 + outward) * rise
        rings.append(ring)
    grid = np.stack(rings, axis=1)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(border[:, :2], axis=0), axis=1))])
    uvs = np.stack(np.broadcast_arrays(length[:, None] / 120, np.arange(6) * 1.6), axis=-1)
    quarter = len(border) // 8 + 1
    for k in range(0, len(border) - 1, quarter):
        mesh = Mesh()
        mesh.grid(grid[k:k + quarter + 1], "far_woods", uvs[k:k + quarter + 1], flip=True)
        place(f"horizon_{k}", mesh.data(f"horizon_{k}", 180))


def build(chunks):
    _strips(chunks)
    _horizon(_fields())
