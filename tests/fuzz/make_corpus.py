#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes what the fuzzers begin with: make_corpus.py FOLDER

FOLDER/seeds/TARGET/   small files of each kind, whole ones and such as have once done harm
FOLDER/TARGET.dict     words that the target's reader looks for, out of its source
FOLDER/root/           what KAUSTIK_ROOT is to name: a scene and a mesh that inputs may ask for
Needs the scenes of the source tree, and nothing else.
"""
import base64
import gzip
import json
import pathlib
import re
import struct
import sys
import zlib

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FRAMEWORK = SOURCE / "framework"

CORNERS = [0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3]
FACES = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]

SMALLEST_SCENE = """\
name = "smallest"
[camera]
position = [0, 1, 5]
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1
[[material]]
name = "m"
type = "lambertian"
albedo = 0.5
[[material]]
name = "w"
type = "dielectric"
ior = 1.33
[[object]]
name = "floor"
material = "m"
shape = "plane"
size = [4, 4]
[[object]]
name = "water"
material = "w"
shape = "water"
size = [4, 4]
cells = 2
"""


def ply(format_name, faces="property list uchar int vertex_indices"):
    head = (f"ply\nformat {format_name} 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            f"property float z\nelement face 4\n{faces}\nend_header\n").encode()
    if format_name == "ascii":
        return head + b"0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
    order = ">" if "big" in format_name else "<"
    body = struct.pack(f"{order}12f", *CORNERS)
    for face in range(4):
        body += struct.pack(f"{order}B3i", 3, *FACES[3 * face:3 * face + 3])
    return head + body


def text_ply(elements, data):
    return ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            f"property float z\n{elements}end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n{data}").encode()


def plys():
    for name in ("ascii", "binary_little_endian", "binary_big_endian"):
        yield ply(name)
    faces = "property list int int vertex_indices\n"
    yield text_ply("property float nx\nproperty float ny\nproperty float nz\n", "")
    # Faces and strips without corners; elements without properties, and such as share a line.
    yield text_ply("element face 4\n" + faces, "0\n1 2\n2 0 1\n3 0 1 2\n")
    yield text_ply("element tristrips 2\n" + faces, "4 0 1 2 3\n5 0 1 2 -1 3\n")
    yield text_ply("element nothing 100000000\nelement face 1\n" + faces, "3 0 1 2\n")
    yield text_ply("element face 2\n" + faces, "3 0 1\n2 3 0 1 2\n")
    yield text_ply("element face 1\n" + faces, "6 0 1 2 3 1 0\n")


def chunk(kind, contents):
    return struct.pack("<HI", kind, len(contents) + 6) + contents


def threes():
    vertices = struct.pack("<H12f", 4, *CORNERS)
    faces = struct.pack("<H", 4)
    for face in range(4):
        faces += struct.pack("<4H", *FACES[3 * face:3 * face + 3], 7)
    groups = chunk(0x4150, struct.pack("<4I", 1, 1, 2, 2))
    material = chunk(0x4130, b"m\0" + struct.pack("<2H", 1, 0))
    for inner in (b"", groups, material):
        mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces + inner))
        editor = chunk(0xAFFF, chunk(0xA000, b"m\0")) + chunk(0x4000, b"t\0" + mesh)
        yield chunk(0x4D4D, chunk(2, struct.pack("<I", 3)) + chunk(0x3D3D, editor))
    nested = b""
    for _ in range(20):  # each in the one before
        nested = chunk(0x3D3D, nested)
    yield chunk(0x4D4D, nested)


def objs():
    corners = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
    yield corners + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    yield corners + "vn 0 0 1\nvt 0 1\no a\ng b\ns 1\nusemtl m\nf 1/1/1 3/1/1 2//1\nf -1 -2 -3 -4\n"
    yield "mtllib missing.mtl\n" + corners + "f 1 2 3 \\\n4\nl 1 2\np 1\n"


def stls():
    corners = [CORNERS[3 * i:3 * i + 3] for i in FACES]
    triangles = [corners[i:i + 3] for i in range(0, len(corners), 3)]
    data = b"".join(struct.pack("<12fH", 0, 0, 0, *sum(map(list, t), []), 0) for t in triangles)
    yield b"solid of a program that says so".ljust(80, b" ") + struct.pack("<I", 4) + data
    yield "solid a\n" + "".join(
        "facet normal 0 0 1\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*corner) for corner in t)
        + "endloop\nendfacet\n" for t in triangles) + "endsolid a\n"


def gltf(buffer):
    return {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_transmission", "KHR_materials_ior",
                           "KHR_materials_volume"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "spot", "intensity": 683.0, "color": [1.0, 0.5, 0.0], "range": 4.0,
             "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.4}}]}},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [
            {"name": "glass", "mesh": 0, "rotation": [0, 0, 0, 1], "scale": [1, 1, -1]},
            {"camera": 0, "translation": [0, 0, 10]},
            {"extensions": {"KHR_lights_punctual": {"light": 0}},
             "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.125}}],
        "meshes": [{"name": "tetra", "primitives": [
            {"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
        "materials": [{
            "name": "crown",
            "pbrMetallicRoughness": {"roughnessFactor": 0.0, "metallicFactor": 0.0,
                                     "baseColorFactor": [1, 1, 1, 1],
                                     "baseColorTexture": {"index": 0, "texCoord": 0}},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0},
                           "KHR_materials_ior": {"ior": 1.5},
                           "KHR_materials_volume": {"thicknessFactor": 1.0,
                                                    "attenuationColor": [1, 0.5, 0.5],
                                                    "attenuationDistance": 2.0}}}],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 2, "mimeType": "image/png"}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 24},
                        {"buffer": 0, "byteOffset": 64, "byteLength": 8}],
        "buffers": [buffer],
    }


def glb(text, data, short=0):
    """A GLB whose second chunk claims to be `short` bytes longer than it is."""
    text += b" " * (-len(text) % 4)
    body = (struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data) + short, b"BIN\0") + data)
    return b"glTF" + struct.pack("<2I", 2, len(body) + 12) + body


def gltfs():
    data = struct.pack("<12f12H", *CORNERS, *FACES)
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    yield json.dumps(gltf({"byteLength": len(data), "uri": uri}))
    binary = json.dumps(gltf({"byteLength": len(data)})).encode()
    yield glb(binary, data)
    yield glb(binary, data, short=8)
    yield json.dumps({"asset": {"version": "2.0"}, "nodes": [{"children": [0]}]})


def scenes():
    yield SMALLEST_SCENE
    yield 'extends = "smallest"\ntime = 1\n[[light]]\nname = "sun"\npower_factor = 2\n' \
          '[[water]]\nobject = "water"\nwaves = [{amplitude = 0.1, wavelength = 1}]\n'
    placed = 'name = "mesh"\nmaterial = "m"\nmesh = "tetrahedron.ply"\n'
    yield f"{SMALLEST_SCENE}[[object]]\n{placed}fit = {{height = 2}}\nrest_on = 0\n"
    yield (f'background_radiance = 1\n{SMALLEST_SCENE}[environment]\nimage = "input.toml"\n'
           "turn_degrees = 10\n")
    shapes = {
        "box": 'size = [1, 2, 3]\nopen = ["+y"]\ninward = true', "sphere": "radius = 1",
        "cylinder": "radius = 1\nheight = 2", "prism": "apex_degrees = 60\nheight = 1\nlength = 2",
        "ring": "inner_radius = 1\nouter_radius = 2\nheight = 1",
        "torus": "radius = 2\ntube_radius = 1\ntube_segments = 4",
        "tree": "height = 3\ntrunk_radius = 0.1\nlevels = 2\nchildren = 2\nsides = 3",
        "lens": "top_radius = 2\nbottom_radius = -2\ndiameter = 1",
        "paraboloid": "focal_length = 1\ndiameter = 1",
    }
    round_ones = ("sphere", "cylinder", "ring", "torus", "lens", "paraboloid")
    for shape, keys in shapes.items():
        few = "segments = 4\n" if shape in round_ones else ""
        yield f'{SMALLEST_SCENE}[[object]]\nname = "o"\nmaterial = "m"\nshape = "{shape}"\n' \
              f"{keys}\n{few}"
    for file in sorted((SOURCE / "experiments/scenes").glob("*.toml")):
        # Meshes are not there; those and pictures that are fine would take the fuzzer's time.
        text = re.sub(r'mesh = ".*"', 'mesh = "tetrahedron.ply"', file.read_text())
        text = re.sub(r'texture = ".*"', 'texture = "input.toml"', text)
        text = re.sub(r'(\[environment\]\n)pattern = ".*"', r'\1image = "input.toml"', text)
        yield re.sub(r"((?:segments|sides) = )\d+", r"\g<1>8",
                     re.sub(r"(cells = )(\[.*\]|\d+)", r"\g<1>4", text))
    for depth in (40, 40000):
        yield "a." * depth + "a = 1\n"


def experiments():
    for file in sorted((SOURCE / "experiments").glob("*.toml")):
        text = re.sub(r'scene = ".*"', 'scene = "smallest"', file.read_text())
        text = re.sub(r"scene = \[[^]]*\]", 'scene = ["smallest"]', text)
        text = re.sub(r"technique = \[[^]]*\]", 'technique = ["wyman2008"]', text)
        yield re.sub(r'technique = ".*"', 'technique = "wyman2008"', text)
    yield ('name = "all"\ndescription = "d"\nrepeats = 2\n[base]\nscene = "smallest"\n'
           'technique = "wyman2008"\nsize = "32x24"\nframes = 1\nwarmup = 0\nseed = 3\n'
           'precise = true\nledger = false\ntime = 0.5\nreference = "none"\ndisable = ["a.b"]\ntrace = "march"\n'
           '"trace.count" = 3\n"grid.photons" = "8x8"\n[[permute]]\n"trace.epsilon" = '
           '{from = 0.001, to = 0.1, factor = 10}\ntrace.fast = [true, false]\n[[permute]]\n'
           '"trace.count" = {from = 1, to = 8, step = 2}\ntime = {from = 0, to = 1, steps = 3}\n')


def studies():
    run = "0880955dd2ab1be95aa0733055c655b5"  # the fingerprint of {}
    whole = {"bytes": 2, "crc32": f"{zlib.crc32(b'{}'):08x}"}
    description = {"schema": "kaustik.experiment/1", "name": "s", "version": "0", "repeats": 1,
                   "runs": [{"hash": run, "axes": {}, "products": [0]}]}
    record = {"schema": "kaustik.run/1", "settings": {}, "repeat": 1, "finished": "2026",
              "files": {"report.json": whole, "samples.json": whole}}
    yield json.dumps(description) + "\n" + json.dumps(record)
    yield "[" * 100000 + "\n" + "[" * 100000


MITSUBA = """\
<scene version="3.0.0">
<default name="kind" value="glass"/>
<sensor type="perspective"><float name="fov" value="50"/><string name="fov_axis" value="smaller"/>
<transform name="to_world"><lookat origin="0, 1, 4" target="0, 1, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="24"/></film>
<medium name="exterior" type="homogeneous"><rgb name="sigma_t" value="1 2 3"/>
<float name="albedo" value="0.5"/><phase type="hg"><float name="g" value="0.5"/></phase></medium>
</sensor>
<bsdf type="dielectric" id="$kind"><string name="int_ior" value="bk7"/></bsdf>
<bsdf type="twosided" id="floor"><bsdf type="diffuse"><texture type="checkerboard" name="reflectance">
<srgb name="color0" value="#a0b0c0"/><transform name="to_uv"><scale value="4"/></transform></texture>
</bsdf></bsdf>
<bsdf type="mask" id="plastic"><bsdf type="roughplastic"><float name="alpha" value="0.2"/></bsdf></bsdf>
<shape type="rectangle"><ref id="floor"/><transform name="toWorld"><scale x="2" y="3"/>
<rotate x="1" angle="-90"/><matrix value="1 1 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform></shape>
<shape type="sphere"><ref id="glass"/><point name="center" x="0" y="1" z="0"/></shape>
<shape type="cylinder"><bsdf type="conductor"><string name="material" value="Au"/></bsdf>
<point name="p1" value="0, 1, 0"/></shape>
<shape type="disk"><emitter type="area"><spectrum name="radiance" value="400:1, 700:2"/></emitter></shape>
<shape type="cube"><ref id="plastic"/></shape>
<emitter type="point"><point name="position" value="0, 3, 0"/></emitter>
<emitter type="spot"><float name="cutoff_angle" value="30"/></emitter>
<emitter type="constant"/><integrator type="path"/>
</scene>
"""


def imports():
    yield MITSUBA
    yield '<scene><include filename="input.xml"/></scene>'
    yield '<!DOCTYPE a [<!ENTITY b "c">]><scene a="&b;"/>'
    yield "<a>" * 1000
    for mesh in ("obj", "ply", "serialized"):
        yield f'<scene><shape type="{mesh}"><string name="filename" value="input.xml"/></shape></scene>'
    yield json.dumps({
        "media": [{"name": "ink", "type": "homogeneous", "sigma_a": [1, 2, 3], "sigma_s": 0}],
        "bsdfs": [{"name": "a", "type": "transparency", "base": "b"},
                  {"name": "b", "type": "lambert", "albedo": {"type": "checker", "res_u": 2}},
                  {"name": "g", "type": "rough_dielectric", "ior": 1.3},
                  {"name": "m", "type": "rough_conductor", "material": "Al", "roughness": 0.2}],
        "camera": {"type": "pinhole", "fov": 60, "resolution": [32, 24],
                   "transform": {"position": [0, 1, 4], "look_at": [0, 1, 0], "up": [0, 1, 0]}},
        "primitives": [
            {"type": "quad", "bsdf": "a", "transform": {"scale": [4, 1, 4]}},
            {"type": "sphere", "bsdf": "g", "int_medium": "ink", "transform": {"rotation": [1, 2, 3]}},
            {"type": "cube", "bsdf": "m", "transform": [1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]},
            {"type": "disk", "bsdf": {"type": "null"}, "power": 3},
            {"type": "mesh", "file": "input.json", "bsdf": "b"},
            {"type": "point", "emission": 1}, {"type": "infinite_sphere", "emission": [1, 1, 1]},
            {"type": "infinite_sphere_cap", "power": 1}, {"type": "skydome"}, {"type": "curves"}]})
    yield '{"primitives": ' + "[" * 1000


def png(depth, color, pixels, interlaced=0, more=b""):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, depth, color, 0, 0, interlaced)) + more +
            chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))


def exr():
    """2 x 2 pixels of one channel, not compressed."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data
    window = struct.pack("<4i", 0, 0, 1, 1)
    header = (struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", b"Y\0" + struct.pack("<IIII", 2, 0, 1, 1) + b"\0") +
              attribute(b"compression", b"compression", b"\0") + attribute(b"dataWindow", b"box2i", window) +
              attribute(b"displayWindow", b"box2i", window) + attribute(b"lineOrder", b"lineOrder", b"\0") +
              attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) + attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)) +
              attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
    lines = [struct.pack("<iI2f", y, 8, 0.5, 1.5) for y in range(2)]
    first = len(header) + 16
    return header + struct.pack("<2Q", first, first + len(lines[0])) + b"".join(lines)


def exr_pngs():
    yield exr()
    yield png(8, 2, b"\0abcdef\0ghijkl")
    yield png(16, 4, b"\0abcdefgh\0ijklmnop")
    yield png(1, 3, b"\0\x40\0\x80", more=b"\0\0\0\6PLTE\1\2\3\4\5\6" + struct.pack(">I", zlib.crc32(b"PLTE\1\2\3\4\5\6")))
    yield png(8, 0, b"\0a\0b\0cd", interlaced=1)


SEEDS = {
    "scene": scenes, "exr_png": exr_pngs, "layers": lambda: (exr(),), "import": imports, "experiment": experiments, "gltf": gltfs, "obj": objs, "ply": plys, "stl": stls,
    "3ds": threes, "gzip": lambda: (gzip.compress(seed, mtime=0) for seed in plys()),
    "pfm": lambda: (b"Pf\n1 1\n1.0\n\0\0\0\0", b"P6 1 1 65535\n\0\0\0\0\0\0"),
    "image": lambda: (struct.pack("<2sIIIIiiHHIIiiII", b"BM", 70, 0, 54, 40, 2, 2, 1, 24, 0, 16, 0,
                                  0, 0, 0) + bytes(range(16)),
                      b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\0\0\0\0"),
    "settings": lambda: ('{"view": {"a": ' + "[" * 70 + "]" * 70 + "}}",),
    "reference": lambda: ('{"images": ' + "[" * 70 + "]" * 70 + "}",),
    "cache": lambda: (), "classes": lambda: (exr(),), "part": lambda: (), "tile": lambda: (), "study": studies,
}

# Whose texts a target's reader compares with.
SOURCES = {
    "scene": ["scene/files/*.cpp"], "experiment": ["experiment/*.cpp", "scene/files/*.cpp"],
    "gltf": ["importers/gltf_*.cpp"],
    "import": ["importers/mitsuba_*.cpp", "importers/tungsten_*.cpp", "importers/foreign_*.cpp"], "obj": ["importers/obj.cpp"],
    "ply": ["importers/ply.cpp"], "stl": ["importers/stl.cpp"], "3ds": [], "gzip": [], "pfm": [], "image": [], "exr_png": [],
    "layers": ["reference/class_file.cpp"], "classes": ["reference/class_file.cpp", "image/layered_image.cpp"],
    "settings": ["gui/document.cpp", "gui/state.cpp"], "reference": ["reference/*_file.cpp"],
    "cache": [], "part": ["reference/part_file.cpp", "reference/request_json.cpp"],
    "tile": ["run/tile_file.cpp"],
    "study": ["experiment/merge.cpp", "experiment/run_folder.cpp", "experiment/results.cpp"],
}


def words(patterns):
    found = set()
    for pattern in patterns:
        for file in FRAMEWORK.glob(pattern):
            for line in file.read_text().splitlines():
                if not line.startswith("#include"):
                    found.update(re.findall(r'"([A-Za-z0-9_.+\-]{2,40})"', line))
    return sorted(found)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[1])
    for target, seeds in SEEDS.items():
        folder = out / "seeds" / target
        folder.mkdir(parents=True, exist_ok=True)
        for number, seed in enumerate(seeds()):
            (folder / f"{number:02}").write_bytes(
                seed if isinstance(seed, bytes) else seed.encode())
        (out / f"{target}.dict").write_text(
            "".join(f'"{word}"\n' for word in words(SOURCES[target])))
    for name, contents in {"shaders/common/.keep": b"",
                           "experiments/scenes/smallest.toml": SMALLEST_SCENE.encode(),
                           "meshes/tetrahedron.ply": ply("ascii")}.items():
        file = out / "root" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(contents)


if __name__ == "__main__":
    main()
