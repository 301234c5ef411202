"""Pixels of a PNG, for the tests beside this file."""
import struct
import zlib


class Pixels:
    """RGB rows of a PNG with 8 bits, cut to a rectangle."""

    def __init__(self, path, rectangle=None):
        data = path.read_bytes()
        width, height, _, kind = struct.unpack(">IIBB", data[16:26])
        channels = {2: 3, 6: 4}[kind]
        packed, at = b"", 8
        while at < len(data):
            size, = struct.unpack(">I", data[at:at + 4])
            packed += data[at + 8:at + 8 + size] if data[at + 4:at + 8] == b"IDAT" else b""
            at += 12 + size
        raw = zlib.decompress(packed)
        stride = width * channels
        left, top, right, bottom = rectangle or (0, 0, width, height)
        before, self.rows = bytes(stride), []
        for y in range(bottom):
            kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
            for i in range(stride if kind else 0):
                a, b, c = line[i - channels] if i >= channels else 0, before[i], before[i - channels] if i >= channels else 0
                nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
                line[i] = (line[i] + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
            before = bytes(line)
            if y >= top:
                self.rows.append(before[left * channels:right * channels])

    def __eq__(self, other):
        return self.rows == other.rows

    def mean(self):
        return sum(map(sum, self.rows)) / sum(map(len, self.rows))
