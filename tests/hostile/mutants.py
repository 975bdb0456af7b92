"""Makes broken twins of valid files; the seed determines them."""

import json
import random
import re
import struct

EXTREMES = ["-1", "0", "1", "2", "4", "255", "256", "65535", "65536", "2147483647", "2147483648", "4294967295",
            "4294967296", "9223372036854775807", "18446744073709551615", "18446744073709551616", "1e15", "3e38", "1e39",
            "1e308", "1e999", "1e-45", "-0.0", "0.5", "null", "true", '""', "[]", "{}"]
WORDS = [0, 1, 0x7F, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7F800000, 0x7FC00000, 0x7F7FFFFF]


def split_glb(data):
    """Returns (JSON text, other chunks), or None."""
    if data[:4] != b"glTF" or len(data) < 20:
        return None
    length = struct.unpack_from("<I", data, 12)[0]
    return data[20:20 + length], data[20 + length:]


def join_glb(text, rest):
    text += b" " * (-len(text) % 4)
    if len(rest) >= 8:
        rest = struct.pack("<I", len(rest) - 8) + rest[4:]
    return struct.pack("<IIIII", 0x46546C67, 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


def flip_bits(data, chance):
    data = bytearray(data)
    for _ in range(chance.randint(1, 8)):
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    return bytes(data)


def truncate(data, chance):
    return data[:chance.randrange(len(data))]


def put_word(data, chance):
    place = chance.randrange(max(1, len(data) - 4))
    return data[:place] + struct.pack("<I", chance.choice(WORDS)) + data[place + 4:]


def mutate_numbers(text, chance):
    """Replaces numbers by extreme values or by each other. `text` is JSON."""
    for _ in range(chance.randint(1, 3)):
        places = [match.span() for match in re.finditer(rb"(?<=[:\[,])-?\d[\d.eE+-]*(?=[,\]}])", text)]
        if not places:
            return text
        begin, end = chance.choice(places)
        other = chance.choice(places)
        value = chance.choice(EXTREMES).encode() if chance.random() < 0.7 else text[other[0]:other[1]]
        text = text[:begin] + value + text[end:]
    return text


def remove_member(text, chance):
    """Removes one member of one object."""
    document = json.loads(text)
    places = []

    def visit(value):
        if isinstance(value, dict):
            places.extend((value, key) for key in value)
        for child in value.values() if isinstance(value, dict) else value if isinstance(value, list) else []:
            visit(child)

    visit(document)
    holder, key = chance.choice(places)
    del holder[key]
    return json.dumps(document, separators=(",", ":")).encode()


def mutate(data, seed):
    """Returns one mutant of a scene or an image."""
    chance = random.Random(seed)
    glb = split_glb(data)
    if not glb and not data.lstrip().startswith(b"{"):
        return chance.choice([flip_bits, put_word, truncate])(data, chance)
    if glb and chance.random() < 0.8:
        text, rest = glb
        if rest and chance.random() < 0.4:
            change = chance.choice([flip_bits, flip_bits, put_word, truncate])
            return join_glb(text, rest[:8] + change(rest[8:] or b"\0", chance))
        change = chance.choice([mutate_numbers, mutate_numbers, remove_member])
        return join_glb(change(compact(text), chance), rest)
    if not glb and chance.random() < 0.8:
        return chance.choice([mutate_numbers, mutate_numbers, remove_member])(compact(data), chance)
    return chance.choice([flip_bits, put_word, truncate])(data, chance)


def compact(text):
    return json.dumps(json.loads(text.decode("utf-8-sig").rstrip("\0 ")), separators=(",", ":")).encode()
