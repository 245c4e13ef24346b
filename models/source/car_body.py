"""The outside: panels, glasshouse frame, roof, cowl, lamps, plates, mirrors, handles."""
import bpy
import numpy as np

import car_shape as shape
from car_glass import glass_surface, surface_normals, window_outline
from car_mesh import (Part, axes_for, fill, flipped, grid_faces, lathe, offset_loop, panel, place, resample, rounded, rounded_box, spline, tube,
                      unit)

ARCH = shape.ARCH_RADIUS_M
HUB_Z = shape.TYRE_RADIUS_M


def make(material_of):
    body = Part("body")
    for panels in (behind_joints, flanks, nose, tail, top, glasshouse, cowl_and_frit, under, details):
        panels(body)
    body.build(material_of)
    lamps(material_of)
    door_mirrors(material_of)


# --- outlines on the lower body are drawn as (x, z) and mapped to its (s, z) ---

def on_side(points, step=0.02):
    xz = resample(points, step)
    return shape.side_at(xz[:, 0], xz[:, 1])


def arch_curve(axle_x, from_deg, to_deg, radius=ARCH):
    a = np.radians(np.linspace(from_deg, to_deg, 40))
    return np.stack([axle_x + radius * np.cos(a), HUB_Z + radius * np.sin(a)], -1)


def belt(x0, x1):
    return shape.belt_at(np.linspace(x0, x1, max(3, int(abs(x1 - x0) / 0.03))))


FRONT_SEAM = [(2.972, 0.490), (3.03, 0.60), (3.035, 0.775)]
DOOR_FRONT = [(1.985, 0.272), (2.03, 0.50), (2.00, 0.80), (1.975, 0.95)]
DOOR_MIDDLE = [(0.975, 0.272), (0.965, 0.98)]
DOOR_REAR = [(0.42, 0.272), (0.425, 0.42), (0.36, 0.60), (0.22, 0.73), (0.06, 0.84), (-0.03, 0.99)]
ARCH_LOW = np.degrees(np.arcsin((0.20 - HUB_Z) / ARCH))
TAIL_LAMP_SIDE, TAIL_LAMP_REAR = -0.50, 0.47


def seam(points):
    """A seam as a smooth curve, in (s, z); its upper end is put on the belt line."""
    curve = spline(points, 10)
    return on_side(curve)


def to_belt(curve, x):
    return np.concatenate([curve[curve[:, 1] < shape.belt_z(x) - 0.02], shape.belt_at(np.array([x]))])


def behind_joints(body):
    """Dark sheets close behind the panels, so that one does not look through the joints between them."""
    def sheet(loop, mirror=True):
        panel(body, "under", shape.side, [loop], 0.13, gap=0, edge=False, offset=-0.018, mirror=mirror)

    box = lambda x0, x1, z0: np.concatenate([on_side([(x0, z0), (x1, z0)], 0.1), belt(x1, x0) - [0, 0.02]])
    sheet(box(0.40, 2.26, 0.21))
    sheet(box(2.26, 3.16, 0.72))
    sheet(on_side([(3.16, 0.72), (2.985, 0.72), (3.0, 0.25), (3.12, 0.25)], 0.1))
    s0 = shape.side_at(-0.40, 0.5)[0]
    s = np.linspace(s0, 2 * shape.RING - s0, 60)
    sheet(np.concatenate([np.stack([s, np.full(60, 0.25)], -1), np.stack([s[::-1], np.full(60, 0.965)], -1)]), mirror=False)
    x = np.linspace(2.12, 3.28, 14)
    half = np.stack([x, shape.bonnet_half(x) - 0.03], -1)
    panel(body, "under", shape.bonnet, [np.concatenate([half, half[::-1] * [1, -1]])], 0.13, gap=0, edge=False, offset=-0.018)


def flanks(body):
    front = to_belt(seam(FRONT_SEAM), 3.035)
    door_f, door_m, door_r = to_belt(seam(DOOR_FRONT), 1.975), to_belt(seam(DOOR_MIDDLE), 0.965), to_belt(seam(DOOR_REAR), -0.03)
    arch_f = on_side(arch_curve(shape.WHEELBASE_M, 27.3, 180 - ARCH_LOW))
    wing = np.concatenate([arch_f, on_side([(2.28, 0.20), (2.0, 0.20)])[1:], on_side([(1.985, 0.20), (1.985, 0.272)]), door_f, belt(1.975, 3.035)[1:-1],
                           front[::-1]])
    panel(body, "paint", shape.side, [wing], 0.06, mirror=True, edge_step=0.034)
    bottom = lambda a, b: on_side([(a, 0.272), (b, 0.272)])[1:-1]
    door1 = np.concatenate([door_f[::-1], bottom(1.985, 0.975), door_m, belt(0.965, 1.975)[1:-1]])
    door2 = np.concatenate([door_m[::-1], bottom(0.975, 0.42), door_r, belt(-0.03, 0.965)[1:-1]])
    for door in (door1, door2):
        panel(body, "paint", shape.side, [door], 0.06, mirror=True, edge_step=0.034)
    sill = np.concatenate([on_side([(1.985, 0.272), (1.985, 0.20), (2.0, 0.17), (0.37, 0.17), (0.37, 0.272), (1.985, 0.272)])[:-1]])
    panel(body, "black_plastic", shape.side, [sill], 0.06, mirror=True, edge_step=0.03)
    arch_r = on_side(arch_curve(0.0, ARCH_LOW, 168))
    rear_end = shape.s_of_tail_y(0.63)
    quarter = np.concatenate([door_r[::-1][:-1], on_side([(0.42, 0.272), (0.37, 0.272), (0.357, 0.20)]), arch_r,
                              [(shape.side_at(-0.45, 0.565)[0], 0.565), (rear_end, 0.565), (rear_end, shape.belt_z(-0.8))],
                              tail_belt(rear_end)])
    panel(body, "paint", shape.side, [quarter, tail_lamp_outline()], 0.06, mirror=True, edge_step=0.034)


def tail_belt(rear_end):
    s = np.linspace(rear_end, shape.belt_at(np.array([-0.03]))[0, 0], 40)[1:-1]
    return np.stack([s, shape.belt_z(shape.outline(s)[0])], -1)


def tail_lamp_outline(grow=0.0):
    a, b = shape.side_at(TAIL_LAMP_SIDE, 0.85)[0] - grow, shape.s_of_tail_y(0.640) + grow
    return rounded([(a, 0.868 - grow), (a + 0.10, 0.795 - grow), (b, 0.775 - grow), (b, 0.902 + grow), (a + 0.06, 0.918 + grow), (a, 0.905 + grow)], 0.022)


def head_lamp_outline(grow=0.0):
    inner, outer = shape.s_of_nose_y(0.47) - grow, shape.side_at(3.07, 0.70)[0] + grow
    return rounded([(inner, 0.592 - grow), (shape.s_of_nose_y(0.66), 0.590 - grow), (outer, 0.672 - grow), (outer, 0.728 + grow),
                    (shape.s_of_nose_y(0.62), 0.668 + grow), (inner, 0.640 + grow)], 0.02)


def nose_box(half_y, z0, z1, narrow=0.0, radius=0.03):
    s = lambda y: float(shape.s_of_nose_y(y))
    h = half_y
    loop = [(s(-h + narrow), z0), (s(h - narrow), z0), (s(h), z1), (s(-h), z1)]
    return rounded(loop, radius)


def nose(body):
    front = to_belt(seam(FRONT_SEAM), 3.035)
    arch = on_side(arch_curve(shape.WHEELBASE_M, ARCH_LOW, 27.3))
    left = np.concatenate([arch, front[1:]])
    s_top = np.linspace(front[-1, 0], -front[-1, 0], 81)[1:-1]
    top_edge = np.stack([s_top, shape.belt_z(shape.outline(s_top)[0])], -1)
    right = left[::-1] * [-1, 1]
    s_low = np.linspace(-arch[0, 0] + 0.02, arch[0, 0] - 0.02, 70)
    loop = np.concatenate([left, top_edge, right, np.stack([s_low, np.full(70, 0.175)], -1)])
    lamp = head_lamp_outline()
    grille, intake = nose_box(0.43, 0.590, 0.652, 0.02, 0.02), nose_box(0.56, 0.225, 0.400, -0.10, 0.03)
    panel(body, "paint", shape.side, [loop, lamp, lamp * [-1, 1], grille, intake], 0.055, edge_step=0.034, depth=0.02)
    for opening, rows in ((grille, 4), (intake, 7)):
        mesh_grille(body, opening, rows)
    for opening in (grille, intake):
        frame = closed_wider(opening, 0.016)
        panel(body, "black_gloss", shape.side, [frame, opening], 0.05, gap=0, radius=0.003, depth=0.010, edge_step=0.03, offset=0.004)
    for sign in (1, -1):
        s0 = float(shape.s_of_nose_y(0.70))
        slot = rounded([(s0 + 0.02, 0.27), (s0 + 0.12, 0.30), (s0 + 0.10, 0.47), (s0 + 0.06, 0.47)], 0.02) * [sign, 1]
        panel(body, "black_gloss", shape.side, [slot], 0.04, gap=0, radius=0.003, depth=0.006, edge_step=0.03, offset=0.003)
    chrome = nose_box(0.425, 0.5925, 0.598, 0.0, 0.002)
    panel(body, "chrome", shape.side, [chrome], 0.03, gap=0, radius=0.001, offset=0.002)
    badge, faces = lathe([(0.0, 0.012), (0.028, 0.011), (0.036, 0.008), (0.040, 0.0)], 28, shape.side(np.array([[0.0, 0.622]]))[0] + [-0.012, 0, 0], (1, 0, 0))
    body.add(badge, flipped(faces), "chrome")
    plate(body, shape.side(np.array([[0.0, 0.49]]))[0] + [0.012, 0, 0], 1)
    lip = np.stack([np.linspace(-arch[0, 0] + 0.05, arch[0, 0] - 0.05, 60), np.full(60, 0.185)], -1)
    p = shape.side(lip)
    v, f = tube(p + [0.0, 0, -0.005], 0.018, 8)
    body.add(v, f, "black_plastic")


def closed_wider(loop, by):
    loop = loop if (np.roll(loop, -1, 0)[:, 1] * loop[:, 0] - loop[:, 1] * np.roll(loop, -1, 0)[:, 0]).sum() > 0 else loop[::-1]
    return offset_loop(loop, -by)


def mesh_grille(body, opening, rows):
    """Dark back wall and horizontal bars behind an opening."""
    low, high = opening.min(0), opening.max(0)
    panel(body, "under", shape.side, [opening], 0.06, gap=-0.05, edge=False, offset=-0.07)
    for k in range(rows):
        z = low[1] + (k + 0.5) * (high[1] - low[1]) / rows
        s = np.linspace(low[0], high[0], 41)
        p = shape.side(np.stack([s, np.full(41, z)], -1))
        n = surface_normals(shape.side, np.stack([s, np.full(41, z)], -1))
        v, f = tube(p - 0.03 * n, 1.0, section=[(-0.012, -0.003), (0.012, -0.003), (0.012, 0.003), (-0.012, 0.003)], up=(0, 0, 1))
        body.add(v, f, "black_gloss")


def plate(body, at, forward):
    v, f = rounded_box(at, (0.010, 0.53, 0.118), 0.004)
    body.add(v, f, "black_plastic")
    x = at[0] + forward * 0.0056
    corners = np.array([(x, y, at[2] + z) for y, z in ((0.26, -0.056), (-0.26, -0.056), (-0.26, 0.056), (0.26, 0.056))])
    uv = [(0, 0), (1, 0), (1, 1), (0, 1)]
    if forward > 0:
        corners, uv = corners[[1, 0, 3, 2]], uv
    body.add(corners, [(0, 1, 2, 3)], "plate", uvs=uv)


def tail(body):
    edge = shape.s_of_tail_y(0.63)
    other = 2 * shape.RING - edge
    s = np.linspace(edge, other, 61)
    gate = np.concatenate([[(edge, 0.60)], np.stack([s[1:-1], np.full(59, 0.60)], -1), [(other, 0.60)],
                           np.stack([s[::-1], np.full(61, 0.985)], -1)])
    panel(body, "paint", shape.side, [gate], 0.055, edge_step=0.03)
    arch_end = on_side(arch_curve(0.0, 168, 180 - ARCH_LOW))
    corner = shape.side_at(-0.45, 0.565)[0]
    left = np.concatenate([[(corner, 0.565), (edge, 0.565), (edge, 0.60)]])
    s_low = np.linspace(2 * shape.RING - arch_end[-1, 0] - 0.02, arch_end[-1, 0] + 0.02, 80)
    loop = np.concatenate([arch_end[::-1], left, np.stack([s[1:-1], np.full(59, 0.60)], -1), (left * [-1, 1] + [2 * shape.RING, 0])[::-1],
                           arch_end * [-1, 1] + [2 * shape.RING, 0], np.stack([s_low, np.full(80, 0.18)], -1)])
    panel(body, "paint", shape.side, [loop], 0.055, edge_step=0.034)
    low = rounded([(edge + 0.02, 0.20), (other - 0.02, 0.20), (other - 0.06, 0.33), (edge + 0.06, 0.33)], 0.03)
    panel(body, "black_plastic", shape.side, [low], 0.05, gap=0, offset=0.004)
    s = np.linspace(shape.belt_at(np.array([-0.60]))[0, 0], shape.RING, 40)
    low = shape.side(np.stack([s, shape.belt_z(shape.outline(s)[0]) - 0.004], -1))
    one, other = frame_rails()
    u = np.linspace(1, 0, 30)
    foot = np.concatenate([evenly(np.array([one[-1], other[-1]]), 5)[:-1], shape.rear_screen(np.stack([u, np.full(30, 0.004)], -1))])
    foot = evenly(foot, 40)
    rim = 0.5 * (low + foot) + [0, 0, 0.006]
    behind = shape.side(np.stack([s, shape.belt_z(shape.outline(s)[0]) - 0.07], -1))
    behind = behind + 0.022 * unit([0.6, 0, 0] - behind * [1, 1, 0])
    body.add(np.array([behind, low - [0, 0, 0.010], low, rim, foot]), grid_faces(5, 40), "paint", mirror=True)
    plate(body, shape.side(np.array([[shape.RING, 0.70]]))[0] + [-0.010, 0, 0], -1)
    handle, f = rounded_box(shape.side(np.array([[shape.RING, 0.80]]))[0] + [-0.012, 0, 0], (0.03, 0.50, 0.022), 0.008)
    body.add(handle, f, "chrome")
    for y in (0.48, -0.48):
        v, f = rounded_box((shape.side(np.array([[shape.s_of_tail_y(y), 0.40]]))[0] + [-0.002, 0, 0]), (0.012, 0.17, 0.035), 0.005)
        body.add(v, f, "red_lens")


# --- top ---

def bonnet_rear_x(y):
    return shape.SCREEN_FOOT[0] + 0.085 - shape.SCREEN_BOW_X * (np.asarray(y) / shape.SCREEN_HALF_FOOT)**2


def bonnet_outline():
    y = np.linspace(0.70, -0.70, 41)
    rear = np.stack([bonnet_rear_x(y), y], -1)
    x = np.linspace(bonnet_rear_x(0.70) + 0.06, 3.22, 30)
    right = np.stack([x, -(shape.bonnet_half(x) - 0.055)], -1)
    yy = np.linspace(right[-1, 1] + 0.10, -right[-1, 1] - 0.10, 31)
    half = len(shape._BELT_S) // 2
    nose_x = np.interp(np.abs(yy), shape._BELT[:half, 1], shape._BELT[:half, 0])
    front = np.stack([nose_x - 0.06, yy], -1)
    return np.concatenate([rear, right, front, right[::-1] * [1, -1]])


def top(body):
    panel(body, "paint", shape.bonnet, [bonnet_outline()], 0.05, edge_step=0.03)
    b = shape._BELT
    left = b[(b[:, 0] > 1.84)][:, :2][::20]
    y = np.linspace(0.75, -0.75, 30)
    loop = np.concatenate([left, np.stack([bonnet_rear_x(y) - 0.055 - 0.07 * (y / 0.75)**6, y], -1), (left * [1, -1])[::-1][:-1]])
    panel(body, "paint", shape.bonnet, [loop, bonnet_outline()], 0.05, edge_step=0.03, gap=0.0005, radius=0.003)
    panel(body, "paint", shape.roof, [roof_outline()], 0.07, edge_step=0.04, gap=0.001, depth=0.02)
    fin = []
    for z, x0, x1, half in ((-0.004, -0.26, -0.43, 0.030), (0.004, -0.265, -0.43, 0.026), (0.022, -0.315, -0.428, 0.016), (0.042, -0.365, -0.425, 0.007), (0.052, -0.40, -0.42, 0.002)):
        a = np.linspace(0, 2 * np.pi, 16, endpoint=False)
        fin.append(np.stack([0.5 * (x0 + x1) + 0.5 * (x0 - x1) * np.cos(a), half * np.sin(a), np.full(16, z) + shape.roof(np.array([[-0.34, 0.0]]))[0, 2]], -1))
    body.add(np.array(fin), grid_faces(5, 16, wrap_cols=True), "paint")

def roof_outline():
    u = np.linspace(1, -1, 31)
    front = shape.screen(np.stack([u, np.ones(31)], -1))[:, :2] - [0.004, 0]
    y = np.linspace(-0.54, 0.54, 31)
    rear = np.stack([-0.60 + 0.10 * (y / 0.54)**2 * 0.6, y], -1)
    h = shape.ROOF_HALF
    right = np.array([(1.20, -0.600), (1.0, -h), (0.5, -h - 0.005), (-0.2, -h + 0.005)])
    return np.concatenate([front[:-1], resample(right, 0.05), rear, resample(right[::-1] * [1, -1], 0.05)])


def evenly(curve, n):
    curve = np.asarray(curve, float)
    t = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    goal = np.linspace(0, t[-1], n)
    return np.stack([np.interp(goal, t, curve[:, k]) for k in range(curve.shape[1])], -1)


def frame_rails(grow=0.0):
    """The two edges (left) of the frame strip: along the flank's glasshouse, and along windscreen, roof, rear window."""
    v = np.linspace(0, 1, 20)
    one = np.ones(20)
    a2 = shape.screen(np.stack([one, v], -1), 0.003)
    r2 = shape.roof(spline([(1.20, 0.600), (1.0, 0.575), (0.5, 0.580), (-0.2, 0.570), (-0.40, 0.555)], 6))
    c2 = shape.rear_screen(np.stack([one, 1 - v], -1))
    flank = lambda xz: shape.glasshouse(np.asarray(xz))
    whole = spline(shape.PILLAR_A + shape.ROOF_RAIL + shape.PILLAR_C, 8)
    na, nr = 8 * (len(shape.PILLAR_A) - 1), 8 * (len(shape.ROOF_RAIL) + 1)
    a1, r1, c1 = flank(whole[:na + 1]), flank(whole[na:na + nr + 1]), flank(whole[na + nr:])
    one_side = np.concatenate([evenly(a1, 25), evenly(r1, 31)[1:-1], evenly(c1, 16)])
    other = np.concatenate([evenly(a2, 25), evenly(r2, 31)[1:-1], evenly(c2, 16)])
    return one_side, other


def glasshouse(body):
    flank_loop = spline(shape.PILLAR_A + shape.ROOF_RAIL + shape.PILLAR_C, 6)
    xs = np.linspace(flank_loop[-1, 0], flank_loop[0, 0], 50)[1:-1]
    low = np.stack([xs, shape.belt_z(xs) - 0.004], -1)
    holes = [window_outline("front"), window_outline("rear")]
    panel(body, "paint", shape.glasshouse, [np.concatenate([flank_loop, low]), *holes], 0.05, gap=0.0, radius=0.004, depth=0.018, edge_step=0.03,
          flip=True, mirror=True)
    post = np.array([(0.915, 0.99), (1.015, 0.985), (1.015, 1.352), (0.915, 1.355)])
    panel(body, "black_gloss", shape.glasshouse, [post], 0.05, gap=0.0, radius=0.002, depth=0.003, flip=True, mirror=True, offset=0.003)
    for hole in holes:  # rubber round each window
        p = glass_surface(hole) + [0, 0.004, 0]
        v, f = tube(p, 0.0055, 6, closed=True, up=(0, 1, 0))
        body.add(v, f, "rubber", mirror=True)
    xs = np.linspace(-0.60, 1.85, 60)
    strip = shape.glasshouse(np.stack([xs, shape.belt_z(xs) + 0.004], -1)) + [0, 0.006, 0]
    v, f = tube(strip, 1.0, section=[(-0.007, -0.009), (0.004, -0.009), (0.004, 0.009), (-0.007, 0.009)], up=(0, 0, 1))
    body.add(v, f, "black_gloss", mirror=True)
    one, other = frame_rails()
    outward = np.stack([np.zeros(len(one)), np.ones(len(one)), np.full(len(one), 0.8)], -1)
    outward[:25, 0], outward[-16:, 0] = 0.45, -0.7
    t = np.linspace(0, 1, 7)[:, None, None]
    control = 0.5 * (one + other) + 0.22 * np.linalg.norm(other - one, axis=1, keepdims=True) * unit(outward)
    strip = (1 - t)**2 * one + 2 * t * (1 - t) * control + t**2 * other
    body.add(strip, grid_faces(7, len(one)), "paint", mirror=True)
    foot = strip[:, 0]  # the A-pillar's foot runs out forward into the wing
    rows = []
    for t in np.linspace(0, 1, 6):
        p = foot + [0.12 * t, 0, 0]
        p[:, 2] += (shape.bonnet(p[:, :2])[:, 2] - 0.004 - foot[:, 2]) * shape.smooth(t, -0.25, 1.0)
        rows.append(p)
    rows[0] = foot
    body.add(np.array(rows), grid_faces(6, 7), "paint", mirror=True)


def cowl_and_frit(body):
    u = np.linspace(-1, 1, 41)
    foot = shape.screen(np.stack([u, np.full(41, 0.012)], -1), 0.02)
    y = foot[:, 1] * 0.925
    ahead = shape.bonnet(np.stack([bonnet_rear_x(y) - 0.004, y], -1)) - [0, 0, 0.012]
    n = np.array([0.5, 0, 0.87])
    rows = [foot - n * 0.004, foot - n * 0.004 + (ahead - foot) * 0.15 - [0, 0, 0.012], foot + (ahead - foot) * 0.55 - [0, 0, 0.022],
            ahead - [0, 0, 0.006], ahead - [0, 0, 0.03] + [0.03, 0, 0]]
    rows = np.array(rows) - np.array([0, 0, 0.06]) * shape.smooth(np.abs(u), 0.80, 0.97)[None, :, None] * np.array([0, 0.3, 1, 1, 1])[:, None, None]  # its ends dive under the wings
    body.add(rows, flipped(grid_faces(5, 41)), "black_plastic")
    for k in range(36):  # air slots
        a = 0.30 * (1 if k % 2 else -1) + (k // 2 - 8.5) * 0.017
        i = np.interp(a, rows[2][:, 1], np.arange(41))
        p = np.array([np.interp(i, np.arange(41), rows[2][:, c]) for c in range(3)])
        v, f = rounded_box(p + [0, 0, 0.004], (0.040, 0.006, 0.006), 0.002, segments=1)
        body.add(v, f, "black_gloss")
    frit(body, shape.screen, (0.032, 0.032, 0.055, 0.050), False)
    sensor_patch(body)
    frit(body, shape.rear_screen, (0.08, 0.08, 0.10, 0.08), True)


def sensor_patch(body):
    """The band widens where the mirror's foot and the camera sit."""
    loop = rounded([(-0.13, 0.97), (-0.09, 0.80), (0.09, 0.80), (0.13, 0.97)], 0.03, 6)
    xy, tris, _ = fill([loop], 0.05, 0.03)
    n = surface_normals(shape.screen, xy)
    body.add(shape.screen(xy) - 0.0045 * n, tris, "frit", n)


def frit(body, surface, margins, flip):
    """Black enamel band on the inside of a window: side margins in u, lower and upper in v."""
    left, right, low, high = margins
    square = lambda u0, u1, v0, v1, r: rounded([(u0, v0), (u1, v0), (u1, v1), (u0, v1)], r, 6)
    inner = square(-1 + left, 1 - right, low, 1 - high, 0.06)
    xy, tris, _ = fill([np.array([(-1, 0), (1, 0), (1, 1), (-1, 1)], float), inner], 0.04, 0.04)
    n = surface_normals(surface, xy) * (-1 if flip else 1)
    body.add(surface(xy) - 0.004 * n, [tuple(t[::-1]) if flip else tuple(t) for t in tris], "frit", n)


def under(body):
    z = 0.20
    outline = [(shape.MIDDLE_X + 0.93 * (x - shape.MIDDLE_X), y * 0.88, z) for x, y in np.stack(shape.outline(np.linspace(0, 2 * shape.RING, 60, endpoint=False)), -1)]
    body.add(np.array(outline), [tuple(range(60))[::-1]], "under")
    for axle in (0.0, shape.WHEELBASE_M):
        a = np.radians(np.linspace(-25, 205, 24))
        arc = np.stack([axle + (ARCH + 0.006) * np.cos(a), np.zeros(24), HUB_Z + (ARCH + 0.006) * np.sin(a)], -1)
        rows = [arc + [0, 0.905, 0], arc + [0, 0.62, 0]]
        hull = shape.side(shape.side_at(arc[:, 0], arc[:, 2]))[:, 1]
        rows[0] = np.stack([arc[:, 0], hull - 0.006, arc[:, 2]], -1)
        body.add(np.array(rows), flipped(grid_faces(2, 24)), "under", mirror=True)
        wall = np.concatenate([rows[1], [[axle, 0.62, HUB_Z - 0.2]]])
        body.add(wall, [(k + 1, k, 24) for k in range(23)], "under", mirror=True)


def details(body):
    for x in (1.16, 0.20):  # door handles
        z = 0.868 if x > 1 else 0.882
        p = shape.side(np.array([shape.side_at(x, z)]))[0]
        path = spline([p + [0.105, -0.012, 0], p + [0.085, 0.022, 0.001], p + [0, 0.034, 0.003], p + [-0.085, 0.022, 0.001], p + [-0.105, -0.012, 0]], 5)
        v, f = tube(path, 1.0, section=np.array([(np.cos(a) * 0.008, np.sin(a) * 0.014) for a in np.linspace(0, 2 * np.pi, 10, endpoint=False)]))
        body.add(v, f, "paint", mirror=True)
        v, f = rounded_box(p + [0, -0.010, 0], (0.16, 0.03, 0.045), 0.012)
        body.add(v, f, "under", mirror=True)


# --- lamps and mirrors ---

def lamp_node(material_of, name, role, outlines, material, offset=0.0):
    part = Part(name)
    for outline in outlines:
        panel(part, material, shape.side, [outline], 0.05, gap=0.0015, radius=0.003, depth=0.012, edge_step=0.02, offset=offset)
    part.build(material_of, rainglass={"type": "light", "role": role})


def band(loop, z, sign):
    """The part of a convex (s, z) loop above (sign 1) or below (-1) a height."""
    out = []
    for a, b in zip(np.roll(loop, 1, 0), loop):
        if (sign * (a[1] - z) >= 0) != (sign * (b[1] - z) >= 0):
            out.append(a + (b - a) * (z - a[1]) / (b[1] - a[1]))
        if sign * (b[1] - z) >= 0:
            out.append(b)
    return np.array(out)


def lamps(material_of):
    ring = 2 * shape.RING
    both = lambda loop: [loop, loop * [-1, 1] + [ring, 0]]
    outline = tail_lamp_outline(-0.001)
    for name, role, low, high, material in (("tail_lamps", "tail", 0.858, 1.0, "tail_lamp"), ("brake_lamps", "brake", 0.812, 0.858, "brake_lamp"),
                                            ("rear_indicators", "indicator", 0.0, 0.812, "indicator_lamp")):
        loop = band(band(outline, low, 1), high, -1)
        lamp_node(material_of, name, role, both(loop), material)
    glass = Part("head_lamp_lenses")
    for sign in (1, -1):
        panel(glass, "lens", shape.side, [head_lamp_outline(-0.001) * [sign, 1]], 0.04, gap=0.001, radius=0.002, depth=0.004, edge_step=0.02)
        panel(glass, "black_gloss", shape.side, [head_lamp_outline(0.04) * [sign, 1]], 0.04, gap=0, edge=False, offset=-0.055)
    for sign in (1, -1):
        for k, y in enumerate((0.55, 0.64)):
            p = shape.side(np.array([[shape.s_of_nose_y(y), 0.624]]))[0] + [-0.035, 0, 0]
            v, f = lathe([(0.005, -0.03), (0.020, -0.024), (0.031, 0.0), (0.036, 0.010), (0.040, 0.008), (0.040, -0.01)], 24, p * [1, sign, 1], (1, 0, 0))
            glass.add(v, flipped(f), "reflector")
        path = shape.side(np.stack([np.linspace(shape.s_of_nose_y(0.48), shape.s_of_nose_y(0.80), 24), np.linspace(0.603, 0.648, 24)], -1)) - [0.020, 0, 0]
        v, f = tube(path * [1, sign, 1], 0.005, 6)
        glass.add(v, f if sign > 0 else flipped(f), "head_lamp")
    glass.build(material_of)
    for sign, hand in ((1, "left"), (-1, "right")):
        part = Part("head_lamp_" + hand)
        for y in (0.55, 0.64):
            p = shape.side(np.array([[shape.s_of_nose_y(y), 0.624]]))[0] + [-0.038, 0, 0]
            v, f = lathe([(0.0, 0.012), (0.014, 0.009), (0.024, 0.0)], 20, p * [1, sign, 1], (1, 0, 0))
            part.add(v, flipped(f), "head_lamp")
        part.build(material_of, rainglass={"type": "light", "role": "head"})
        spot(f"low_beam_{hand}", np.array([3.44, 0.62 * sign, 0.63]))


def spot(name, at):
    """Low beam: a spot pointed 2 degrees down; some 25 000 cd, which the exporter makes of Blender's watts by 683 lm/W over 4 pi sr."""
    lamp = bpy.data.lights.new(name, "SPOT")
    lamp.energy, lamp.color, lamp.spot_size, lamp.spot_blend = 450.0, (1.0, 0.95, 0.86), np.radians(64), 0.75
    down = np.radians(2.5)
    aim = np.array([np.cos(down), 0, -np.sin(down)])
    place(bpy.data.objects.new(name, lamp), at, axes_for(-aim, (0, 1, 0)), rainglass={"type": "light", "role": "head"})


def door_mirrors(material_of):
    for sign, hand in ((1, "left"), (-1, "right")):
        part = Part("door_mirror_" + hand)
        flip = np.array([1, sign, 1])
        c = np.array([1.800, 0.985, 1.045])
        # The face looks back at the middle between the driver's eye and straight behind, the own flank at its edge; the housing turns with it, but does not tilt.
        face = unit(unit(shape.EYE - c * flip) + unit([-1.0, 0.015 * sign, -0.02]))
        ahead = -unit(face * [1, 1, 0])
        turn = np.array([ahead, [-ahead[1], ahead[0], 0], [0, 0, 1]])
        profile = [(0.03, 0.0), (0.075, 0.006), (0.098, 0.035), (0.100, 0.085), (0.094, 0.098)]
        a = np.linspace(0, 2 * np.pi, 28, endpoint=False)
        squircle = np.sign(np.cos(a)) * np.abs(np.cos(a))**0.62, np.sign(np.sin(a)) * np.abs(np.sin(a))**0.62
        rows = np.array([[[0.055 - d, 1.05 * r * cy, 0.66 * r * cz] for cy, cz in zip(*squircle)] for r, d in profile])
        lip = np.array([[[0.055 - 0.088, 1.05 * 0.086 * cy, 0.66 * 0.082 * cz] for cy, cz in zip(*squircle)]])
        rows = np.concatenate([rows, lip]) * flip @ turn + c * flip
        n = len(a)
        faces = grid_faces(len(rows), n, wrap_cols=True) + [tuple(range(n))[::-1]]
        part.add(rows.reshape(-1, 3), flipped(faces) if sign > 0 else faces, "paint")
        foot = [(1.785, 0.800, 0.985), (1.79, 0.845, 1.0), (1.795, 0.90, 1.005)]
        v, f = tube(spline(foot, 4), 1.0, section=[(-0.028, -0.020), (0.028, -0.020), (0.028, 0.012), (-0.028, 0.012)])
        part.add(v * flip, f if sign > 0 else flipped(f), "black_plastic")
        part.build(material_of)
        at = c * flip + (0.055 - 0.087) * ahead
        mirror_face(material_of, "mirror_" + hand, at, face, [(1.05 * 0.080 * cy, 0.66 * 0.078 * cz) for cy, cz in zip(*squircle)], wet=True)


def mirror_face(material_of, name, at, normal, outline, **extras):
    """A flat mirror; uv 0..1 as the driver sees it."""
    right = unit(np.cross([0, 0, 1.0], normal))   # seen from the front of the mirror
    up = np.cross(normal, right)
    o = np.array(outline)
    half = np.abs(o).max(0)
    p = at + o[:, :1] * right + o[:, 1:] * up
    p = np.concatenate([[at], p])
    uv = np.concatenate([[[0.5, 0.5]], 0.5 + 0.5 * o / half])
    n = len(o)
    part = Part(name).add(p, [(0, 1 + k, 1 + (k + 1) % n) for k in range(n)], "mirror", np.tile(normal, (n + 1, 1)), uv)
    part.build(material_of, rainglass={"type": "mirror", "name": name, **extras})
