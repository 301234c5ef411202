"""Reads the channels of the EXR files that fx writes: 32 bits, floats or whole numbers, rows from the top, ZIP or not compressed."""
import array
import struct
import zlib


def _text(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def _header(data):
    at, attributes = 8, {}
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channels(block):
    """Codes of array.array by channel name, in the order of the file."""
    names, at = {}, 0
    while block[at]:
        name, at = _text(block, at)
        kind = struct.unpack_from("<i", block, at)[0]
        if kind not in (0, 2):
            raise ValueError(f"channel {name} is not of 32 bits")
        names[name] = "f" if kind == 2 else "I"
        at += 16
    return names


def _unpacked(data):
    """Undoes the differences and the order of bytes that ZIP in EXR has."""
    delta = bytearray(zlib.decompress(data))
    for i in range(1, len(delta)):
        delta[i] = (delta[i - 1] + delta[i] - 128) & 255
    half = (len(delta) + 1) // 2
    result = bytearray(len(delta))
    result[0::2], result[1::2] = delta[:half], delta[half:]
    return bytes(result)


def read_planes(path):
    """Width, height, and an array of numbers for each channel name."""
    data = path.read_bytes()
    attributes, at = _header(data)
    names = _channels(attributes["channels"])
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    rows = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    planes = {name: array.array(code) for name, code in names.items()}
    for block in range((height + rows - 1) // rows):
        begin = struct.unpack_from("<Q", data, at + 8 * block)[0]
        size = struct.unpack_from("<i", data, begin + 4)[0]
        lines = min(rows, height - block * rows)
        packed = data[begin + 8:begin + 8 + size]
        bytes_ = packed if size == 4 * width * len(names) * lines else _unpacked(packed)
        for line in range(lines):
            for k, name in enumerate(names):
                first = 4 * width * (line * len(names) + k)
                planes[name].frombytes(bytes_[first:first + 4 * width])
    return width, height, planes
