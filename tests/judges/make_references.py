#!/usr/bin/env python3
"""Makes the reference pictures of tests/judges with Mitsuba 3, or checks them.

    pip install mitsuba
    python3 tests/judges/make_references.py            writes the pictures beside this file
    python3 tests/judges/make_references.py --check    renders again, and compares with them

Each picture shows the scene of the same name in this folder (.ron), which Rayline draws. Mitsuba computes the
same light by its own code: direct light and one mirrored ray, or, for the last two scenes, paths of several
bounces. A pixel holds linear light in 16 bits; the largest code is WHITE.
"""

import math
import struct
import sys
import zlib
from pathlib import Path

import mitsuba as mi

mi.set_variant("scalar_rgb")

FOLDER = Path(__file__).resolve().parent
WIDTH, HEIGHT = 64, 48
SAMPLES = 4096
# The light of the largest code.
WHITE = 4.0
# The most that two renderings may differ, as a share of the mean light: noise, which paths have more of.
NOISE, NOISE_OF_PATHS = 0.01, 0.02

T = mi.ScalarTransform4f


def camera(lens=None):
    """The camera of all scenes; `lens` is the radius of the aperture and the distance in focus."""
    described = {
        "type": "perspective" if lens is None else "thinlens",
        "to_world": T().look_at(origin=[0, 2.5, 6], target=[0, 0.75, 0], up=[0, 1, 0]),
        "fov_axis": "y",
        "fov": math.degrees(0.6),
        "film": {
            "type": "hdrfilm",
            "width": WIDTH,
            "height": HEIGHT,
            "pixel_format": "rgb",
            "component_format": "float32",
            "rfilter": {"type": "box"},
        },
        "sampler": {"type": "multijitter", "sample_count": SAMPLES},
    }
    if lens is not None:
        described["aperture_radius"], described["focus_distance"] = lens
    return described


def matte(red, green, blue):
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(red, green, blue)}}


def rgb(*color):
    return {"type": "rgb", "value": list(color)}


def floor(bsdf):
    flat = T().rotate([1, 0, 0], -90) @ T().scale(5000)
    return {"type": "rectangle", "to_world": flat, "bsdf": bsdf}


def ball(center, radius, **more):
    return {"type": "sphere", "center": center, "radius": radius, **more}


def lamp(*color):
    return {"type": "area", "radiance": rgb(*color)}


WALL = matte(0.73, 0.73, 0.73)
BLACK = {"type": "diffuse", "reflectance": rgb(0, 0, 0)}


def below(light):
    """A floor and two balls below a lamp."""
    return {
        "sensor": camera(),
        "floor": floor(matte(0.8, 0.8, 0.8)),
        "first": ball([-0.7, 0.6, 0.2], 0.6, bsdf=matte(0.7, 0.2, 0.1)),
        "second": ball([0.9, 0.4, 0.6], 0.4, bsdf=matte(0.2, 0.3, 0.8)),
        "lamp": light,
    }


def scenes():
    yield "rectangle", below({
        "type": "rectangle",
        # Mitsuba's rectangle is 2 wide and faces +z: this one faces down.
        "to_world": T().translate([0.25, 3, 0.5]) @ T().rotate([1, 0, 0], 90) @ T().scale([1, 0.5, 1]),
        "bsdf": BLACK,
        "emitter": lamp(16, 16, 16),
    })
    toward = [-0.25, 0.5, 0]
    yield "disc", below({
        "type": "disk",
        "to_world": T().look_at(origin=[1.25, 3, 0.5], target=toward, up=[0, 0, 1]) @ T().scale(0.6),
        "bsdf": BLACK,
        "emitter": lamp(24, 21, 18),
    })
    yield "ball", below(ball([-1.5, 2.5, 1.5], 0.4, bsdf=BLACK, emitter=lamp(30, 30, 25)))
    yield "lens", {
        "sensor": camera((0.25, 6)),
        "floor": floor(matte(0.8, 0.8, 0.8)),
        "near": ball([-0.9, 0.5, 2.5], 0.5, bsdf=matte(0.7, 0.2, 0.1)),
        "sharp": ball([0.1, 0.5, 0.25], 0.5, bsdf=matte(0.2, 0.3, 0.8)),
        "far": ball([1.6, 0.5, -3], 0.5, bsdf=matte(0.2, 0.7, 0.2)),
        # Rayline's directional light shows a white surface that faces it as 1: π over π.
        "light": {
            "type": "directional",
            "direction": [1, -2, -1],
            "irradiance": rgb(math.pi, math.pi, math.pi),
        },
    }
    # A Beckmann lobe of half vectors, exp(-tan²θ/α²), is one of mirrored directions, which turn twice as far:
    # about exp(-δ²/4α²). Phong's lobe, cosⁿδ, is about exp(-nδ²/2). So n = 1/(2α²), for small angles.
    rough = {"type": "roughconductor", "material": "none", "distribution": "beckmann", "alpha": 0.1}
    above = camera()
    above["to_world"] = T().look_at(origin=[0, 6, 0.5], target=[0, 0, 0], up=[0, 0, -1])
    yield "rough", {
        "sensor": above,
        "floor": floor(rough),
        "red": ball([-1, 4.5, -0.5], 0.5, bsdf=BLACK, emitter=lamp(2, 0.5, 0.5)),
        "blue": ball([1, 3.5, 0], 0.4, bsdf=BLACK, emitter=lamp(0.5, 0.5, 2)),
        "green": ball([0, 3, -1.25], 0.3, bsdf=BLACK, emitter=lamp(0.5, 2, 0.5)),
    }
    yield "cornell", {
        "integrator": paths(8),
        "sensor": camera() | {
            "to_world": T().look_at(origin=[2.78, 2.73, -8], target=[2.78, 2.73, 2.8], up=[0, 1, 0]),
            "fov": math.degrees(0.686),
        },
        "floor": face([0, 0, 0], [0, 0, 5.592], [5.56, 0, 0], WALL),
        "ceiling": face([0, 5.488, 0], [5.56, 0, 0], [0, 0, 5.592], WALL),
        "back": face([0, 0, 5.592], [0, 5.488, 0], [5.56, 0, 0], WALL),
        "right": face([0, 0, 0], [0, 5.488, 0], [0, 0, 5.592], matte(0.14, 0.45, 0.091)),
        "left": face([5.56, 0, 0], [0, 0, 5.592], [0, 5.488, 0], matte(0.63, 0.065, 0.05)),
        "tall": block([3.68, 1.65, 3.51], [0.79, 0, -0.245], [0, 1.65, 0], [0.245, 0, 0.79]),
        "short": block([1.855, 0.825, 1.69], [0.79, 0, 0.235], [0, 0.825, 0], [-0.235, 0, 0.79]),
        "lamp": face([2.13, 5.48, 2.27], [1.3, 0, 0], [0, 0, 1.05], BLACK) | {"emitter": lamp(17, 12, 4)},
    }
    yield "caustic", {
        "integrator": paths(6),
        "sensor": camera(),
        "floor": floor(matte(0.8, 0.8, 0.8)),
        "glass": ball([0, 0.8, 0.5], 0.75, bsdf={"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}),
        "red": ball([1.5, 0.4, -0.5], 0.4, bsdf=matte(0.7, 0.2, 0.1)),
        "lamp": ball([-1.5, 3.5, 1], 0.8, bsdf=BLACK, emitter=lamp(8, 8, 7)),
    }


def paths(bounces):
    """Paths whose light comes from lamps after so many bounces and the last reflection."""
    return {"type": "path", "max_depth": bounces + 2}


def face(corner, right, up, bsdf):
    """A rectangle that faces the side from which `right` and `up` turn counterclockwise."""
    a, b = ([half / 2 for half in side] for side in (right, up))
    middle = [c + x + y for c, x, y in zip(corner, a, b)]
    return {"type": "rectangle", "to_world": axes(middle, a, b, cross(a, b)), "bsdf": bsdf}


def block(center, *halves):
    return {"type": "cube", "to_world": axes(center, *halves), "bsdf": WALL}


def axes(center, *columns):
    rows = [[*(column[row] for column in columns), center[row]] for row in range(3)]
    return T(rows + [[0, 0, 0, 1]])


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def render(scene, seed):
    """The light of each pixel, as rows of RGB triples of codes."""
    scene = {"type": "scene", "integrator": {"type": "direct"}, **scene}
    picture = mi.render(mi.load_dict(scene), seed=seed)
    values = mi.TensorXf(picture).array
    return [min(max(round(float(value) / WHITE * 65535), 0), 65535) for value in values]


def write(file, codes):
    """Writes an RGB picture of 16 bits as PNG."""
    row = struct.Struct(f">{3 * WIDTH}H")
    rows = (codes[3 * WIDTH * y : 3 * WIDTH * (y + 1)] for y in range(HEIGHT))
    data = zlib.compress(b"".join(b"\0" + row.pack(*codes) for codes in rows), 9)

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 2, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")
    file.write_bytes(png)


def read(file):
    """Reads a picture that `write` wrote."""
    png, at, data = file.read_bytes(), 8, b""
    while at < len(png):
        (length,) = struct.unpack_from(">I", png, at)
        if png[at + 4 : at + 8] == b"IDAT":
            data += png[at + 8 : at + 8 + length]
        at += length + 12
    rows, size = zlib.decompress(data), 1 + 6 * WIDTH
    return [code for y in range(HEIGHT) for code in struct.unpack_from(f">{3 * WIDTH}H", rows, y * size + 1)]


def main():
    checks = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not checks:
        sys.exit(__doc__)
    failed = False
    for name, scene in scenes():
        file = FOLDER / f"{name}.png"
        codes = render(scene, seed=1 if checks else 0)
        if not checks:
            write(file, codes)
            print(f"{file.name}: mean {sum(codes) / len(codes) / 65535 * WHITE:.4f}")
            continue
        known = read(file)
        error = sum(abs(a - b) for a, b in zip(codes, known)) / sum(known)
        failed |= error > (NOISE_OF_PATHS if "integrator" in scene else NOISE)
        print(f"{file.name}: {100 * error:.2f} % from the picture that is kept")
    sys.exit(failed)


if __name__ == "__main__":
    main()
