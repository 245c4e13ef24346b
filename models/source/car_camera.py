"""Cameras besides the driver's eye: a look out of the side window and into its mirror, and one behind a lens of its own on the nose."""
import bpy
import numpy as np

import car_glass
import car_shape as shape
from car_mesh import Part, place

LENS = np.array([shape.NOSE_X, 0.0, 0.71])  # middle of the dome, above the grille
DOME_M = 0.03  # radius
DOME_RAD = np.radians(62.0)  # how far round it goes from its axis
RINGS, ROUND = 10, 32


def make(material_of):
    camera("window", shape.EYE, yaw_deg=58.0, pitch_deg=-8.0, fov_deg=70.0, inside=True)
    camera("mirror", shape.EYE, yaw_deg=37.6, pitch_deg=-9.3, fov_deg=20.0, inside=True)
    camera("lens", LENS, fov_deg=95.0)
    dome(material_of)
    housing(material_of)


def camera(name, at, **said):
    place(bpy.data.objects.new("camera_" + name, None), at, rainglass={"type": "camera", "name": name, **said})


def around(axis_m, radius_m):
    """Rings about the lens's axis, each from straight down on: (rings, ROUND, 3)."""
    angle = 2 * np.pi * np.arange(ROUND) / ROUND
    ring = np.stack([np.zeros(ROUND), np.sin(angle), -np.cos(angle)], -1)
    return LENS + np.array([[a, 0, 0] + r * ring for a, r in zip(axis_m, radius_m)])


def between_rings(rings, first=0):
    quads = []
    for r in range(rings - 1):
        for k in range(ROUND):
            a, b = first + r * ROUND + k, first + r * ROUND + (k + 1) % ROUND
            quads.append((a, b, b + ROUND, a + ROUND))
    return quads


def dome(material_of):
    theta = DOME_RAD * np.arange(1, RINGS + 1) / RINGS
    p = np.concatenate([[LENS + [DOME_M, 0, 0]], around(DOME_M * np.cos(theta), DOME_M * np.sin(theta)).reshape(-1, 3)])
    # A map true to length from the dome's middle outward (azimuthal equidistant), as the wet side is seen.
    from_axis = np.concatenate([[0.0], np.repeat(theta, ROUND)])
    turn = np.concatenate([[0.0], np.tile(2 * np.pi * np.arange(ROUND) / ROUND, RINGS)])
    out = from_axis / DOME_RAD * 0.48
    uv = 0.5 + np.stack([out * np.sin(turn), -out * np.cos(turn)], -1)
    faces = [(0, 1 + k, 1 + (k + 1) % ROUND) for k in range(ROUND)] + [f[::-1] for f in between_rings(RINGS, 1)]
    car_glass.pane("lens", p, faces, (p - LENS) / DOME_M, uv, "glass", material_of)


def housing(material_of):
    """An open tube: the dome stands on its front end."""
    rim = DOME_M * np.sin(DOME_RAD)
    front = DOME_M * np.cos(DOME_RAD)
    rings = around([-0.12, front - 0.004, front], [rim + 0.012, rim + 0.010, rim + 0.001])
    faces = between_rings(3)
    Part("camera_housing").add(rings.reshape(-1, 3), faces, "black_plastic").build(material_of)
