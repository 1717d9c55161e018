"""What is drawn in a picture (PNG, 8 bits a channel, RGB)."""
import struct
import zlib

COLOURFUL = 40  # grey, as an empty page and its text are, has less between its channels


def coloured_pixels(path):
    """How many pixels are not grey, and how many columns there are."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG"
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert (depth, kind) == (8, 2), f"{path} has not 8 bits of RGB"
    packed = b""
    at = 8
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        if name == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    coloured = 0
    above = bytearray(3 * width)
    raw = zlib.decompress(packed)
    for row in range(height):
        start = row * (3 * width + 1)
        above = _unfiltered(raw[start], bytearray(raw[start + 1:start + 1 + 3 * width]), above)
        pixels = zip(above[0::3], above[1::3], above[2::3])
        coloured += sum(max(pixel) - min(pixel) > COLOURFUL for pixel in pixels)
    return coloured, width


def _unfiltered(kind, line, above):
    """A line without the PNG's filter, of which `kind` is the number."""
    for i, value in enumerate(line):
        left = line[i - 3] if i >= 3 else 0
        corner = above[i - 3] if i >= 3 else 0
        if kind == 4:
            guess = left + above[i] - corner
            nearest = min((left, above[i], corner), key=lambda candidate: abs(guess - candidate))
        else:
            nearest = (0, left, above[i], (left + above[i]) // 2)[kind]
        line[i] = (value + nearest) & 0xff
    return line
