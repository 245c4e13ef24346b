"""Tiling textures made with numpy; each function returns rows of RGB(A) in 0..1 (sRGB values), top row first."""
import numpy as np

from road_font import stamp_text


def noise(n, sigma_px, seed, stretch=(1.0, 1.0)):
    """Tiling noise with zero mean and unit deviation; features of about sigma_px (rows, columns stretched)."""
    rng = np.random.default_rng(seed)
    fy, fx = np.meshgrid(np.fft.fftfreq(n) * stretch[0], np.fft.fftfreq(n) * stretch[1], indexing="ij")
    keep = np.exp(-2 * (np.pi * sigma_px) ** 2 * (fx * fx + fy * fy))
    out = np.fft.ifft2(np.fft.fft2(rng.standard_normal((n, n))) * keep).real
    return (out - out.mean()) / out.std()


def tint(grey, colour, contrast=1.0):
    """A colour (0..1) modulated by noise of unit deviation."""
    return np.clip(np.asarray(colour) * (1 + contrast * grey[..., None]), 0, 1)


def normal_map(height_px):
    """Tangent-space normals (y up the picture) of a tiling height field given in pixels."""
    dx = (np.roll(height_px, -1, 1) - np.roll(height_px, 1, 1)) / 2
    dy = (np.roll(height_px, -1, 0) - np.roll(height_px, 1, 0)) / 2
    n = np.stack([-dx, dy, np.ones_like(dx)], axis=-1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True) * 0.5 + 0.5


# --- carriageway -----------------------------------------------------------------------------------------------------

def _stones(n=512):
    return 0.8 * noise(n, 0.8, 1) + 0.3 * noise(n, 1.6, 2)


def _wheel_tracks(n=512):
    """Across a 3.5 m lane: where tyres have polished and darkened the surface (0..1)."""
    x = (np.arange(n) + 0.5) / n
    track = sum(np.exp(-0.5 * ((x - c) / 0.085) ** 2) for c in (0.28, 0.72))
    return np.broadcast_to(track, (n, n)) * (1 + 0.15 * noise(n, 9, 3, (6, 1)))


def asphalt():
    """One lane wide (3.5 m), 7 m long."""
    n = 512
    grey = 0.325 + 0.040 * np.clip(_stones(), -2.2, 2.6) + 0.008 * noise(n, 20, 4, (0.5, 1)) - 0.035 * _wheel_tracks()
    cracks = np.exp(-np.abs(noise(n, 26, 5)) * 55) * (noise(n, 40, 6) > 0.9)
    seam = np.exp(-0.5 * ((np.arange(n) - 5 + 2 * np.sin(np.arange(n) / n * 6.283)[:, None]) / 1.6) ** 2)
    grey = grey - 0.10 * cracks - 0.08 * seam
    return np.clip(grey[..., None] * np.array([1.0, 1.0, 1.015]), 0, 1)


def asphalt_normal():
    return normal_map(0.55 * _stones())


def asphalt_roughness():
    rough = 0.82 - 0.14 * _wheel_tracks()[::2, ::2] + 0.03 * noise(256, 2, 7)
    return np.stack([np.ones_like(rough), rough, np.zeros_like(rough)], axis=-1)


def concrete():
    n = 256
    y, x = np.mgrid[0:n, 0:n]
    grey = 0.57 + 0.014 * noise(n, 0.9, 10) + 0.014 * noise(n, 26, 11) + 0.022 * noise(n, 2.5, 12, (9, 1))
    grey = grey - 0.035 * (y % 64 < 1) - 0.09 * (x < 2) - 0.03 * ((y % 64 > 28) & (y % 64 < 32) & (x % 64 > 28) & (x % 64 < 32))
    return np.clip(grey[..., None] * np.array([1.0, 0.985, 0.95]), 0, 1)


def tiles():
    """The tunnel's wall panels: pale enamel, joints, grime from below."""
    n = 256
    y, x = np.mgrid[0:n, 0:n]
    joint = ((x % 128) < 2) | ((y % 128) < 2)
    grime = np.clip((y / n) ** 3 * 0.22, 0, 1)
    grey = 0.74 - grime + 0.02 * noise(n, 3, 13) + 0.03 * noise(n, 2.5, 14, (9, 1)) - 0.22 * joint
    return np.clip(grey[..., None] * np.array([1.0, 0.99, 0.93]), 0, 1)


# --- ground ----------------------------------------------------------------------------------------------------------

def grass():
    n = 512
    blades = 0.6 * noise(n, 1.0, 20, (0.4, 1)) + 0.5 * noise(n, 1.2, 21, (1, 0.5))
    green = tint(0.16 * blades + 0.08 * noise(n, 9, 22), (0.385, 0.43, 0.25))
    dry = np.clip(0.5 + 0.5 * noise(n, 12, 23) + 0.35 * blades, 0, 1)[..., None] ** 2
    return np.clip(green + dry * np.array([0.07, 0.045, 0.01]), 0, 1)


def meadow():
    n = 256
    return tint(0.10 * noise(n, 1.2, 24) + 0.08 * noise(n, 8, 25), (0.40, 0.455, 0.27))


def crop():
    n = 256
    rows = np.sin(np.arange(n) / n * 2 * np.pi * 16)[None, :]
    return tint(0.08 * rows + 0.10 * noise(n, 1.1, 26, (0.4, 1)) + 0.05 * noise(n, 12, 27), (0.55, 0.52, 0.32))


def soil():
    n = 256
    rows = np.sin(np.arange(n) / n * 2 * np.pi * 12)[None, :]
    return tint(0.10 * rows + 0.14 * noise(n, 1.3, 28) + 0.05 * noise(n, 10, 29), (0.40, 0.33, 0.26))


def gravel():
    n = 256
    return tint(0.13 * noise(n, 1.2, 30) + 0.08 * noise(n, 2.5, 31) + 0.06 * noise(n, 20, 32), (0.40, 0.375, 0.32))


def paving():
    n = 256
    y, x = np.mgrid[0:n, 0:n]
    joint = ((x % 64) < 2) | ((y % 64) < 2)
    slab = np.random.default_rng(33).standard_normal((4, 4)).repeat(64, 0).repeat(64, 1)
    return tint(0.04 * slab + 0.05 * noise(n, 1, 34) + 0.05 * noise(n, 14, 35) - 0.3 * joint, (0.47, 0.46, 0.44))


def far_woods():
    """Wooded hills far off, already paled by the air between."""
    n = 256
    crowns = noise(n, 2.0, 36) + 0.6 * noise(n, 6, 37)
    return tint(0.10 * crowns + 0.05 * noise(n, 24, 38), (0.37, 0.43, 0.38))


# --- buildings -------------------------------------------------------------------------------------------------------

def plaster():
    n = 256
    streaks = noise(n, 2.5, 40, (9, 1))
    return tint(0.012 * noise(n, 0.8, 41) + 0.018 * streaks + 0.02 * noise(n, 20, 42), (0.84, 0.84, 0.83))


def brick():
    n = 256
    y, x = np.mgrid[0:n, 0:n]
    row = y // 16
    shifted = (x + 16 * (row % 2)) % n
    joint = ((shifted % 32) < 2) | ((y % 16) < 2)
    tone = np.random.default_rng(43).standard_normal((16, 8))[row % 16, shifted // 32]
    out = tint(0.13 * tone + 0.06 * noise(n, 1, 44), (0.46, 0.27, 0.205))
    out[joint] = np.array([0.52, 0.49, 0.45])
    return out


def roof():
    n = 256
    y, x = np.mgrid[0:n, 0:n]
    row = y // 32
    across = ((x + 16 * (row % 2)) % 32) / 32
    down = (y % 32) / 32
    tone = np.random.default_rng(45).standard_normal((8, 8))[row % 8, (((x + 16 * (row % 2)) % n) // 32) % 8]
    shade = 0.10 * np.sin(across * np.pi) + 0.10 * down - 0.30 * (down > 0.93) - 0.12 * ((across < 0.06))
    return tint(shade + 0.09 * tone + 0.05 * noise(n, 1.5, 46) + 0.07 * noise(n, 18, 47), (0.48, 0.305, 0.25))


def bark():
    n = 128
    return tint(0.22 * noise(n, 1.2, 48, (6, 1)) + 0.1 * noise(n, 5, 49), (0.34, 0.30, 0.255))


def paint():
    """Road paint, worn down to the stones in places."""
    n = 256
    grey = 0.78 + 0.03 * noise(n, 1, 50) + 0.02 * noise(n, 12, 51)
    worn = np.clip((noise(n, 1.4, 52) + 0.8 * noise(n, 14, 53) - 1.5) * 1.2, 0, 1)
    return np.clip((grey * (1 - worn) + 0.40 * worn)[..., None] * np.array([1, 1, 0.98]), 0, 1)


# --- one atlas of details: 4 x 4 tiles of 256 px, numbered from the top left -----------------------------------------

TILE = {"window": 0, "curtain": 1, "lit": 2, "door": 3, "shop": 4, "garage": 5, "pump": 6, "price": 7, "speed": 8, "bend": 9,
        "chevron": 10, "tunnel": 11, "name": 12, "brand": 13, "glow": 14, "glass": 15}


def tile_uv(name, inset=0.02):
    """(u0, v0, u1, v1) of an atlas tile, v upwards."""
    column, row = TILE[name] % 4, TILE[name] // 4
    e = inset / 4
    return column / 4 + e, 1 - (row + 1) / 4 + e, (column + 1) / 4 - e, 1 - row / 4 - e


def _fill(t, x0, y0, x1, y1, colour):
    """Fills a rectangle given in fractions of the tile, y downwards."""
    n = len(t)
    t[int(round(y0 * n)):int(round(y1 * n)), int(round(x0 * n)):int(round(x1 * n))] = colour


def _pane(kind):
    t = np.ones((256, 256, 3)) * np.array([0.80, 0.80, 0.78])
    y = np.linspace(0, 1, 256)[:, None, None]
    glass = (0.42 - 0.30 * y) * np.array([0.85, 0.95, 1.0]) + np.zeros((256, 256, 1))
    if kind == "lit":
        x = np.linspace(-1, 1, 256)[None, :, None]
        glass = (0.95 - 0.25 * y - 0.2 * x * x) * np.array([1.0, 0.80, 0.50])
    if kind == "curtain":
        folds = 0.06 * np.sin(np.linspace(0, 50, 256))[None, :, None]
        glass = np.where(np.abs(np.linspace(-1, 1, 256))[None, :, None] > 0.45, 0.66 + folds - 0.15 * y, glass)
    for x0, x1 in ((0.07, 0.48), (0.52, 0.93)):
        for y0, y1 in ((0.06, 0.32), (0.36, 0.94)):
            a = [int(v * 256) for v in (y0, y1, x0, x1)]
            t[a[0]:a[1], a[2]:a[3]] = glass[a[0]:a[1], a[2]:a[3]]
            t[a[0]:a[0] + 4, a[2]:a[3]] *= 0.6
    return t


def _door():
    t = np.ones((256, 256, 3)) * np.array([0.26, 0.19, 0.14])
    for y0, y1 in ((0.08, 0.45), (0.52, 0.92)):
        for x0, x1 in ((0.12, 0.46), (0.54, 0.88)):
            _fill(t, x0, y0, x1, y1, (0.20, 0.145, 0.105))
    _fill(t, 0.15, 0.10, 0.85, 0.30, (0.35, 0.38, 0.38))
    return t


def _shop():
    t = np.ones((256, 256, 3)) * np.array([0.88, 0.86, 0.76])
    rng = np.random.default_rng(60)
    for shelf in range(5):
        y0 = 0.28 + 0.135 * shelf
        for x in np.arange(0.02, 0.98, 0.034):
            _fill(t, x, y0 + 0.02 + 0.03 * rng.random(), x + 0.028, y0 + 0.115, rng.random(3) * 0.55 + 0.2)
        _fill(t, 0, y0 + 0.115, 1, y0 + 0.13, (0.55, 0.55, 0.53))
    for x in (0.0, 0.325, 0.65, 0.975):
        _fill(t, x, 0, x + 0.025, 1, (0.16, 0.17, 0.18))
    _fill(t, 0, 0, 1, 0.05, (0.16, 0.17, 0.18))
    _fill(t, 0, 0.95, 1, 1, (0.16, 0.17, 0.18))
    return t


def _garage():
    t = np.ones((256, 256, 3)) * np.array([0.62, 0.62, 0.60])
    t[::32] *= 0.6
    t[1::32] *= 0.75
    return t


def _pump():
    t = np.ones((256, 256, 3)) * np.array([0.80, 0.81, 0.82])
    _fill(t, 0, 0, 1, 0.12, (0.05, 0.30, 0.33))
    _fill(t, 0.15, 0.18, 0.85, 0.40, (0.08, 0.10, 0.10))
    stamp_text(t, "48.26", 0.22, 0.21, 0.065, (0.75, 0.95, 0.75))
    stamp_text(t, "27.1", 0.34, 0.31, 0.065, (0.75, 0.95, 0.75))
    for x, c in ((0.12, (0.1, 0.1, 0.1)), (0.40, (0.1, 0.35, 0.15)), (0.68, (0.5, 0.35, 0.08))):
        _fill(t, x, 0.50, x + 0.20, 0.80, c)
    _fill(t, 0, 0.93, 1, 1, (0.25, 0.25, 0.26))
    return t


def _price():
    t = np.ones((256, 256, 3)) * np.array([0.07, 0.08, 0.09])
    _fill(t, 0, 0, 1, 0.26, (0.04, 0.32, 0.36))
    stamp_text(t, "TARN", 0.12, 0.06, 0.135, (0.95, 0.95, 0.92))
    for row, (kind, price) in enumerate((("E5", "1.789"), ("E10", "1.729"), ("D", "1.649"))):
        y = 0.32 + 0.225 * row
        stamp_text(t, kind, 0.05, y + 0.03, 0.08, (0.9, 0.9, 0.9))
        stamp_text(t, price, 0.38, y, 0.115, (1.0, 0.72, 0.25))
    return t


def _round_sign():
    t = np.ones((256, 256, 3)) * 0.90
    y, x = np.mgrid[-1:1:256j, -1:1:256j]
    r = np.hypot(x, y)
    t[r > 0.70] = (0.68, 0.06, 0.07)
    stamp_text(t, "50", 0.27, 0.34, 0.245, (0.05, 0.05, 0.05))
    return t


def _bend():
    """A warning of bends, drawn in a triangle that fills the tile."""
    t = np.ones((256, 256, 3)) * 0.90
    y, x = np.mgrid[0:1:256j, -1:1:256j]
    t[(np.abs(x) > y - 0.26) | (y > 0.88)] = (0.68, 0.06, 0.07)
    middle = 0.16 * np.sin((y - 0.45) * 16)
    t[(np.abs(x - middle) < 0.075) & (y > 0.42) & (y < 0.82)] = 0.05
    return t


def _chevron():
    t = np.ones((256, 256, 3)) * 0.88
    y, x = np.mgrid[-1:1:256j, 0:1:256j]
    t[((x + 0.5 * np.abs(y)) % 0.5) < 0.25] = (0.68, 0.06, 0.07)
    return t


def _tunnel_sign():
    t = np.ones((256, 256, 3)) * np.array([0.05, 0.20, 0.48])
    _fill(t, 0.05, 0.05, 0.95, 0.95, (0.9, 0.9, 0.9))
    _fill(t, 0.07, 0.07, 0.93, 0.93, (0.05, 0.20, 0.48))
    y, x = np.mgrid[0:1:256j, -1:1:256j]
    t[(np.hypot(x / 0.55, (y - 0.48) / 0.30) < 1) & (y < 0.48) | ((np.abs(x) < 0.55) & (y >= 0.48) & (y < 0.72))] = 0.9
    t[(np.hypot(x / 0.38, (y - 0.50) / 0.22) < 1) & (y < 0.50) | ((np.abs(x) < 0.38) & (y >= 0.50) & (y < 0.72))] = 0.08
    stamp_text(t, "180 M", 0.24, 0.78, 0.10, (0.9, 0.9, 0.9))
    return t


def _name_sign():
    t = np.ones((256, 256, 3)) * np.array([0.86, 0.68, 0.08])
    _fill(t, 0.03, 0.06, 0.97, 0.94, (0.05, 0.05, 0.05))
    _fill(t, 0.045, 0.085, 0.955, 0.915, (0.86, 0.68, 0.08))
    stamp_text(t, "ELMTAL", 0.10, 0.32, 0.138, (0.05, 0.05, 0.05), tall=2.4)
    return t


def details():
    plain = lambda *rgb: np.ones((256, 256, 3)) * np.array(rgb)
    brand = plain(0.04, 0.32, 0.36)
    _fill(brand, 0, 0.60, 1, 0.72, (0.92, 0.92, 0.90))
    glass = (np.linspace(0.38, 0.10, 256)[:, None, None] * np.array([0.85, 0.95, 1.0])) + np.zeros((256, 256, 1))
    made = {"window": _pane("dark"), "curtain": _pane("curtain"), "lit": _pane("lit"), "door": _door(), "shop": _shop(),
            "garage": _garage(), "pump": _pump(), "price": _price(), "speed": _round_sign(), "bend": _bend(), "chevron": _chevron(),
            "tunnel": _tunnel_sign(), "name": _name_sign(), "brand": brand, "glow": plain(1.0, 0.97, 0.90), "glass": glass}
    out = np.zeros((1024, 1024, 3))
    for name, index in TILE.items():
        row, column = index // 4 * 256, index % 4 * 256
        out[row:row + 256, column:column + 256] = made[name]
    return np.clip(out, 0, 1)


def details_glow():
    """Emission of the same atlas: lit windows, the shop, the price sign, lamps."""
    full, out = details(), np.zeros((1024, 1024, 3))
    for name, gain in (("lit", 0.75), ("shop", 0.6), ("price", 0.8), ("glow", 1.0), ("brand", 0.35), ("pump", 0.12)):
        row, column = TILE[name] // 4 * 256, TILE[name] % 4 * 256
        part = full[row:row + 256, column:column + 256]
        out[row:row + 256, column:column + 256] = gain * part * (part.max(axis=-1, keepdims=True) > 0.3)
    return out[::4, ::4]
