"""Front seats and the rear bench: padded blocks with bolsters, head rests, belts."""
import numpy as np

import car_shape as shape
from car_mesh import Part, flipped, grid_faces, rotation, rounded_box, spline, tube, unit


def make(material_of):
    seats = Part("seats")
    for y in (shape.EYE[1], -shape.EYE[1]):
        cushion(seats, y, 0.27), backrest(seats, y, 0.255), head_rest(seats, np.array([0.615, y, 1.175]), 0.125)
    bench(seats)
    belts(seats)
    seats.build(material_of)


def padded(part, spine, normals, half, thick, bolster, material, side_material):
    """A pad along a spine of points; `bolster` lifts its sides. The sides get the second material."""
    s = np.linspace(-1, 1, 15)
    lift = bolster * np.abs(s)**3.5
    spine, normals = np.asarray(spine), unit(normals)
    left = np.array([0, 1.0, 0])
    round_off = np.minimum(1, np.linspace(0, 1, len(spine)) * 6)**0.5 * np.minimum(1, np.linspace(1, 0, len(spine)) * 6)**0.5
    face = []
    for p, n, r in zip(spine, normals, round_off):
        seam = -0.006 * np.exp(-((np.abs(s) - 0.62) / 0.06)**2)
        face.append(p + np.outer(s * half, left) + np.outer((lift + seam) * r - 0.035 * (1 - r), n))
    face = np.array(face)
    inner = slice(3, 12)
    n_rows = len(spine)
    part.add(face[:, inner], flipped(grid_faces(n_rows, 9)), material)
    for cols in (slice(0, 4), slice(11, 15)):
        part.add(face[:, cols], flipped(grid_faces(n_rows, 4)), side_material)
    border = np.concatenate([face[:, 0], face[-1, 1:], face[-2::-1, -1], face[0, -2:0:-1]])
    n = np.concatenate([normals, np.repeat(normals[-1:], 14, 0), normals[-2::-1], np.repeat(normals[:1], 13, 0)])
    centre = border.mean(0)
    rows = [border, border - n * 0.02 + 0.012 * unit(border - centre), border - n * thick]
    part.add(np.array(rows), flipped(grid_faces(3, len(border), wrap_cols=True)), side_material)
    back = face - (normals * thick)[:, None]
    part.add(back[:, [0, -1]], grid_faces(n_rows, 2), side_material)


def curve(points, per=5):
    p = spline([(x, 0, z) for x, z in points], per)
    t = unit(np.gradient(p, axis=0))
    return p, np.stack([-t[:, 2], 0 * t[:, 0], t[:, 0]], -1)


def cushion(part, y, half):
    p, n = curve([(0.70, 0.505), (0.80, 0.500), (1.00, 0.525), (1.16, 0.545), (1.235, 0.520), (1.25, 0.47)])
    padded(part, p + [0, y, 0], n, half, 0.13, 0.045, "fabric", "fabric_side")
    v, f = rounded_box((0.97, y, 0.345), (0.46, 0.40, 0.12), 0.03)
    part.add(v, f, "black_plastic")


def backrest(part, y, half):
    p, n = curve([(0.545, 1.115), (0.590, 1.085), (0.635, 0.95), (0.685, 0.78), (0.715, 0.62), (0.735, 0.53)])
    padded(part, p + [0, y, 0], n, half, 0.10, 0.055, "fabric", "fabric_side")


def head_rest(part, at, half):
    basis = rotation((0, 1, 0), -12)
    v, f = rounded_box(at + [-0.045, 0, 0.02], (0.085, 2 * half, 0.165), 0.036, basis, 4)
    part.add(v, f, "fabric_side")
    for s in (-1, 1):
        q = at + [-0.055, s * 0.06, 0]
        v, f = tube(np.array([q + [0, 0, -0.13], q]), 0.006, 6)
        part.add(v, f, "chrome")


def bench(part):
    p, n = curve([(-0.10, 0.52), (0.05, 0.515), (0.22, 0.545), (0.32, 0.545), (0.345, 0.49)])
    padded(part, p, n, 0.62, 0.16, 0.0, "fabric", "fabric_side")
    p, n = curve([(-0.335, 1.02), (-0.30, 0.99), (-0.22, 0.80), (-0.14, 0.62), (-0.12, 0.55)])
    padded(part, p, n, 0.60, 0.10, 0.0, "fabric", "fabric_side")
    for y in (-0.38, 0.38):
        head_rest(part, np.array([-0.28, y, 1.075]), 0.12)
    v, f = rounded_box((-0.46, 0, 0.965), (0.24, 1.06, 0.02), 0.006)   # parcel shelf
    part.add(v, f, "carpet")


def belts(part):
    for s in (1, -1):
        path = spline([(0.93, 0.715 * s, 1.16), (0.78, 0.70 * s, 1.08), (0.74, 0.665 * s, 0.80), (0.80, 0.66 * s, 0.40)], 6)
        v, f = tube(path, 1.0, section=[(-0.023, -0.001), (0.023, -0.001), (0.023, 0.001), (-0.023, 0.001)], up=(0, s, 0))
        part.add(v, f, "belt")
        v, f = rounded_box((0.94, 0.722 * s, 1.17), (0.05, 0.02, 0.07), 0.008)
        part.add(v, f, "black_plastic")
