"""A 5 x 7 dot font with the few letters that the signs need."""
import numpy as np

_GLYPHS = {
    "0": "01110 10001 10001 10001 10001 10001 01110", "1": "00100 01100 00100 00100 00100 00100 01110",
    "2": "01110 10001 00001 00110 01000 10000 11111", "3": "01110 10001 00001 00110 00001 10001 01110",
    "4": "00010 00110 01010 10010 11111 00010 00010", "5": "11111 10000 11110 00001 00001 10001 01110",
    "6": "01110 10000 10000 11110 10001 10001 01110", "7": "11111 00001 00010 00100 01000 01000 01000",
    "8": "01110 10001 10001 01110 10001 10001 01110", "9": "01110 10001 10001 01111 00001 00001 01110",
    "A": "01110 10001 10001 11111 10001 10001 10001", "D": "11110 10001 10001 10001 10001 10001 11110",
    "E": "11111 10000 10000 11110 10000 10000 11111", "L": "10000 10000 10000 10000 10000 10000 11111",
    "M": "10001 11011 10101 10101 10001 10001 10001", "N": "10001 11001 10101 10101 10011 10001 10001",
    "R": "11110 10001 10001 11110 10100 10010 10001", "T": "11111 00100 00100 00100 00100 00100 00100",
    ".": "00000 00000 00000 00000 00000 01100 01100", " ": "00000 00000 00000 00000 00000 00000 00000",
}


def _smooth_glyph(glyph, rows, columns):
    """A glyph enlarged with round corners: its dots blended, then cut at half."""
    dots = np.pad([[float(c == "1") for c in row] for row in _GLYPHS[glyph].split()], 1)
    y, x = np.linspace(0.5, 7.5, rows), np.linspace(0.5, 5.5, columns)
    weight = lambda at, count: np.exp(-(((at[:, None] - np.arange(count)[None]) / 0.52) ** 2))
    wy, wx = weight(y, 9), weight(x, 7)
    blended = (wy / wy.sum(1, keepdims=True)) @ dots @ (wx / wx.sum(1, keepdims=True)).T
    return np.clip((blended - 0.42) * 8 + 0.5, 0, 1)


def stamp_text(tile, text, x, y, width, colour, tall=1.3):
    """Writes text into a square tile from (x, y), fractions with y downwards; width of a letter cell, height = width * tall."""
    n = len(tile)
    for letter, glyph in enumerate(text):
        cover = _smooth_glyph(glyph, int(width * tall * n), int(width * 0.84 * n))[..., None]
        top, left = int(y * n), int((x + letter * width) * n)
        area = tile[top:top + cover.shape[0], left:left + cover.shape[1]]
        cover = cover[:area.shape[0], :area.shape[1]]
        area[:] = area * (1 - cover) + np.asarray(colour) * cover
