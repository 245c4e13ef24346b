"""The cabin's lining: floor, doors, pillars, roof, visors, interior mirror."""
import numpy as np

import car_shape as shape
from car_body import evenly, frame_rails, mirror_face, roof_outline
from car_glass import glass_surface, surface_normals, window_outline
from car_mesh import Part, flipped, grid_faces, lathe, panel, rotation, rounded, rounded_box, spline, tube, unit


def make(material_of):
    cabin = Part("cabin_lining")
    for maker in (floor, pillars, roof_lining, visors, doors, tail_lining):
        maker(cabin)
    cabin.build(material_of)
    interior_mirror(material_of)


def floor(cabin):
    rows = []
    for x, z in ((-0.62, 0.42), (0.20, 0.40), (0.36, 0.29), (1.60, 0.29), (1.86, 0.34), (1.97, 0.62), (1.97, 0.90)):
        half = 0.62 if x < 0 else 0.80 if x < 1.8 else 0.74
        rows.append([(x, y * half, z) for y in (1, 0.5, 0.0, -0.5, -1)])
    cabin.add(np.array(rows), grid_faces(len(rows), 5), "carpet")


def pillars(cabin):
    """Trim behind the glasshouse frame: flank lining with the windows' openings, and a padded strip to windscreen and roof."""
    inner = lambda p: shape.glasshouse(p) - [0, 0.026, 0]
    ahead = 0.06  # the rear window's sides lie this far before the flanks' rear edges
    outline = spline(shape.PILLAR_A + shape.ROOF_RAIL + [(x + ahead, z) for x, z in shape.PILLAR_C], 6)
    xs = np.linspace(outline[-1, 0], outline[0, 0], 40)[1:-1]
    low = np.stack([xs, shape.belt_z(xs) - 0.01], -1)
    loops = [np.concatenate([outline, low]), window_outline("front", 0.004), window_outline("rear", 0.004)]
    panel(cabin, "headliner", inner, loops, 0.07, gap=0, radius=0.006, depth=0.016, edge_step=0.045, mirror=True, edge="holes")
    one, other = frame_rails()
    one = one - [0, 0.026, 0]
    one[-16:, 0] += ahead
    v = np.linspace(0, 1, 20)
    foot = shape.screen(np.stack([np.ones(20), v], -1), -0.024) - np.array([0.5, 0, 0.87]) * 0.010
    rear = shape.rear_screen(np.stack([np.full(20, 0.955), 1 - v], -1)) + np.array([0.81, 0, -0.58]) * 0.009
    other = np.concatenate([evenly(foot, 25), other[25:-16] - [0, 0.02, 0.028], evenly(rear, 16)])
    inward = np.stack([np.zeros(len(one)), -np.ones(len(one)), np.full(len(one), -0.9)], -1)
    inward[:25, 0], inward[-16:, 0] = -0.55, 0.7
    t = np.linspace(0, 1, 7)[:, None, None]
    control = 0.5 * (one + other) + np.concatenate([np.full(25, 0.020), np.full(len(one) - 25, 0.02)])[:, None] * unit(inward)
    strip = (1 - t)**2 * one + 2 * t * (1 - t) * control + t**2 * other
    cabin.add(strip, flipped(grid_faces(7, len(one))), "headliner", mirror=True)
    v, f = rounded_box((0.955, 0.700, 1.175), (0.085, 0.03, 0.40), 0.012, rotation((1, 0, 0), 23))
    cabin.add(v, f, "headliner", mirror=True)


def roof_lining(cabin):
    lower = lambda p: shape.roof(p) - [0, 0, 0.028]
    panel(cabin, "headliner", lower, [roof_outline()], 0.10, gap=0, edge=False, edge_step=0.05, flip=True)
    v, f = rounded_box((1.20, 0.0, 1.392), (0.16, 0.15, 0.026), 0.010, rotation((0, 1, 0), 9), 3)   # reading lamps
    cabin.add(v, f, "trim")
    for y in (0.04, -0.04):
        v, f = rounded_box((1.20, y, 1.380), (0.06, 0.045, 0.008), 0.003, rotation((0, 1, 0), 9))
        cabin.add(v, f, "reflector")


def visors(cabin):
    for s in (1, -1):
        v, f = rounded_box((1.175, 0.355 * s, 1.382), (0.155, 0.40, 0.018), 0.008, rotation((0, 1, 0), 14) @ rotation((1, 0, 0), 3 * s), 3)
        cabin.add(v, f, "headliner")
        v, f = tube(np.array([(1.245, 0.12 * s, 1.372), (1.245, 0.17 * s, 1.368)]), 0.007, 8)
        cabin.add(v, f, "black_plastic")


def doors(cabin):
    """Door trims, left and mirrored: one moulding from the scuttle to the rear, with arm rests, pulls and speakers."""
    zs = np.array([0.982, 0.983, 0.972, 0.93, 0.88, 0.80, 0.735, 0.705, 0.695, 0.66, 0.60, 0.45, 0.33, 0.29])
    inset = np.array([0.016, 0.030, 0.048, 0.068, 0.078, 0.084, 0.088, 0.10, 0.105, 0.10, 0.088, 0.086, 0.092, 0.11])
    rest = np.array([0, 0, 0, 0, 0, 0.004, 0.025, 0.055, 0.060, 0.045, 0.010, 0.01, 0.02, 0.0])
    x = np.linspace(2.0, -0.40, 66)
    arm = shape.smooth(x, 1.58, 1.45) * shape.smooth(x, 1.02, 1.10) + shape.smooth(x, 0.72, 0.62) * shape.smooth(x, 0.12, 0.2)
    top = shape.belt_z(x)
    rows = []
    for z, i, r in zip(zs, inset, rest):
        y = shape.belt_point(x)[:, 1] - 0.010 - i - r * arm - 0.05 * np.maximum(-x - 0.2, 0)
        zz = z + (top - 0.962) * shape.smooth(z, 0.7, 0.93) + 0.010
        rows.append(np.stack([x, y, zz], -1))
    rows = np.array(rows)
    cabin.add(rows[:5], grid_faces(5, 66), "dash", mirror=True)
    cabin.add(rows[4:8], grid_faces(4, 66), "fabric_side", mirror=True)
    cabin.add(rows[7:], grid_faces(len(rows) - 7, 66), "trim", mirror=True)
    for x0 in (1.47, 0.60):
        y = float(shape.belt_point(np.array([x0]))[0, 1])
        v, f = rounded_box((x0, y - 0.105, 0.815), (0.11, 0.012, 0.030), 0.005)
        cabin.add(v, f, "chrome", mirror=True)
        v, f = rounded_box((x0, y - 0.096, 0.815), (0.15, 0.012, 0.055), 0.005)
        cabin.add(v, f, "black_plastic", mirror=True)
    v, f = rounded_box((1.33, 0.655, 0.722), (0.13, 0.04, 0.012), 0.004, rotation((1, 0, 0), -8))
    cabin.add(v, f, "piano", mirror=True)
    v, f = lathe([(0.085, 0.0), (0.083, 0.006), (0.075, 0.007), (0.072, 0.003), (0.0, 0.006)], 32, (1.66, 0.727, 0.44), (0, -1, 0))
    cabin.add(v, f, "black_plastic", mirror=True)
    sail = [(1.655, shape.belt_z(1.655) + 0.020), (1.86, shape.belt_z(1.86) + 0.016), (1.835, 1.008), (1.72, 1.075), (1.665, 1.06)]
    panel(cabin, "black_plastic", lambda p: glass_surface(p) - [0, 0.014, 0], [rounded(sail, 0.02)], 0.05, gap=0, radius=0.004, depth=0.014, mirror=True)


def tail_lining(cabin):
    y = np.linspace(-0.54, 0.54, 15)
    low = np.stack([np.full(15, -0.64), y, np.full(15, 0.42)], -1)
    mid = np.stack([np.full(15, -0.625), y, np.full(15, 0.965)], -1)
    z = np.linspace(0.40, 0.995, 6)
    near, far = np.stack([np.full(6, -0.37), np.full(6, 0.72), z], -1), np.stack([np.full(6, -0.63), np.full(6, 0.54), z], -1)
    cabin.add(np.array([near, far]), grid_faces(2, 6), "trim", mirror=True)
    foot = shape.rear_screen(np.stack([y / 0.62, np.full(15, 0.04)], -1)) + [0.03, 0, 0]
    cabin.add(np.array([low, mid, foot]), grid_faces(3, 15), "trim")


def interior_mirror(material_of):
    part = Part("interior_mirror")
    at = np.array([1.535, 0.0, 1.262])
    to_eye, back = unit(shape.EYE - at), unit(np.array([-1.0, 0, -0.02]))
    n = unit(to_eye + back)
    right = unit(np.cross([0, 0, 1.0], n))
    up = np.cross(n, right)
    outline = spline([(0.118, 0.0), (0.112, 0.024), (0.085, 0.033), (0.0, 0.036), (-0.085, 0.033), (-0.112, 0.024), (-0.118, 0.0), (-0.110, -0.024),
                      (-0.08, -0.031), (0.0, -0.033), (0.08, -0.031), (0.110, -0.024)], 5, closed=True)
    place = lambda k, h: at + k * (outline[:, :1] * right + outline[:, 1:] * up) + h * n
    rows = [place(0.968, 0.0), place(0.985, 0.0025), place(1.005, 0.0), place(1.0, -0.012), place(0.85, -0.028), place(0.3, -0.036), place(0.02, -0.037)]
    part.add(np.array(rows), flipped(grid_faces(len(rows), len(outline), wrap_cols=True)), "black_plastic")
    glass = shape.screen(np.array([[0.0, 0.80]]))[0]
    gn = surface_normals(shape.screen, np.array([[0.0, 0.80]]))[0]
    v, f = tube(spline([at - 0.03 * n, at - 0.05 * n + [0.0, 0, 0.015], glass - 0.02 * gn], 5), 0.007, 8)
    part.add(v, f, "black_plastic")
    slope = unit(shape.screen(np.array([[0.0, 0.81]]))[0] - glass)
    basis = np.stack([-slope, [0, 1.0, 0], gn], -1)
    v, f = rounded_box(glass - 0.017 * gn + 0.03 * slope, (0.13, 0.075, 0.026), 0.011, basis, 3)
    part.add(v, f, "black_plastic")
    part.build(material_of)
    mirror_face(material_of, "mirror_inside", at + 0.0012 * n, n, outline * 0.972)
