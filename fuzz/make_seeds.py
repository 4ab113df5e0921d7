#!/usr/bin/env python3
"""Writes corpus/TARGET/: small inputs that are right, where tests/corpus/bad has those that are wrong.

Usage: make_seeds.py MORSEL     (the program, for what only it writes)
"""

import base64
import contextlib
import json
import math
import pathlib
import sqlite3
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "tests" / "corpus"))
from make_bad import glb, gltf, las, npy, pcd, ply, stl  # noqa: E402

FLOATS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0.5)
TRIANGLE = "0 0 0\n1 0 0\n0 1 0.5\n"
LIST = "element face 1\nproperty list uchar int vertex_indices\n"
COLORS = ("property float x\nproperty float y\nproperty float z\n"
          "property uchar red\nproperty double intensity\n")
FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"


def literal_lzf(data):
    """What an LZF compressor that finds nothing writes."""
    runs = [data[i:i + 32] for i in range(0, len(data), 32)]
    packed = b"".join(bytes([len(run) - 1]) + run for run in runs)
    return struct.pack("<II", len(packed), len(data)) + packed


def las14():
    head = bytearray(375)
    head[0:4] = b"LASF"
    head[24], head[25] = 1, 4
    struct.pack_into("<HI", head, 94, 375, 375)
    struct.pack_into("<BH", head, 104, 6, 30)
    struct.pack_into("<3d", head, 131, 0.01, 0.01, 0.01)
    struct.pack_into("<Q", head, 247, 1)
    return bytes(head) + bytes(30)


def request(first, *headers, body=""):
    lines = [first + " HTTP/1.1", "Host: HOST", *headers]
    return "\r\n".join(lines) + "\r\n\r\n" + body


def upload(name, body, *headers):
    return request(f"POST /api/uploads?name={name}", "Content-Type: application/octet-stream",
                   f"Content-Length: {len(body)}", *headers, body=body)


def grid(scale, side=3):
    return bytes([scale % 256]) + bytes(v for x in range(side) for y in range(side)
                                        for z in range(side) for v in (x, y, z))


def ball(count, radius):
    points = b"\0"
    for i in range(count):
        z = 1 - (2 * i + 1) / count
        r, angle = math.sqrt(1 - z * z), 2.399963 * i
        points += struct.pack("3b", *(round(radius * v) for v in
                                      (r * math.cos(angle), r * math.sin(angle), z)))
    return points


def buffer_view(document):
    document = json.loads(document)
    document["buffers"] = [{"byteLength": 36}]
    text = json.dumps(document)
    text += " " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text.encode()
    chunks += struct.pack("<II", 36, 0x004E4942) + FLOATS
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


SEEDS = {
    "ply": [ply(TRIANGLE + "3 0 1 2\n", vertices=3, more=LIST),
            ply(FLOATS + b"\x03" + struct.pack("<3i", 0, 1, 2), "binary_little_endian", 3, more=LIST),
            ply("1 2 3 255 0.5\n4 5 6 0 1e-3\n", properties=COLORS),
            ply(FLOATS[:24], "binary_big_endian")],
    "pcd": [pcd("ascii", "1 2 3\n4 5 6\n"), pcd("binary", FLOATS[:24]),
            pcd("binary_compressed", literal_lzf(FLOATS[:24])),
            pcd("ascii", "1 2 3 4278190335\n1 2 3 0\n", fields="x y z rgb", size="4 4 4 4", kind="F F F U")],
    "xyz": ["1 2 3\n-4.5e3 5 6\n", "x,y,z,label\n1,2,3,0\n4,5,6,1\n", "2\n1 2 3\n4 5 6\n",
            "# comment\n1;2;3\n"],
    "off": ["OFF\n3 1 0\n" + TRIANGLE + "3 0 1 2\n", "COFF 3 1 0\n0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n0 1 0 1 2 3 4\n3 0 1 2\n"],
    "obj": ["v 0 0 0\nv 1 0 0 1\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2//1 -1\n", "v 0 0 0\nl 1 1\n"],
    "npy": [npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 3)}", FLOATS),
            npy("{'descr': '>f8', 'fortran_order': True, 'shape': (1, 3), }\n", bytes(24)),
            npy("{'descr': '<i2', 'fortran_order': False, 'shape': (2, 3)}", bytes(12))],
    "las": [las(), las(points=2, fmt=3, length=34, body=bytes(68)), las14()],
    "stl": [stl(1, struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)),
            "solid a\n" + FACET + "endsolid a\n"],
    "gltf": [gltf(), buffer_view(gltf()),
             gltf(nodes=[{"children": [1, 2], "scale": [2, 2, 2]}, {"mesh": 0, "translation": [1, 0, 0]},
                         {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1],
                          "rotation": [0, 0, 0, 1]}])],
    "http": [request("GET /"), request("GET /api/database"),
             request("GET /api/shapes?text=a&class=dumbbell&offset=0&limit=2"),
             request("GET /api/shape?name=shape%201"), request("GET /api/search?name=shape%201&top=3"),
             request("GET /api/picture?name=shape%201"), request("GET /api/parts?name=shape%202"),
             request("GET /api/match?name=shape%201&with=shape%202"),
             request("GET /api/matrix?class=dumbbell"), request("GET /api/matrix/events"),
             request("GET /api/thumbnail?name=shape%201", 'If-None-Match: "x"'),
             request("DELETE /api/upload?id=0"), request("GET /api/upload/events?id=0"),
             request("POST /api/session", "Content-Length: 15", body='{"token": "ab"}'),
             upload("a.xyz", "1 2 3\n4 5 6\n"), upload("..%2Fa.ply", "ply\n", "Sec-Fetch-Site: same-origin"),
             request("POST /api/uploads?name=a", "Transfer-Encoding: chunked",
                     "Content-Type: application/octet-stream", body="3\r\n1 2\r\n0\r\n\r\n"),
             request("OPTIONS *", "Origin: http://other.example", "Cookie: a=b; c=d", "Range: bytes=0-1"),
             request("GET /api/database") + request("HEAD /api/database", "Connection: close")],
    "segment": [grid(0), grid(-100), grid(120, 4), ball(60, 100), ball(200, 120),
                b"\0" + bytes(v for i in range(40) for v in (i, i * i % 17, 0))],
}


def stored_seeds(morsel):
    """Of one small shape: what morsel keeps of it, in all its forms."""
    points = struct.iter_unpack("3b", ball(250, 120)[1:])
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / "ball.xyz").write_text("".join("%d %d %d\n" % p for p in points))

        def run(*arguments):
            return subprocess.run([morsel, *arguments], cwd=path, check=True, capture_output=True).stdout

        run("index", "--database", "s.db", "--tag", "round", "ball.xyz")
        run("search", "--database", "s.db", "ball.xyz")
        lines = run("export", "--database", "s.db")
        shape = json.loads(lines.splitlines()[1])
        sketch = base64.b64decode(shape["sketch"])
        with contextlib.closing(sqlite3.connect(path / "s.db")) as database:
            (signature,), = database.execute("SELECT signature FROM signatures")
        return {"signature": [signature],
                "signature_json": [json.dumps(shape["signature"])],
                "lines": [lines],
                "sketch": [sketch, zlib.decompress(sketch[3:])],  # whole, and what is packed in it
                "block": [next(path.glob("*.block")).read_bytes()],
                "database": [(path / "s.db").read_bytes()]}


def main():
    for target, seeds in {**SEEDS, **stored_seeds(pathlib.Path(sys.argv[1]).resolve())}.items():
        folder = HERE / "corpus" / target
        folder.mkdir(parents=True, exist_ok=True)
        for number, seed in enumerate(seeds):
            content = seed.encode() if isinstance(seed, str) else seed
            (folder / f"seed{number:02}").write_bytes(content)


if __name__ == "__main__":
    main()
