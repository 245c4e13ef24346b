"""A 5 x 7 dot font with the few letters that the signs need."""
import numpy as np

_GLYPHS = {
    "0": "01110 10001 10011 10101 11001 10001 01110", "1": "00100 01100 00100 00100 00100 00100 01110",
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


def stamp_text(tile, text, x, y, width, colour, tall=1.3):
    """Writes text into a square tile from (x, y), fractions with y downwards; width of a letter cell, height = width * tall."""
    n = len(tile)
    for letter, glyph in enumerate(text):
        dots = np.array([[c == "1" for c in row] for row in _GLYPHS[glyph].split()])
        h, w = int(width * tall * n), int(width * 0.84 * n)
        rows, columns = np.arange(h) * 7 // h, np.arange(w) * 5 // w
        top, left = int(y * n), int((x + letter * width) * n)
        area = tile[top:top + h, left:left + w]
        area[dots[rows][:, columns][:area.shape[0], :area.shape[1]]] = colour
