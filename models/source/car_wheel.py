"""Wheels: tyre with tread, a five-spoke alloy rim, brake disc. One mesh a side, used twice."""
import bpy
import numpy as np

import car_shape as shape
from car_mesh import Part, flipped, grid_faces, lathe, place

R = shape.TYRE_RADIUS_M


def make(material_of):
    left, right = wheel_mesh("wheel_left", 1, material_of), wheel_mesh("wheel_right", -1, material_of)
    for axle, place_name, steers in ((shape.WHEELBASE_M, "front", True), (0.0, "rear", False)):
        for sign, hand, mesh in ((1, "left", left), (-1, "right", right)):
            extras = {"type": "wheel", "radius_m": R, "steers": steers}
            place(bpy.data.objects.new(f"wheel_{place_name}_{hand}", mesh), (axle, sign * shape.TRACK_M / 2, R), rainglass=extras)


def wheel_mesh(name, sign, material_of):
    """Wheel about the origin, its outside towards y * sign."""
    part = Part(name)
    axis = (0, sign, 0)
    tyre = [(0.213, -0.098), (0.240, -0.105), (0.285, -0.104), (0.306, -0.092), (0.316, -0.070), (R, -0.035), (R, -0.002), (R - 0.006, 0.0), (R, 0.002),
            (R, 0.035), (0.316, 0.070), (0.306, 0.092), (0.285, 0.104), (0.240, 0.105), (0.213, 0.098)]
    v, f = lathe(tyre, 48, (0, 0, 0), axis)
    part.add(v, f, "tyre")
    rim = [(0.218, 0.101), (0.214, 0.103), (0.206, 0.098), (0.203, 0.080), (0.198, 0.0), (0.196, -0.09)]
    v, f = lathe(rim, 48, (0, 0, 0), axis)
    part.add(v, f, "alloy")
    back = [(0.196, -0.09), (0.03, -0.09)]
    v, f = lathe(back, 32, (0, 0, 0), axis)
    part.add(v, f, "under")
    disc = [(0.145, 0.0), (0.145, 0.022), (0.08, 0.022), (0.075, 0.035), (0.0, 0.036)]
    v, f = lathe(disc, 32, (0, 0, 0), axis)
    part.add(v, f, "steel")
    hub = [(0.062, 0.04), (0.058, 0.066), (0.045, 0.078), (0.030, 0.080), (0.028, 0.084), (0.0, 0.085)]
    v, f = lathe(hub, 30, (0, 0, 0), axis)
    part.add(v, f, "alloy")
    for k in range(5):
        for half in (-1, 1):
            spoke(part, 2 * np.pi * k / 5, half, sign)
        a = 2 * np.pi * (k + 0.5) / 5
        v, f = lathe([(0.008, 0.0), (0.008, 0.010), (0.0, 0.011)], 8, (0.043 * np.sin(a), sign * 0.073, 0.043 * np.cos(a)), axis)
        part.add(v, f, "steel")
    o = part.build(material_of)
    mesh = o.data
    bpy.data.objects.remove(o)
    return mesh


def spoke(part, angle, half, sign):
    """One of a pair of spokes, from the hub to the rim."""
    r = np.linspace(0.045, 0.207, 7)
    spread = half * (0.010 + 0.030 * (r - 0.045) / 0.16)
    face = 0.076 + 0.018 * ((r - 0.045) / 0.16)**1.6
    width = 0.011 + 0.003 * ((r - 0.12) / 0.08)**2
    section = np.array([(-1.0, -0.024), (-1.0, -0.006), (-0.65, 0.0), (0.65, 0.0), (1.0, -0.006), (1.0, -0.024)])
    rows = [[(rr * np.sin(angle) + (sp + w * s) * np.cos(angle), sign * (fc + h), rr * np.cos(angle) - (sp + w * s) * np.sin(angle)) for s, h in section]
            for rr, sp, fc, w in zip(r, spread, face, width)]
    faces = grid_faces(len(r), len(section))
    part.add(np.array(rows), flipped(faces) if sign > 0 else faces, "alloy")
