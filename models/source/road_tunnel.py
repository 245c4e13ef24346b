"""The tunnel: portals, lining, walkways, lamps, and the dry air inside."""
import numpy as np

import road_route as route
import road_terrain as terrain
from road_mesh import Mesh, Chunks, lamp, local, place, shelter

HALF_M, SPRING_M, CROWN_M = 5.4, 2.6, 6.3
_STEP_M = 10.0
_PANEL_M = 2.6


def _arch():
    """Points (d, h) of the vault from the right springing to the left one."""
    a = np.linspace(0, np.pi, 13)
    return np.stack([-HALF_M * np.cos(a), SPRING_M + (CROWN_M - SPRING_M) * np.sin(a)], axis=1)


def _sweep(mesh, s, profile, material, tile_m, flip):
    """A profile (d, h) drawn along the road between stations s."""
    profile = np.asarray(profile, float)
    grid = route.point(s[:, None], profile[None, :, 0], profile[None, :, 1])
    around = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
    uv = np.stack(np.broadcast_arrays(s[:, None] / tile_m, around[None] / tile_m), axis=-1)
    mesh.grid(grid, material, uv, flip)


def _lining(chunks):
    for first in np.arange(route.TUNNEL_IN, route.TUNNEL_OUT, _STEP_M):
        s, mesh = np.array([first, first + _STEP_M / 2, first + _STEP_M]), chunks.at(first)
        _sweep(mesh, s, _arch(), "concrete_vault", 5.0, True)
        for side in (-1, 1):
            wall = [(side * HALF_M, 0.1), (side * HALF_M, _PANEL_M)]
            _sweep(mesh, s, wall, "tiles", 2.6, side < 0)
            walk = [(side * HALF_M, 0.16), (side * EDGE, 0.16), (side * EDGE, -0.1)]
            _sweep(mesh, s, walk, "kerb", 2.0, side > 0)
            rail = [(side * (HALF_M - 0.02), _PANEL_M), (side * (HALF_M - 0.14), _PANEL_M), (side * (HALF_M - 0.14), _PANEL_M + 0.16)]
            _sweep(mesh, s, rail, "steel_dark", 1.0, side < 0)


EDGE = 4.05


def _portal(s, facing):
    """The head wall in front of the hill. facing: -1 looks back along the road (entry), +1 ahead (exit)."""
    mesh = Mesh()
    top = float(terrain.at(s - facing * 1.0, 0.0)[2] - route.height(s)) + 0.5
    frame = route.frame(s, turn=0.0 if facing < 0 else np.pi)
    thick = 0.9
    arch = _arch()
    levels = np.concatenate([[-0.8, 0.6, SPRING_M], arch[1:7, 1]])
    inner = np.concatenate([[HALF_M] * 3, -arch[1:7, 0]])
    outer = 8.3 + np.maximum(levels, 0) / 0.75
    for side in (-1, 1):
        grid = np.zeros((len(levels), 2, 3))
        grid[:, 0, 1], grid[:, 1, 1] = side * inner, side * outer
        grid[:, :, 2] = levels[:, None]
        mesh.grid(local(frame, grid.reshape(-1, 3)).reshape(grid.shape), "concrete", grid[..., 1:] / 4.0, side < 0)
    wide = 8.3 + top / 0.75
    corners = [(0, outer[-1], CROWN_M), (0, -outer[-1], CROWN_M), (0, -wide, top), (0, wide, top)]
    mesh.add(local(frame, corners), [(0, 1, 2, 3)], "concrete", np.array(corners)[:, 1:] * [-1, 1] / 4.0)
    mesh.box(frame, (-0.25, -wide, top), (thick, wide, top + 0.35), "concrete", 4.0)
    _ring(mesh, frame)
    for side in (-1, 1):
        ends = sorted((side * (EDGE - 0.02), side * (HALF_M + 0.1)), reverse=True)
        mesh.quad(local(frame, [(0.02, ends[0], -0.3), (0.02, ends[1], -0.3), (0.02, ends[1], 0.165), (0.02, ends[0], 0.165)]), "kerb")
    mesh.box(frame, (0.6, -wide, top - 2.0), (0.9, wide, top), "concrete", 4.0, skip="xzZyY")
    place("portal_in" if facing < 0 else "portal_out", mesh.data("portal"))


def _ring(mesh, frame):
    """A raised frame around the mouth."""
    a = np.linspace(0, np.pi, 17)
    wide, high = HALF_M + 0.55, CROWN_M - SPRING_M + 0.55
    path = np.concatenate([[(HALF_M, -0.5)], np.stack([HALF_M * np.cos(a), SPRING_M + (CROWN_M - SPRING_M) * np.sin(a)], 1), [(-HALF_M, -0.5)]])
    rim = np.concatenate([[(wide, -0.5)], np.stack([wide * np.cos(a), SPRING_M + high * np.sin(a)], 1), [(-wide, -0.5)]])
    out = -0.22
    rows = [np.column_stack([np.full(len(p), x), p]) for p, x in ((path, 0.3), (path, out), (rim, out), (rim, 0.0))]
    grid = np.stack([local(frame, r) for r in rows], axis=1)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    uv = np.stack(np.broadcast_arrays(length[:, None] / 4, np.array([0, 0.13, 0.27, 0.33])[None]), axis=-1)
    mesh.grid(grid, "plaster_grey", uv, True)


def _lamp_mesh():
    """A strip lamp under the vault, with hangers; its light comes from the lower face."""
    mesh, frame = Mesh(), (np.zeros(3), np.eye(3))
    mesh.box(frame, (-0.75, -0.16, 0.0), (0.75, 0.16, 0.14), "steel_dark", skip="z")
    mesh.quad([(-0.72, 0.13, -0.005), (0.72, 0.13, -0.005), (0.72, -0.13, -0.005), (-0.72, -0.13, -0.005)], "lamp_warm")
    for x in (-0.6, 0.6):
        mesh.box(frame, (x - 0.02, -0.02, 0.14), (x + 0.02, 0.02, 0.8), "steel_dark", skip="zZ")
    return mesh.data("tunnel_lamp")


def _lamps():
    """Lamps close together at the mouths, where eyes come from daylight, wider inside; every second pair gives light."""
    data = _lamp_mesh()
    length = route.TUNNEL_OUT - route.TUNNEL_IN
    offsets = np.array([4, 10, 16, 23, 31, 40, 50, 60, 70, 80, 90])
    for s in sorted(set(route.TUNNEL_IN + offsets) | set(route.TUNNEL_OUT - offsets)):
        for d in (-2.3, 2.3):
            place(f"tunnel_lamp_{s:.0f}_{'r' if d < 0 else 'l'}", data, route.frame(s, d, 5.15))
    for k, s in enumerate(np.linspace(route.TUNNEL_IN + 6, route.TUNNEL_OUT - 6, 12)):
        lamp(f"tunnel_light_{k}", route.frame(s, -1.2 if k % 2 else 1.2, 5.05), 3000.0, 26.0, (1.0, 0.84, 0.62), 172.0, 0.3)
    assert length > 150


def _exit_signs(chunks):
    for s in np.arange(route.TUNNEL_IN + 25, route.TUNNEL_OUT - 10, 32.5):
        for side in (-1, 1):
            frame = route.frame(s, side * (HALF_M - 0.03), 1.1)
            chunks.at(s).box(frame, (-0.3, -0.03, 0), (0.3, 0.03, 0.3), "exit_green")


def _shelters():
    """Two hulls, one overlapping the other; floor to above the vault, walls to inside the rock. The bend makes a hull wider on its
    inner side, by a metre in the middle, which is rock. Few pieces: a renderer that measures light in each need not blend many."""
    middle = 0.5 * (route.TUNNEL_IN + route.TUNNEL_OUT)
    for k, (first, last) in enumerate(((route.TUNNEL_IN, middle + 3.0), (middle - 3.0, route.TUNNEL_OUT))):
        corners = [route.point(s, d, h) for s in np.linspace(first, last, 4)
                   for d in (-HALF_M - 0.7, HALF_M + 0.7) for h in (-1.0, CROWN_M + 0.6)]
        shelter(f"tunnel_{k}", corners)


def build():
    chunks = Chunks("tunnel", 60.0)
    _lining(chunks)
    _exit_signs(chunks)
    chunks.build()
    _portal(route.TUNNEL_IN, -1)
    _portal(route.TUNNEL_OUT, 1)
    _lamps()
    _shelters()
