"""What the driver holds: steering wheel, stalks, pedals."""
import bpy
import numpy as np

import car_shape as shape
from car_mesh import Part, axes_for, flipped, grid_faces, lathe, place, rounded_box, spline, tube, unit

HUB = np.array([1.430, shape.EYE[1], 0.905])
TILT_RAD = np.radians(24.0)
AXIS = np.array([-np.cos(TILT_RAD), 0, np.sin(TILT_RAD)])   # towards the driver
UP = np.array([np.sin(TILT_RAD), 0, np.cos(TILT_RAD)])      # towards the top of the rim
RIGHT = np.array([0, -1.0, 0])
RIM_M = 0.183


def make(material_of):
    basis = axes_for(AXIS, RIGHT)
    node = place(bpy.data.objects.new("steering_wheel", None), HUB, basis, rainglass={"type": "steering_wheel", "ratio": 15.0})
    wheel = Part("steering_wheel_mesh")
    rim(wheel), spokes(wheel), pad(wheel)
    wheel.build(material_of, HUB, basis, node)
    others = Part("stalks_and_pedals")
    stalks(others), pedals(others)
    others.build(material_of)


def on(r, u, h):
    """Point in the wheel's frame: right, up, towards the driver."""
    return HUB + np.multiply.outer(r, RIGHT) + np.multiply.outer(u, UP) + np.multiply.outer(h, AXIS)


def rim(wheel):
    a = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    flat = np.where(np.sin(a) < -0.80, 0.965, 1.0)
    path = on(RIM_M * np.cos(a), RIM_M * np.sin(a) * flat, np.zeros(72))
    # thicker where the thumbs rest
    thick = 0.0152 + 0.0022 * (np.exp(-((a - 0.45) / 0.22)**2) + np.exp(-((a - np.pi + 0.45) / 0.22)**2))
    v, f = tube(path, thick, 14, closed=True, up=AXIS)
    wheel.add(v, f, "leather")
    for t in (-0.32, np.pi + 0.32, 0.78, np.pi - 0.78):  # seams in the leather
        p = on(np.array(RIM_M * np.cos(t)), np.array(RIM_M * np.sin(t)), np.array(0.0))
        ring = np.linspace(0, 2 * np.pi, 14, endpoint=False)
        outward = np.cos(t) * RIGHT + np.sin(t) * UP
        r = 0.0162 + 0.0022 * np.exp(-((abs(t - np.pi / 2) - 1.12) / 0.22)**2)
        loop = p + r * (np.cos(ring)[:, None] * outward + np.sin(ring)[:, None] * AXIS)
        v, f = tube(loop, 0.0009, 4, closed=True, up=np.cross(outward, AXIS))
        wheel.add(v, f, "black_plastic")


def bar(wheel, points, widths, thick, material):
    """A flat bar through (right, up, height) points with a softly rounded section."""
    p = spline(np.array(points, float), 5)
    w = np.interp(np.linspace(0, 1, len(p)), np.linspace(0, 1, len(widths)), widths)
    path = on(p[:, 0], p[:, 1], p[:, 2])
    along = unit(np.gradient(path, axis=0))
    side = unit(np.cross(along, AXIS))
    section = np.array([(-1, -1), (1, -1), (1, 0.2), (0.8, 1), (-0.8, 1), (-1, 0.2)])
    verts = path[:, None] + section[None, :, :1] * side[:, None] * w[:, None, None] / 2 + section[None, :, 1:] * AXIS * thick / 2
    wheel.add(verts, flipped(grid_faces(len(p), 6, wrap_cols=True)), material)


def spokes(wheel):
    for s in (1, -1):
        bar(wheel, [(s * 0.045, 0.010, -0.002), (s * 0.10, 0.016, -0.012), (s * 0.172, 0.030, -0.004)], [0.075, 0.058, 0.044], 0.016, "black_plastic")
        bar(wheel, [(s * 0.060, -0.022, 0.004), (s * 0.11, -0.014, -0.004), (s * 0.168, 0.004, 0.002)], [0.008, 0.007, 0.006], 0.014, "satin")
        for k, (x, y) in enumerate(((0.094, 0.030), (0.122, 0.034), (0.094, 0.008), (0.122, 0.013))):
            v, f = rounded_box(on(np.array(s * x), np.array(y), np.array(-0.002)), (0.020, 0.022, 0.010), 0.003, np.stack([UP, -RIGHT, AXIS], -1))
            wheel.add(v, f, "piano")
    bar(wheel, [(-0.02, -0.05, -0.004), (-0.022, -0.11, -0.010), (-0.024, -0.172, -0.002)], [0.016, 0.014, 0.014], 0.014, "satin")
    bar(wheel, [(0.02, -0.05, -0.004), (0.022, -0.11, -0.010), (0.024, -0.172, -0.002)], [0.016, 0.014, 0.014], 0.014, "satin")


def pad(wheel):
    """Airbag cover with badge, and the hub behind it."""
    shape2 = spline([(0.078, 0.035), (0.05, 0.062), (0.0, 0.068), (-0.05, 0.062), (-0.078, 0.035), (-0.074, -0.02), (-0.045, -0.066), (0.0, -0.078),
                     (0.045, -0.066), (0.074, -0.02)], 5, closed=True)
    rows = []
    for scale, height in ((1.0, -0.045), (1.0, 0.004), (0.975, 0.014), (0.90, 0.021), (0.70, 0.028), (0.40, 0.031), (0.05, 0.032)):
        rows.append(on(shape2[:, 0] * scale, shape2[:, 1] * scale, np.full(len(shape2), height)))
    wheel.add(np.array(rows), grid_faces(len(rows), len(shape2), wrap_cols=True), "leather")
    centre = on(np.array(0.0), np.array(0.0), np.array(0.031))
    v, f = lathe([(0.022, 0.0), (0.0215, 0.003), (0.017, 0.004), (0.016, 0.0025), (0.0, 0.0035)], 28, centre, AXIS)
    wheel.add(v, f, "chrome")
    v, f = lathe([(0.040, -0.10), (0.048, -0.045)], 20, HUB, AXIS)
    wheel.add(v, f, "black_plastic")


def stalks(part):
    base = HUB - 0.075 * AXIS
    for s in (1, -1):
        p = spline([base + s * np.array([0, 0.04, 0]), base + s * np.array([0, 0.10, 0]) + 0.020 * UP + 0.01 * AXIS,
                    base + s * np.array([0, 0.172, 0]) + 0.038 * UP + 0.022 * AXIS], 6)
        r = np.concatenate([np.linspace(0.009, 0.0085, 8), [0.0095, 0.0125, 0.0125, 0.0125, 0.010]])
        section = [(np.cos(t), 0.75 * np.sin(t)) for t in np.linspace(0, 2 * np.pi, 10, endpoint=False)]
        v, f = tube(p, r[:len(p)], section=section)
        part.add(v, f, "black_plastic")


def pedals(part):
    for y, width in ((0.52, 0.055), (0.40, 0.07), (0.27, 0.05)):
        v, f = rounded_box((1.80, y, 0.42), (0.012, width, 0.075), 0.004, np.array([[0.8, 0, 0.6], [0, 1, 0], [-0.6, 0, 0.8]]))
        part.add(v, f, "rubber")
        v, f = tube(np.array([(1.81, y, 0.43), (1.88, y, 0.62)]), 0.008, 6)
        part.add(v, f, "steel")
