"""Lists the differences between the files of two renders, apart from clocks: one line each, none if all bits agree."""

import json
import struct

import exr_bits

# These fields depend on time, speed or free memory.
CLOCKED_ATTRIBUTES = {"capDate", "renderTimeSeconds", "bdpt.renderTimeSeconds"}
CLOCKED_STATS = {"seconds", "per_second", "limit_bytes"}


def compare_keys(before, after, what):
    return [f"{what} {name}: only {side}" for side, names in
            (("before", before.keys() - after.keys()), ("after", after.keys() - before.keys()))
            for name in sorted(names)]


def compare_channels(name, before, after, width):
    places = [i for i, (old, new) in enumerate(zip(before.bits, after.bits)) if old != new]
    if before.length != after.length:
        return [f"channel {name}: {before.length} bytes a value became {after.length}"]
    if not places:
        return []
    at = places[0]
    return [f"channel {name}: {len(places)} of {len(before.bits)} values, the first at pixel ({at % width}, "
            f"{at // width}): {before.number(at):.9g} became {after.number(at):.9g} "
            f"({before.bits[at]:#x}, {after.bits[at]:#x})"]


def of_exr(before, after):
    """Compares two EXR files, given as bytes."""
    old, new = exr_bits.read_exr(before), exr_bits.read_exr(after)
    found = compare_keys(old.attributes, new.attributes, "attribute")
    found += [f"attribute {name}: {value!r} became {new.attributes[name]!r}" for name, value in old.attributes.items()
              if name not in CLOCKED_ATTRIBUTES and value != new.attributes.get(name, value)]
    if (old.width, old.height) != (new.width, new.height):
        return [*found, f"size: {old.width}x{old.height} became {new.width}x{new.height}"]
    found += compare_keys(old.channels, new.channels, "channel")
    for name, channel in old.channels.items():
        if name in new.channels:
            found += compare_channels(name, channel, new.channels[name], old.width)
    return found


def png_pixels(data):
    """Returns the chunks of a PNG file that determine its pixels: header and image data, but no text."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise exr_bits.Unreadable("not a PNG file")
    kept, at = [], 8
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at)
        if data[at + 4:at + 8] in (b"IHDR", b"IDAT"):
            kept.append(data[at + 4:at + 8 + length])
        at += 12 + length
    return kept


def of_png(before, after):
    return [] if png_pixels(before) == png_pixels(after) else ["pixels"]


def without_clocks(value):
    if isinstance(value, dict):
        return {name: without_clocks(part) for name, part in value.items() if name not in CLOCKED_STATS}
    return value


def compare_values(before, after, name):
    if isinstance(before, dict) and isinstance(after, dict):
        found = compare_keys(before, after, name)
        return found + [line for key in before if key in after
                        for line in compare_values(before[key], after[key], f"{name}.{key}" if name else key)]
    return [] if before == after else [f"{name}: {before} became {after}"]


def of_stats(before, after):
    """Compares two files of --stats: counts of rays and paths, defects, settings."""
    return compare_values(without_clocks(json.loads(before)), without_clocks(json.loads(after)), "")


KINDS = {".exr": of_exr, ".png": of_png, ".json": of_stats}


def compare_files(before, after):
    """Compares two files of one kind."""
    try:
        return [f"{before.name}: {line}" for line in KINDS[before.suffix](before.read_bytes(), after.read_bytes())]
    except (exr_bits.Unreadable, OSError, ValueError) as error:
        return [f"{before.name}: {error}"]


def of_folders(before, after):
    """Compares all files that two renders wrote."""
    old, new = ({file.name: file for file in folder.iterdir()} for folder in (before, after))
    found = compare_keys(old, new, "file")
    return found + [line for name in sorted(old.keys() & new.keys()) for line in compare_files(old[name], new[name])]
