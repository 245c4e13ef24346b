"""The instruments under their hood: a painted face, needles before it, and digits that turn through it from behind.

A digit is a drum as in an odometer, with eleven sides about an axis to the right: one empty, then 0 to 9 upwards. Only the
side in front comes through the face, by so little that its neighbours, which lean back, do not.
"""
import numpy as np

import car_pictures as painted
import car_shape as shape
from car_mesh import Part, axes_for, lathe, tube, unit

MIDDLE = np.array([1.645, shape.EYE[1], 0.958])
OUT = unit(shape.EYE - [1.66, shape.EYE[1], 0.955])   # towards the driver
RIGHT = np.array([0, -1.0, 0])
UP = np.cross(OUT, RIGHT)
WIDTH_M = 0.300
M_PER_PX = WIDTH_M / painted.DIALS_PX[0]
DIAL_M, CAP_M = painted.DIAL_PX * M_PER_PX, 0.0063
DRUM_SIDES, DRUM_M = 11, 0.042   # the sides' distance from the axis


def make(material_of):
    still = Part("instruments")
    face(still)
    for at_px in (painted.ENGINE_AT_PX, painted.SPEED_AT_PX):
        ring_and_cap(still, at(at_px))
    still.build(material_of)
    needle("engine_rpm", painted.ENGINE_AT_PX, 1000.0 * painted.ENGINE_MOST, material_of)
    needle("speed_kmh", painted.SPEED_AT_PX, float(painted.SPEED_MOST_KMH), material_of)
    for place in range(3):
        digit(place, material_of)


def at(px, lift=0.0):
    """Where a pixel of the face's picture lies."""
    x, y = (np.array(px) - np.array(painted.DIALS_PX) / 2) * M_PER_PX
    return MIDDLE + x * RIGHT + y * UP + lift * OUT


def face(part):
    w, h = painted.DIALS_PX
    part.add([at((0, 0)), at((w, 0)), at((w, h)), at((0, h))], [(0, 1, 2, 3)], "dials", uvs=[(0, 0), (1, 0), (1, 1), (0, 1)])


def ring_and_cap(part, centre):
    """A dial's chromed rim, and what covers its needle's axle."""
    a = np.linspace(0, 2 * np.pi, 40, endpoint=False)[:, None]
    v, f = tube(centre + 0.003 * OUT + 0.0535 * (UP * np.sin(a) - RIGHT * np.cos(a)), 0.0022, 6, closed=True, up=OUT)
    part.add(v, f, "satin")
    v, f = lathe([(CAP_M, 0.0), (CAP_M, 0.0025), (0.9 * CAP_M, 0.0030), (0.0, 0.0030)], 28, centre, OUT)
    part.add(v, f, "black_plastic")


def needle(shows, at_px, most, material_of):
    a = np.radians(painted.SCALE_FROM_DEG)
    along, across = np.cos(a) * RIGHT + np.sin(a) * UP, np.cos(a) * UP - np.sin(a) * RIGHT
    centre = at(at_px, 0.0015)
    part = Part("needle_" + shows)
    part.add([centre + r * DIAL_M * along + w * across for r, w in ((0.0, 0.0013), (0.0, -0.0013), (0.86, -0.0010), (0.86, 0.0010))],
             [(0, 1, 2, 3)], "needle")
    part.build(material_of, centre, axes_for(OUT, RIGHT),
               rainglass={"type": "needle", "shows": shows, "full": most, "sweep_deg": painted.SCALE_SWEEP_DEG})


def digit(place, material_of):
    w, h = painted.DIGIT_PX
    axis = at((painted.ONES_AT_PX[0] - place * w, painted.ONES_AT_PX[1]), 0.0004 - DRUM_M)
    part = Part(f"digit_{place}")
    for k in range(10):
        a = 2 * np.pi * (k + 1) / DRUM_SIDES
        out, up = np.cos(a) * OUT + np.sin(a) * UP, np.cos(a) * UP - np.sin(a) * OUT
        corners = [axis + DRUM_M * out + M_PER_PX * (x * w / 2 * RIGHT + y * h / 2 * up) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        left, right = [(k + 0.5 + x * w / 2 / painted.DIGIT_APART_PX) / 10 for x in (-1, 1)]
        part.add(corners, [(0, 1, 2, 3)], "digits", uvs=[(left, 0), (right, 0), (right, 1), (left, 1)])
    part.build(material_of, axis, axes_for(RIGHT, UP), rainglass={"type": "digit", "shows": "speed_kmh", "place": place})
