"""The concrete bridge that carries another road across at right angles, and the air below it."""
import numpy as np

import road_route as route
import road_terrain as terrain
from road_mesh import Mesh, local, place, shelter

ABUTMENT_D = 10.2
DECK_TOP = 6.6
_HALF = route.BRIDGE_HALF_WIDTH
# The crossing road's bank: half its top's width, and how steeply its sides fall.
_BANK_HALF, _BANK_SLOPE = 5.5, 10.0 / 16.0


def _frame():
    """Forward along our road, left along the crossing road, origin on our carriageway below the deck's middle."""
    return route.frame(route.BRIDGE_S)


def _deck(mesh, frame):
    end = ABUTMENT_D + 0.6
    low = route.BRIDGE_CLEARANCE
    mesh.box(frame, (-_HALF, -end, low + 0.45), (_HALF, end, DECK_TOP), "concrete", 4.0, skip="yYZ")
    for x in np.linspace(-4.6, 4.6, 5):
        mesh.box(frame, (x - 0.45, -end, low), (x + 0.45, end, low + 0.45), "concrete_dark", 4.0, skip="yYZ")
    mesh.box(frame, (-_HALF + 0.4, -end, DECK_TOP), (_HALF - 0.4, end, DECK_TOP + 0.02), "asphalt", 3.5, skip="xXyYz")
    for x in (-_HALF - 0.15, _HALF - 0.25):
        mesh.box(frame, (x, -end - 3, DECK_TOP - 0.35), (x + 0.4, end + 3, DECK_TOP + 0.25), "concrete", 4.0)
        _railing(mesh, frame, x + 0.2, end + 3)


def _railing(mesh, frame, x, end):
    for y in np.arange(-end + 0.3, end, 1.9):
        mesh.box(frame, (x - 0.03, y - 0.03, DECK_TOP + 0.25), (x + 0.03, y + 0.03, DECK_TOP + 1.15), "steel", skip="zZ")
    for z in (0.55, 0.85, 1.15):
        mesh.box(frame, (x - 0.025, -end, DECK_TOP + z - 0.03), (x + 0.025, end, DECK_TOP + z + 0.03), "steel", skip="yY")


def _abutments(mesh, frame):
    for side in (-1, 1):
        low, high = sorted((side * ABUTMENT_D, side * (ABUTMENT_D + 1.0)))
        mesh.box(frame, (-_HALF - 0.4, low, -1.0), (_HALF + 0.4, high, route.BRIDGE_CLEARANCE + 0.5), "concrete", 4.0, skip="z")
        for end in (-1, 1):
            _wing(mesh, frame, side, end)


def _wing(mesh, frame, side, end):
    """A wall beside the abutment that holds the embankment back; its top falls with the bank's slope."""
    x0, x1, d = end * (_HALF + 0.4), end * 16.2, side * ABUTMENT_D
    top = DECK_TOP - (_HALF + 0.4 - _BANK_HALF) * _BANK_SLOPE + 0.25
    front = np.array([(x0, d, -1.0), (x1, d, -1.0), (x1, d, 0.25), (x0, d, top)])
    cap = np.array([(x0, d, top), (x1, d, 0.25), (x1, d + side * 0.45, 0.25), (x0, d + side * 0.45, top)])
    order = [0, 1, 2, 3] if end * side > 0 else [3, 2, 1, 0]
    mesh.add(local(frame, front), [order], "concrete", front[:, [0, 2]] / 4.0)
    mesh.add(local(frame, cap), [order], "concrete", cap[:, [0, 1]] / 4.0)


def _crossing_height(frame, d):
    """Top of the crossing road above our carriageway: level at the bridge, then down to the fields."""
    where = local(frame, [(0, d, 0)])[0]
    s, dd = route.nearest(where[0], where[1])
    natural = float(terrain.ground(where[0], where[1], s, dd, False)) - frame[0][2]
    fall = route.smoothstep((abs(d) - 22) / 150)
    return max(DECK_TOP * (1 - fall) + (natural + 0.35) * fall, natural + 0.25)


def _embankment(mesh, frame, side):
    """The crossing road on its bank, out to the fields."""
    d = side * np.concatenate([[ABUTMENT_D + 0.05, 14, 18], np.arange(24, 260, 14.0)])
    top = np.array([_crossing_height(frame, v) for v in d])
    half, foot = 4.6, _BANK_HALF + 10.0 / _BANK_SLOPE
    profile = [(-foot, -1), (-_BANK_HALF, 0), (-half, 0), (half, 0), (_BANK_HALF, 0), (foot, -1)]
    grid = np.zeros((len(d), 6, 3))
    for j, (x, out) in enumerate(profile):
        grid[:, j, 0], grid[:, j, 1] = x, d
        grid[:, j, 2] = top - 0.03 + (out * 10.0)
    world = local(frame, grid.reshape(-1, 3)).reshape(grid.shape)
    uv = world[..., :2] / 5.0
    flip = side > 0
    mesh.grid(world[:, 0:3], "grass", uv[:, 0:3], flip)
    mesh.grid(world[:, 3:6], "grass", uv[:, 3:6], flip)
    lane = np.stack(np.broadcast_arrays(np.array([-half, half])[None] / 3.5, d[:, None] / 7.0), axis=-1)
    mesh.grid(world[:, 2:4] + [0, 0, 0.03], "asphalt", lane, flip)


def build():
    frame = _frame()
    bridge = Mesh()
    _deck(bridge, frame)
    _abutments(bridge, frame)
    place("bridge", bridge.data("bridge"))
    for side, name in ((-1, "right"), (1, "left")):
        bank = Mesh()
        _embankment(bank, frame, side)
        place("bridge_bank_" + name, bank.data("bridge_bank_" + name))
    corners = [(x, y, z) for x in (-_HALF, _HALF) for y in (-ABUTMENT_D - 0.4, ABUTMENT_D + 0.4)
               for z in (-1.0, route.BRIDGE_CLEARANCE + 0.6)]
    shelter("bridge", local(frame, corners))
