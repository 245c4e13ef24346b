"""Textures of leaves: an atlas of leaf clusters and a strip of forest edge, with alpha; top row first, sRGB values."""
import numpy as np

# 4 x 2 tiles of 256 px, numbered from the top left.
LEAF_TILE = {"broad": 0, "broad_dark": 1, "birch": 2, "bush": 3, "spruce": 4, "spruce_dark": 5, "grass": 6, "reed": 7}


def leaf_uv(name, inset=0.01):
    column, row = LEAF_TILE[name] % 4, LEAF_TILE[name] // 4
    return column / 4 + inset / 4, 1 - (row + 1) / 2 + inset / 2, (column + 1) / 4 - inset / 4, 1 - row / 2 - inset / 2


def _splat(canvas, x, y, length, width, angle, colour):
    """Draws one leaf (a pointed ellipse with a lit side) over what lies there."""
    n, m = canvas.shape[:2]
    reach = int(length / 2 + 2)
    x0, x1, y0, y1 = int(max(x - reach, 0)), int(min(x + reach, m)), int(max(y - reach, 0)), int(min(y + reach, n))
    if x0 >= x1 or y0 >= y1:
        return
    py, px = np.mgrid[y0:y1, x0:x1]
    u = ((px + 0.5 - x) * np.cos(angle) + (py + 0.5 - y) * np.sin(angle)) / (length / 2)
    v = (-(px + 0.5 - x) * np.sin(angle) + (py + 0.5 - y) * np.cos(angle)) / (width / 2)
    inside = (np.abs(v) < 1 - u * u) & (np.abs(u) < 1)
    shade = 1.0 + 0.12 * np.sign(v) - 0.05 * u
    canvas[y0:y1, x0:x1, :3][inside] = np.clip(np.asarray(colour) * shade[..., None], 0, 1)[inside]
    canvas[y0:y1, x0:x1, 3][inside] = 1.0


def _spread_colour(canvas, rounds=24):
    """Lets colour run into the empty part, so that filtering never mixes in black."""
    filled = canvas[..., 3] > 0
    canvas[~filled, :3] = canvas[filled, :3].mean(axis=0)
    for _ in range(rounds):
        blurred = sum(np.roll(canvas[..., :3], shift, axis) for shift in (-1, 1) for axis in (0, 1)) / 4
        canvas[~filled, :3] = blurred[~filled]
    return canvas


def _cluster(colour, leaves, length, seed, spread=0.40):
    """Leaves of a branch end: dark ones behind, light ones in front and above."""
    rng = np.random.default_rng(seed)
    canvas = np.zeros((256, 256, 4))
    for k in range(leaves):
        r, a = spread * 256 * np.sqrt(rng.random()), rng.random() * 2 * np.pi
        front = k / leaves
        light = (0.50 + 0.55 * front) * (0.85 + 0.3 * rng.random()) * (1.0 - 0.15 * np.sin(a) * r / 128)
        hue = np.array([1 + 0.22 * (rng.random() - 0.4), 1.0, 1 - 0.3 * (rng.random() - 0.5)])
        size = length * (0.7 + 0.6 * rng.random())
        _splat(canvas, 128 + r * np.cos(a), 128 + r * np.sin(a), size, 0.55 * size, a + rng.normal(0, 0.8), np.array(colour) * light * hue)
    return _spread_colour(canvas)


def _spruce(colour, seed):
    """A drooping fan of twigs with needles, seen from the side; its stem at the left edge's middle."""
    rng = np.random.default_rng(seed)
    canvas = np.zeros((256, 256, 4))
    for k in range(46):
        t = rng.random()
        x, y = 12 + 215 * t, 100 + 50 * t * t + rng.normal(0, 6)
        reach = (1 - 0.72 * t) * (70 + 40 * rng.random())
        lean = rng.uniform(-0.25, 0.9) * (1 if k % 2 else -0.35)
        light = 0.55 + 0.55 * k / 46
        for step in np.linspace(0, 1, 14):
            px, py = x + 0.5 * reach * step, y + reach * step * lean * 0.9 + 10 * step * step
            for side in (-1, 1):
                _splat(canvas, px, py, 15, 3.6, np.arctan2(lean, 0.6) + side * 0.7 + rng.normal(0, 0.15),
                       np.array(colour) * light * (0.85 + 0.3 * rng.random()))
    return _spread_colour(canvas)


def _blades(colour, count, seed, width):
    """Grass blades from the lower edge upwards."""
    rng = np.random.default_rng(seed)
    canvas = np.zeros((256, 256, 4))
    for k in range(count):
        x, top, bend = 16 + 224 * rng.random(), 60 + 180 * rng.random() ** 0.7, rng.normal(0, 45)
        light = (0.6 + 0.5 * k / count) * (0.85 + 0.3 * rng.random())
        for t in np.linspace(0, 1, 26):
            half = width * (1 - 0.85 * t)
            row, at = int(255 - top * t), x + bend * t * t
            left, right = int(np.clip(at - half, 0, 255)), int(np.clip(at + half + 1, 1, 256))
            canvas[max(row - 8, 0):row + 1, left:right, :3] = np.array(colour) * light * (0.65 + 0.4 * t)
            canvas[max(row - 8, 0):row + 1, left:right, 3] = 1
    return _spread_colour(canvas)


def leaves():
    tiles = {"broad": _cluster((0.33, 0.43, 0.17), 210, 34, 1), "broad_dark": _cluster((0.19, 0.26, 0.11), 210, 34, 2),
             "birch": _cluster((0.42, 0.47, 0.19), 170, 24, 3), "bush": _cluster((0.29, 0.37, 0.17), 300, 26, 4, 0.42),
             "spruce": _spruce((0.21, 0.30, 0.20), 5), "spruce_dark": _spruce((0.14, 0.205, 0.145), 6),
             "grass": _blades((0.36, 0.43, 0.19), 90, 7, 3.2), "reed": _blades((0.50, 0.47, 0.28), 60, 8, 2.6)}
    out = np.zeros((512, 1024, 4))
    for name, index in LEAF_TILE.items():
        row, column = index // 4 * 256, index % 4 * 256
        out[row:row + 256, column:column + 256] = np.clip(tiles[name], 0, 1)
    return out


def forest():
    """A forest's edge, 4 units wide and 1 high, tiling sideways: crowns from the back forward, dark at the foot."""
    rng = np.random.default_rng(9)
    h, w = 256, 1024
    canvas = np.zeros((h, w + 200, 4))
    for layer in range(3):
        for x in np.arange(0, w, 30):
            _forest_tree(canvas, rng, x + rng.uniform(-12, 12) + 100, layer)
    out = canvas[:, 100:w + 100]
    for side in (slice(0, 100), slice(w + 100, w + 200)):
        wrapped = canvas[:, side]
        target = out[:, -100:] if side.start == 0 else out[:, :100]
        fill = (wrapped[..., 3] > 0) & (target[..., 3] == 0)
        target[fill] = wrapped[fill]
    out[h - 60:, :, :3] *= np.linspace(1, 0.45, 60)[:, None, None]
    bare = out[h - 70:, :, 3] == 0
    out[h - 70:][bare] = (0.11, 0.125, 0.085, 1.0)
    return np.clip(_spread_colour(out), 0, 1)


def _forest_tree(canvas, rng, x, layer):
    h = canvas.shape[0]
    spruce = rng.random() < 0.35
    top = rng.uniform(8, 60) + 34 * layer
    colour = np.array([(0.17, 0.24, 0.165), (0.31, 0.39, 0.175), (0.26, 0.35, 0.15), (0.38, 0.40, 0.18)][0 if spruce else rng.integers(1, 4)])
    colour *= 0.72 + 0.14 * layer
    half = rng.uniform(14, 18) if spruce else rng.uniform(24, 36)
    for _ in range(150):
        t = rng.random() ** 0.8
        y = top + (h - top) * t * 0.85
        reach = half * (t ** 0.8 if spruce else np.sqrt(max(1 - (1 - min(t * 2.2, 1)) ** 2, 0.02)))
        u = rng.uniform(-1, 1)
        light = (1.15 - 0.55 * t) * (0.8 + 0.4 * rng.random()) * (1 - 0.18 * u)
        size = 8 if spruce else 9
        _splat(canvas, x + u * reach, y, size * rng.uniform(0.8, 1.5), size * 0.6, rng.uniform(0, 3.1), colour * light)
