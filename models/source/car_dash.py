"""Dashboard: the moulded top and face, instrument hood, vents, centre screen, switches, console."""
import numpy as np

import car_shape as shape
from car_mesh import Part, flipped, grid_faces, lathe, panel, rotation, rounded, rounded_box, spline, tube, unit

DRIVER_Y = shape.EYE[1]
HALF = 0.775


def make(material_of):
    dash = Part("dashboard")
    for maker in (moulding, decor, hood, vents, centre_screen, climate, glove_box, console, lever):
        maker(dash)
    dash.build(material_of)


def surface(p):
    """Dashboard moulding: (y, d) -> point; d (m) runs from the windscreen over the top, down the face. Right-handed seen from the cabin."""
    y, d = np.asarray(p, float).T
    ends = (y / HALF)**2
    foot = shape.SCREEN_FOOT[0] - 0.025 - shape.SCREEN_BOW_X * (y / shape.SCREEN_HALF_FOOT)**2
    driver = np.exp(-((y - DRIVER_Y) / 0.24)**4)
    middle = np.exp(-(y / 0.17)**4)
    passenger = 1 / (1 + np.exp((y + 0.12) / 0.06))
    lip = 1.555 - 0.012 * middle + 0.030 * passenger + 0.05 * ends**2
    bay = np.exp(-((y - DRIVER_Y) / 0.163)**16)   # room for the instruments under their hood
    face = lip
    lip = lip + 0.125 * bay
    knee = face + 0.02 + 0.06 * (1 - middle)
    xs = [foot, lip + 0.62 * (foot - lip), lip + 0.33 * (foot - lip), lip + 0.035, lip + 0.006, lip, lip + 0.010, 0.6 * lip + 0.4 * face + 0.02, knee, knee + 0.06, knee + 0.22, knee + 0.36]
    rise = 0.012 * driver - 0.010 * ends
    zs = [0.981 - 0 * y, 0.984 + 0.3 * rise, 0.984 + 0.7 * rise, 0.966 + rise, 0.952 + rise, 0.932 + rise, 0.905 + 0 * y, 0.855 + 0 * y,
          0.74 - 0.02 * middle, 0.62 - 0.02 * middle, 0.50 + 0 * y, 0.30 + 0 * y]
    ds = np.array([0.0, 0.18, 0.32, 0.45, 0.468, 0.49, 0.52, 0.57, 0.69, 0.82, 1.02, 1.26])
    return np.stack([along(d, ds, xs), y, along(d, ds, zs)], -1)


def along(d, ds, values):
    """Cubic Hermite in d through rows of values (one array a knot)."""
    values = np.array([np.broadcast_to(v, d.shape) for v in values])
    slopes = np.gradient(values, ds, axis=0)
    d = np.clip(d, ds[0], ds[-1])
    k = np.clip(np.searchsorted(ds, d) - 1, 0, len(ds) - 2)
    h, i = ds[k + 1] - ds[k], np.arange(len(d))
    t = (d - ds[k]) / h
    return ((2 * t**3 - 3 * t**2 + 1) * values[k, i] + (t**3 - 2 * t**2 + t) * h * slopes[k, i]
            + (3 * t**2 - 2 * t**3) * values[k + 1, i] + (t**3 - t**2) * h * slopes[k + 1, i])


def at(y, d, lift=0.0):
    p = np.array([[y, d]])
    e = 1e-3
    n = unit(np.cross(surface(p + [e, 0]) - surface(p - [e, 0]), surface(p + [0, e]) - surface(p - [0, e])))
    return (surface(p) + lift * n)[0], n[0]


def moulding(dash):
    d = np.concatenate([np.linspace(0, 0.42, 12), np.linspace(0.44, 0.60, 15), np.linspace(0.64, 1.26, 12)])
    y = np.unique(np.concatenate([np.linspace(-HALF, HALF, 57), DRIVER_Y + np.linspace(0.14, 0.18, 6), DRIVER_Y - np.linspace(0.14, 0.18, 6)]))
    dd, yy = np.meshgrid(d, y, indexing="ij")
    dash.add(surface(np.stack([yy.ravel(), dd.ravel()], -1)), grid_faces(len(d), len(y)), "dash")
    u = np.linspace(-1, 1, 41)   # closes the gap to the glass, under the enamel band
    up = shape.screen(np.stack([u, np.full(41, 0.04)], -1)) - np.array([0.5, 0, 0.87]) * 0.006
    edge = surface(np.stack([np.clip(up[:, 1], -HALF, HALF), np.full(41, 0.004)], -1))
    dash.add(np.array([up, edge]), grid_faces(2, 41), "black_plastic")
    # defroster slots along the glass, and a seam in the top pad
    for y0, y1 in ((-0.62, -0.06), (0.06, 0.62)):
        loop = rounded([(y0, 0.030), (y1, 0.030), (y1, 0.052), (y0, 0.052)], 0.010)
        panel(dash, "under", surface, [loop], 0.06, gap=0, edge=False, offset=0.0015)
        frame = rounded([(y0 - 0.008, 0.022), (y1 + 0.008, 0.022), (y1 + 0.008, 0.060), (y0 - 0.008, 0.060)], 0.014)
        panel(dash, "black_plastic", surface, [frame, loop], 0.06, gap=0, radius=0.0015, depth=0.003, offset=0.003)
    seam = surface(np.stack([np.linspace(-0.76, 0.10, 40), np.full(40, 0.40)], -1))
    v, f = tube(seam, 0.0016, 5)
    dash.add(v, f, "leather")


def decor(dash):
    """Satin strip across the face, and a darker band under it."""
    for y0, y1 in ((-0.745, -0.155), (0.155, 0.205), (0.535, 0.56)):
        panel(dash, "satin", surface, [rounded([(y0, 0.528), (y1, 0.528), (y1, 0.546), (y0, 0.546)], 0.006)], 0.05, gap=0, radius=0.002, depth=0.006,
              offset=0.004)
    panel(dash, "piano", surface, [rounded([(-0.745, 0.547), (-0.155, 0.547), (-0.155, 0.585), (-0.745, 0.585)], 0.006)], 0.05, gap=0, radius=0.002,
          depth=0.006, offset=0.002)


def hood(dash):
    """Arched hood over the instruments, its mouth towards the driver."""
    a = np.linspace(0, np.pi, 33)
    cy, cz = np.sign(np.cos(a)) * np.abs(np.cos(a))**0.55, np.abs(np.sin(a))**0.60

    def arch(x, half, base, top, inset=0.0):
        return np.stack([np.full(33, x) + 0.03 * (1 - cz), DRIVER_Y + (half - inset) * cy, base + (top - inset - base) * cz], -1)

    outer = [arch(1.90, 0.115, 0.972, 0.984), arch(1.82, 0.145, 0.960, 1.004), arch(1.74, 0.165, 0.945, 1.027), arch(1.66, 0.176, 0.90, 1.043),
             arch(1.605, 0.180, 0.88, 1.050), arch(1.590, 0.180, 0.87, 1.049), arch(1.583, 0.179, 0.87, 1.046, 0.003)]
    inner = [arch(1.583, 0.179, 0.87, 1.042, 0.006), arch(1.60, 0.179, 0.87, 1.038, 0.010), arch(1.695, 0.172, 0.87, 1.026, 0.012)]
    dash.add(np.array(outer), flipped(grid_faces(len(outer), 33)), "dash")
    dash.add(np.array([outer[-1]] + inner), flipped(grid_faces(4, 33)), "black_plastic")
    wall = inner[-1] + [0.001, 0, 0]
    dash.add(wall, [tuple(range(33))[::-1]], "black_plastic", np.tile([-1.0, 0, 0], (33, 1)))


def vent(dash, y, d, width, height, slats=5):
    """An air vent on the dashboard's face."""
    outer = rounded([(y - width / 2, d - height / 2), (y + width / 2, d - height / 2), (y + width / 2, d + height / 2), (y - width / 2, d + height / 2)], 0.012)
    hole = rounded([(y - width / 2 + 0.009, d - height / 2 + 0.008), (y + width / 2 - 0.009, d - height / 2 + 0.008),
                    (y + width / 2 - 0.009, d + height / 2 - 0.008), (y - width / 2 + 0.009, d + height / 2 - 0.008)], 0.008)
    panel(dash, "under", surface, [hole], 0.03, gap=-0.002, edge=False, offset=0.0015)
    panel(dash, "satin", surface, [outer, hole], 0.03, gap=0, radius=0.0015, depth=0.010, edge_step=0.012, offset=0.010)
    _, n = at(y, d)
    for k in range(slats):
        dk = d - height / 2 + 0.010 + (k + 0.5) * (height - 0.020) / slats
        a, b = at(y - width / 2 + 0.008, dk, 0.006)[0], at(y + width / 2 - 0.008, dk, 0.006)[0]
        v, f = tube(np.array([a, 0.5 * (a + b), b]), 1.0, section=[(-0.001, -0.0045), (0.001, -0.0045), (0.001, 0.0045), (-0.001, 0.0045)], up=n)
        dash.add(v, f, "black_plastic")
    p, n = at(y, d, 0.011)
    v, f = rounded_box(p, (0.008, 0.010, 0.020), 0.002)
    dash.add(v, f, "satin")


def vents(dash):
    for y in (0.665, -0.665):
        vent(dash, y, 0.535, 0.135, 0.070)
    for y in (0.070, -0.070):
        vent(dash, y, 0.545, 0.125, 0.060)


def centre_screen(dash):
    c = np.array([1.565, -0.015, 0.998])
    basis = rotation((0, 0, 1), 9) @ rotation((0, 1, 0), 12)   # turned to the driver, leaning back
    v, f = rounded_box(c, (0.016, 0.262, 0.150), 0.006, basis, 3)
    dash.add(v, f, "piano")
    v, f = rounded_box(c + [0.045, 0, -0.05], (0.08, 0.16, 0.07), 0.02)
    dash.add(v, f, "black_plastic")
    w, h = 0.124, 0.06975
    corners = np.array([c + basis @ np.array([-0.0084, y, z]) for y, z in ((w, -h), (-w, -h), (-w, h), (w, h))])
    dash.add(corners, [(0, 1, 2, 3)], "screen", uvs=[(0, 0), (1, 0), (1, 1), (0, 1)])


def climate(dash):
    """Below the vents: a row of switches and three knobs."""
    loop = rounded([(-0.145, 0.592), (0.145, 0.592), (0.145, 0.70), (-0.145, 0.70)], 0.012)
    panel(dash, "piano", surface, [loop], 0.04, gap=0, radius=0.002, depth=0.006, offset=0.004)
    for k in range(-3, 4):
        p, n = at(0.038 * k, 0.611, 0.006)
        v, f = rounded_box(p, (0.010, 0.033, 0.016), 0.003)
        dash.add(v, f, "red_lens" if k == 0 else "black_plastic")
    for y in (-0.095, 0.0, 0.095):
        p, n = at(y, 0.660, 0.004)
        v, f = lathe([(0.029, 0.0), (0.028, 0.004), (0.023, 0.006), (0.022, 0.022), (0.019, 0.025), (0.0, 0.025)], 28, p, n)
        dash.add(v, f, "black_plastic")
        v, f = lathe([(0.0245, 0.005), (0.0245, 0.010), (0.022, 0.011)], 28, p, n)
        dash.add(v, f, "satin")


def glove_box(dash):
    loop = rounded([(-0.66, 0.605), (-0.20, 0.605), (-0.20, 0.80), (-0.66, 0.80)], 0.02)
    panel(dash, "trim", surface, [loop], 0.05, gap=0, radius=0.004, depth=0.010, offset=0.006)
    p, _ = at(-0.43, 0.635, 0.010)
    v, f = rounded_box(p, (0.012, 0.09, 0.022), 0.005)
    dash.add(v, f, "satin")
    shroud = spline([(1.50, DRIVER_Y, 0.895), (1.56, DRIVER_Y, 0.870), (1.66, DRIVER_Y, 0.825)], 6)
    a = np.linspace(0, 2 * np.pi, 20, endpoint=False)
    section = np.stack([0.058 * np.sign(np.cos(a)) * np.abs(np.cos(a))**0.6, 0.046 * np.sign(np.sin(a)) * np.abs(np.sin(a))**0.6], -1)
    v, f = tube(shroud, np.linspace(0.92, 1.15, len(shroud)), section=section)
    dash.add(v, f, "black_plastic")


def console(dash):
    """Between the seats: from the dashboard down and back to the arm rest."""
    spine = [(1.66, 0.60), (1.52, 0.565), (1.35, 0.535), (1.05, 0.525), (0.80, 0.53)]
    path = spline([(x, 0.0, z) for x, z in spine], 6)
    a = np.linspace(0, np.pi, 15)
    rows = []
    for k, p in enumerate(path):
        half = 0.125 - 0.015 * k / len(path)
        section = [(p[0], half * 1.05, 0.30)] + [(p[0], half * np.sign(np.cos(t)) * np.abs(np.cos(t))**0.22, p[2] - 0.05 + 0.05 * np.sin(t)**0.3) for t in a]
        rows.append(section + [(p[0], -half * 1.05, 0.30)])
    dash.add(np.array(rows), flipped(grid_faces(len(rows), 17)), "trim")
    v, f = rounded_box((0.66, 0, 0.60), (0.36, 0.17, 0.11), 0.035, segments=4)
    dash.add(v, f, "leather")
    v, f = rounded_box((0.66, 0, 0.44), (0.34, 0.19, 0.26), 0.02)
    dash.add(v, f, "trim")
    for x in (0.965, 1.06):
        v, f = lathe([(0.042, 0.0), (0.042, 0.004), (0.036, 0.003), (0.035, -0.05), (0.0, -0.05)], 24, (x, 0.0, 0.5285), (0, 0, 1))
        dash.add(v, f, "satin")


def lever(dash):
    """Gear lever with gaiter."""
    base = np.array([1.255, 0.0, 0.528])
    v, f = lathe([(0.062, 0.0), (0.060, 0.006), (0.050, 0.012), (0.040, 0.032), (0.026, 0.050), (0.012, 0.072)], 24, base, unit([-0.10, 0, 1]))
    dash.add(v, f, "leather")
    v, f = lathe([(0.066, 0.0), (0.067, 0.005), (0.060, 0.008)], 24, base, (0, 0, 1))
    dash.add(v, f, "satin")
    top = base + np.array([-0.012, 0, 0.14])
    v, f = tube(np.array([base, top]), 0.006, 8)
    dash.add(v, f, "chrome")
    v, f = lathe([(0.010, -0.055), (0.016, -0.045), (0.022, -0.015), (0.024, 0.0), (0.021, 0.012), (0.010, 0.019), (0.0, 0.020)], 20, top, unit([-0.1, 0, 1]))
    dash.add(v, f, "leather")
