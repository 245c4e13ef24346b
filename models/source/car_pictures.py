"""Drawn pictures in the cockpit: instrument dials, centre screen, number plate. Plain numpy, no fonts: a stroke alphabet."""
import numpy as np

# Strokes on a 4 x 6 grid, (x, y) from the lower left corner.
STROKES = {
    "0": ["00 40 46 06 00"], "1": ["10 30", "20 26 04"], "2": ["06 46 43 03 00 40"], "3": ["06 46 40 00", "43 13"],
    "4": ["06 03 43", "46 40"], "5": ["46 06 03 43 40 00"], "6": ["46 06 00 40 43 03"], "7": ["06 46 20"],
    "8": ["00 40 46 06 00", "03 43"], "9": ["43 03 06 46 40 00"], "A": ["00 26 40", "12 32"], "B": ["00 06 36 45 33 03", "33 41 30 00"],
    "C": ["46 06 00 40"], "D": ["00 06 26 44 42 20 00"], "E": ["46 06 00 40", "03 33"], "F": ["46 06 00", "03 33"],
    "G": ["46 06 00 40 43 23"], "H": ["00 06", "40 46", "03 43"], "I": ["20 26"], "K": ["00 06", "46 03 40"], "L": ["06 00 40"],
    "M": ["00 06 23 46 40"], "N": ["00 06 40 46"], "O": ["00 40 46 06 00"], "P": ["00 06 46 43 03"], "R": ["00 06 46 43 03", "23 40"],
    "S": ["46 06 03 43 40 00"], "T": ["06 46", "26 20"], "U": ["06 00 40 46"], "V": ["06 20 46"], "W": ["06 10 23 30 46"],
    "X": ["00 46", "06 40"], "Y": ["06 23 46", "23 20"], ":": ["22 21", "25 24"], "/": ["00 46"], ".": ["10 11"], "-": ["13 33"],
    "°": ["15 26 35 24 15"], " ": [],
}


class Canvas:
    def __init__(self, w, h, color=(0, 0, 0)):
        self.rgb = np.zeros((h, w, 3)) + np.asarray(color, float)
        self.y, self.x = np.mgrid[0:h, 0:w] + 0.5

    def blend(self, distance, color):
        """Paints where a signed distance in pixels is negative, with a soft edge of one pixel."""
        a = np.clip(0.5 - distance, 0, 1)[..., None]
        self.rgb = self.rgb * (1 - a) + np.asarray(color, float) * a

    def line(self, a, b, width, color):
        (x0, y0), (x1, y1) = a, b
        dx, dy = x1 - x0, y1 - y0
        t = np.clip(((self.x - x0) * dx + (self.y - y0) * dy) / max(dx * dx + dy * dy, 1e-9), 0, 1)
        self.blend(np.hypot(self.x - x0 - t * dx, self.y - y0 - t * dy) - width / 2, color)

    def disc(self, c, r, color):
        self.blend(np.hypot(self.x - c[0], self.y - c[1]) - r, color)

    def ring(self, c, r, width, color):
        self.blend(np.abs(np.hypot(self.x - c[0], self.y - c[1]) - r) - width / 2, color)

    def box(self, x0, y0, x1, y1, color, r=0):
        qx = np.abs(self.x - (x0 + x1) / 2) - (x1 - x0) / 2 + r
        qy = np.abs(self.y - (y0 + y1) / 2) - (y1 - y0) / 2 + r
        self.blend(np.hypot(np.maximum(qx, 0), np.maximum(qy, 0)) + np.minimum(np.maximum(qx, qy), 0) - r, color)

    def text(self, s, c, height, color, width=None):
        """Centred text; height in pixels."""
        k = height / 6
        x0 = c[0] - (len(s) * 5.6 - 1.6) * k / 2
        for i, ch in enumerate(s):
            for stroke in STROKES[ch]:
                p = [(x0 + (i * 5.6 + int(q[0])) * k, c[1] + (int(q[1]) - 3) * k) for q in stroke.split()]
                for a, b in zip(p[:-1], p[1:]):
                    self.line(a, b, width or height * 0.16, color)


# Needles and digits are nodes that the host turns (car_instruments.py); they go by what is said here.
SCALE_FROM_DEG, SCALE_SWEEP_DEG = 222.0, -264.0   # counter-clockwise from the right
ENGINE_MOST, SPEED_MOST_KMH = 8, 240              # thousand rpm, km/h
DIALS_PX, DIAL_PX, ENGINE_AT_PX, SPEED_AT_PX = (640, 256), 112, (128, 128), (512, 128)
DISPLAY, DIGIT_PX, ONES_AT_PX = (0.013, 0.017, 0.024), (32, 44), (341, 160)
DIGIT_APART_PX = 48                               # in their own picture, so that smaller copies of it keep them apart


def dial(c, centre, r, labels, ticks, red_from=2.0):
    white, red = (0.85, 0.87, 0.90), (0.75, 0.05, 0.03)
    c.disc(centre, r, (0.010, 0.011, 0.013))
    c.ring(centre, r, 3, (0.20, 0.21, 0.22))
    angle = lambda f: np.radians(SCALE_FROM_DEG + SCALE_SWEEP_DEG * f)
    at = lambda f, k: (centre[0] + k * r * np.cos(angle(f)), centre[1] + k * r * np.sin(angle(f)))
    for i in range(ticks * (len(labels) - 1) + 1):
        f = i / (ticks * (len(labels) - 1))
        major = i % ticks == 0
        c.line(at(f, 0.80 if major else 0.87), at(f, 0.94), 3.0 if major else 1.6, red if f >= red_from else white)
    for i, label in enumerate(labels):
        c.text(label, at(i / (len(labels) - 1), 0.63), r * 0.115, white, 1.9)


def dials():
    """Rev counter, display, speedometer; 3 : 1.2."""
    c = Canvas(*DIALS_PX, (0.006, 0.006, 0.007))
    dial(c, ENGINE_AT_PX, DIAL_PX, [str(i) for i in range(ENGINE_MOST + 1)], 5, 0.74)
    dial(c, SPEED_AT_PX, DIAL_PX, [str(i) for i in range(0, SPEED_MOST_KMH + 1, 40)], 4)
    c.text("X1000", (128, 92), 10, (0.5, 0.5, 0.5), 1.3)
    c.text("KM/H", (512, 92), 11, (0.5, 0.5, 0.5), 1.3)
    c.box(258, 42, 382, 214, DISPLAY, 10)
    c.text("KM/H", (320, 122), 11, (0.45, 0.5, 0.55), 1.5)
    c.line((272, 104), (368, 104), 1.2, (0.15, 0.2, 0.25))
    c.text("8.5 °C", (320, 86), 13, (0.6, 0.65, 0.7), 1.7)
    c.text("12480", (320, 60), 11, (0.35, 0.38, 0.4), 1.4)
    for k, color in enumerate([(0.02, 0.35, 0.05), (0.35, 0.20, 0.01)]):
        c.disc((296 + 48 * k, 226), 6, color)
    return c.rgb


def digits():
    """0 to 9 in a row, as the display shows them; two pixels for one of the dials'."""
    w, h = DIGIT_APART_PX, DIGIT_PX[1]
    c = Canvas(20 * w, 2 * h, DISPLAY)
    for k in range(10):
        c.text(str(k), ((2 * k + 1) * w, h), 74, (0.85, 0.88, 0.92), 8.5)
    return c.rgb


def screen():
    """Centre screen with a map, a clock and tiles; 16 : 9."""
    c = Canvas(512, 288, (0.010, 0.014, 0.020))
    c.box(8, 40, 330, 256, (0.018, 0.030, 0.032), 6)
    rng = np.random.default_rng(11)
    for _ in range(9):
        a, b = rng.uniform((8, 40), (330, 256)), rng.uniform((8, 40), (330, 256))
        c.line(a, b, 3, (0.06, 0.075, 0.085))
    route = [(60, 40), (96, 110), (170, 130), (205, 190), (210, 256)]
    for a, b in zip(route[:-1], route[1:]):
        c.line(a, b, 7, (0.03, 0.22, 0.55))
    c.disc((170, 130), 9, (0.8, 0.85, 0.9))
    c.disc((170, 130), 5, (0.05, 0.30, 0.75))
    for k, label in enumerate(["FM 98.4", "8.5 °C", "LIGHTS"]):
        c.box(342, 190 - 72 * k, 504, 256 - 72 * k, (0.022, 0.030, 0.042), 8)
        c.text(label, (423, 223 - 72 * k), 17, (0.62, 0.68, 0.74), 2.2)
    c.text("10:42", (256, 272), 15, (0.65, 0.68, 0.72), 2.0)
    for k in range(5):
        c.disc((60 + 98 * k, 20), 8, (0.10, 0.13, 0.17))
    return c.rgb


def plate():
    """Number plate, 520 x 112 mm."""
    c = Canvas(416, 90, (0.015, 0.015, 0.016))
    c.box(3, 3, 413, 87, (0.70, 0.70, 0.66), 6)
    c.box(3, 3, 40, 87, (0.01, 0.04, 0.30), 6)
    c.text("RG 1042", (228, 45), 56, (0.015, 0.015, 0.016), 7)
    return c.rgb
