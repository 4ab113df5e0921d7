#!/usr/bin/env python3
"""Writes bad/: one small damaged file a line of bad/expected.txt, with a part of the message that
reading it must give. Run it after adding a case; src/io/corpus_test.cpp reads every file."""

import json
import pathlib
import shutil
import struct

BAD = pathlib.Path(__file__).parent / "bad"
CASES = []


def case(name, content, message):
    CASES.append((name, content.encode() if isinstance(content, str) else content, message))


def ply(body, fmt="ascii", vertices=2, properties="property float x\nproperty float y\nproperty float z\n", more=""):
    head = f"ply\nformat {fmt} 1.0\nelement vertex {vertices}\n{properties}{more}end_header\n"
    return head.encode() + (body.encode() if isinstance(body, str) else body)


def pcd(data, body, points=2, fields="x y z", size="4 4 4", kind="F F F", width=None, count=None):
    head = f"# .PCD v0.7\nVERSION 0.7\nFIELDS {fields}\nSIZE {size}\nTYPE {kind}\n"
    if count:
        head += f"COUNT {count}\n"
    head += f"WIDTH {points if width is None else width}\nHEIGHT 1\nPOINTS {points}\nDATA {data}\n"
    return head.encode() + (body.encode() if isinstance(body, str) else body)


def npy(header, body=b"", version=1):
    header = header.encode()
    return b"\x93NUMPY" + bytes([version, 0]) + struct.pack("<H", len(header)) + header + body


def las(points=1, fmt=0, length=20, version=(1, 2), scale=0.01, data_at=227, body=bytes(20)):
    head = bytearray(227)
    head[0:4] = b"LASF"
    head[24], head[25] = version
    struct.pack_into("<H", head, 94, 227)
    struct.pack_into("<I", head, 96, data_at)
    struct.pack_into("<BHI", head, 104, fmt, length, points)
    struct.pack_into("<3d", head, 131, scale, 0.01, 0.01)
    return bytes(head) + body


def stl(triangles, body):
    return bytes(80) + struct.pack("<I", triangles) + body


def gltf(**changes):
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + "A" * 48}],
    }
    document.update(changes)
    return json.dumps(document)


def glb(text, length=None):
    text += " " * (-len(text) % 4)
    chunk = struct.pack("<II", len(text), 0x4E4F534A) + text.encode()
    return b"glTF" + struct.pack("<II", 2, length or 12 + len(chunk)) + chunk


floats = struct.pack("<6f", *range(6))
nan = struct.pack("<6f", 0, 0, 0, 1, float("nan"), 2)

# Anything
case("empty.ply", "", "is empty; expected PLY")
case("unknown.bin", b"\x01\x02\x03\x04 and more", "byte 0: binary data of no known format")
case("scan.xyz.gz", b"\x1f\x8b\x08\x00garbage", "compressed by gzip; decompress it first")
case("points.npz", b"PK\x03\x04rest", "zip archive (or .npz); unpack it first")
case("picture.ply", b"\x89PNG\r\n\x1a\n", "is a PNG picture")
case("download.off", "<!DOCTYPE html>\n<html></html>\n", "is XML or HTML, as of a failed download")
case("pointer.stl", "version https://git-lfs.github.com/spec/v1\n", "git lfs pull")
case("utf16.txt", "1 2 3\n".encode("utf-16"), "is UTF-16 text")

# Text
case("only_comments.xyz", "# nothing\n\n// here\n% either\n", "holds no points")
case("two_columns.xyz", "1 2 3\n4 5\n", ":2: z is missing; expected a number")
case("word.xyz", "1 2 3\n4 five 6\n", ":2: y is 'five'; expected a number")
case("nan.xyz", "1 2 3\n4 5 nan\n", ":2: z is 'nan'; expected a finite number")
case("infinite.txt", "1 2 3\n-inf 5 6\n", ":2: x is '-inf'; expected a finite number")
case("overflow.xyz", "1 2 1e999\n", ":1: z is '1e999'; expected a number within the range of a double")
case("binary_inside.xyz", b"1 2 3\n4 \x00\x01\x02 6\n", "binary data in a text file?")
case("binary_first.xyz", b"\x07\x08\x03abc\n1 2 3\n", ":1: binary data in a text file")
case("decimal_commas.csv", "x;y;z\n1,5;2,5;3,5\n", ":2: numbers with decimal commas")
case("empty_field.csv", "x,y,z\n1,,3\n", ":2: y is missing")
case("no_z.csv", "id,x,y\n1,2,3\n", ":1: the header 'id,x,y' names no column z")
case("prose.txt", "Dear reader,\nthis is not a point cloud.\n", ":2: x is 'this'")
case("short_count.pts", "3\n1 2 3\n4 5 6\n", "promises 3 points, but the")
case("long_count.pts", "2\n1 2 3\n4 5 6\n7 8 9\n", ":4: line 1 promises 2 points, but there are more")
case("huge_count.pts", "4000000000000\n1 2 3\n", "the header promises 4000000000000 points")

# PLY
case("wrong_magic.ply", "0.1 0.2 0.3\n", "is not a PLY file; expected it to begin with the line 'ply'")
case("no_end.ply", "ply\nformat ascii 1.0\nelement vertex 1\n", ":3: the file ends within the header")
case("bad_format.ply", "ply\nformat ebcdic 1.0\nend_header\n", ":2: unknown format")
case("no_format.ply", "ply\nelement vertex 1\nend_header\n", "no 'format' line")
case("bad_type.ply", ply("1 2 3\n", properties="property quad x\n"), ":4: unknown type 'quad'")
case("negative_count.ply", ply("", vertices=-5), ":3: the count of element 'vertex' is '-5'")
case("huge_count.ply", ply(floats, "binary_little_endian", 10**18), "promises 1000000000000000000 vertex rows")
case("overflow_count.ply", ply(floats, "binary_little_endian", 10**30), "expected an integer in range")
case("no_vertex.ply", "ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n", "0 elements named vertex")
case("no_z.ply", ply("1 2\n3 4\n", properties="property float x\nproperty float y\n"), "the points have no z")
case("twice_x.ply", ply("1 2\n", vertices=1, properties="property float x\nproperty float x\n"), "two columns are named 'x'")
case("zero_points.ply", ply("", vertices=0), "holds no points")
case("truncated.ply", ply("1 2 3\n", vertices=3), "the header promises 3 vertex rows")
case("few_rows.ply", ply("1.25 2.25 3.25\n", vertices=2), ":8: the file ends here; expected vertex 1 of 2")
case("too_many_values.ply", ply("1 2 3 4\n1 2 3\n"), ":8: a value too many, '4'")
case("nan.ply", ply("1 2 3\n4 nan 6\n"), "point 1: y is nan")
case("nan_binary.ply", ply(nan, "binary_little_endian"), "point 1: y is nan")
case("truncated_binary.ply", ply(floats[:-5], "binary_little_endian"), "hold at most 1; the file is truncated")
case("word.ply", ply("1 2 three\n4 5 6\n"), ":8: z is 'three'; expected a number")
case("list_ends.ply", ply(floats + b"\xff", "binary_big_endian", more="element face 1\nproperty list uchar int vertex_indices\n"), "vertex_indices has 255 entries")
case("negative_list.ply", ply(b"\xff" + floats, "binary_little_endian", properties="property list char int a\nproperty float x\nproperty float y\nproperty float z\n", vertices=1), "a has -1 entries")
case("index.ply", ply("0 0 0\n1 0 0\n3 0 1 2\n", more="element face 1\nproperty list uchar int vertex_indices\n"), ":12: face 0 has the vertex index 2; expected 0 to 1")
case("float_length.ply", ply("", more="element face 1\nproperty list float int vertex_indices\n"), "the length of a list is declared as a float")
case("range.ply", ply("1 2 3 300\n", vertices=1, properties="property float x\nproperty float y\nproperty float z\nproperty uchar red\n"), "red is '300'; expected an integer from 0 to 255")
case("no_properties.ply", ply("0 0 0\n", vertices=1, more="element nothing 99999999999\n"), "without any property")

# PCD
case("wrong_magic.pcd", "1 2 3\n", "is not a PCD file")
case("no_data.pcd", "# .PCD v0.7\nVERSION 0.7\n", ":2: the file ends within the header; expected DATA")
case("bad_key.pcd", "# .PCD v0.7\nVERSIONS 0.7\n", ":2: unknown header line 'VERSIONS 0.7'")
case("sizes.pcd", pcd("ascii", "1 2 3\n", size="4 4"), "FIELDS names 3 fields, SIZE 2")
case("type.pcd", pcd("ascii", "1 2 3\n", kind="F F Q"), "field 'z' has TYPE 'Q'")
case("count.pcd", pcd("ascii", "1 2 3\n", count="1 1 0"), "field 'z' has COUNT 0")
case("width.pcd", pcd("ascii", "1 2 3\n", width=7), "WIDTH 7 times HEIGHT 1 is not POINTS 2")
case("encoding.pcd", pcd("morse", ""), "DATA is 'morse'; expected ascii, binary or binary_compressed")
case("no_x.pcd", pcd("ascii", "1 2 3\n4 5 6\n", fields="a y z"), "the points have no x")
case("nan.pcd", pcd("ascii", "1 2 3\nnan nan nan\n"), "x is nan; expected a finite number")
case("nan_binary.pcd", pcd("binary", nan), "point 1: is (1, nan, 2)")
case("few_rows.pcd", pcd("ascii", "1.125 2.125 3.125\n"), "the file ends here; expected point 1 of 2")
case("truncated.pcd", pcd("binary", floats[:-1]), "the file ends within the points: 24 bytes expected, 23 left")
case("half.pcd", pcd("binary", floats[:12]), "hold at most 1")
case("huge_count.pcd", pcd("binary", floats, points=2**62), "promises 4611686018427387904 points")
case("negative_count.pcd", pcd("binary", floats, points=-2), "WIDTH is '-2'; expected an integer in range")
case("compressed_size.pcd", pcd("binary_compressed", struct.pack("<II", 4, 23) + floats), "the data unpack to 23 bytes")
case("compressed_garbage.pcd", pcd("binary_compressed", struct.pack("<II", 4, 24) + b"\xff\xff\xff\xff"), "the compressed points are damaged")
case("compressed_cut.pcd", pcd("binary_compressed", struct.pack("<II", 400, 24) + floats), "the file ends within the compressed points")
case("compressed_bomb.pcd", pcd("binary_compressed", struct.pack("<II", 4, 12 * 2**28) + floats, points=2**28), "the compressed points are damaged")

# NPY
case("wrong_magic.npy", "1 2 3\n", "is not a NPY file")
case("magic_only.npy", b"\x93NUMPY", "the file ends within the version")
case("version.npy", npy("{}", version=9), "byte 6: NPY version 9")
case("header_cut.npy", b"\x93NUMPY\x01\x00\xff\xff{'descr'", "the file ends within the header")
case("no_shape.npy", npy("{'descr': '<f8', 'fortran_order': False}"), "has no 'shape'")
case("shape.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 4)}", bytes(64)), "shape '(2, 4)'; expected (n, 3)")
case("shape_1d.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (6,)}", bytes(48)), "shape '(6,)'; expected (n, 3)")
case("negative.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (-2, 3)}", bytes(48)), "shape '(-2, 3)'")
case("complex.npy", npy("{'descr': '<c16', 'fortran_order': False, 'shape': (1, 3)}", bytes(48)), "of type 'c16'")
case("structured.npy", npy("{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (1,)}", bytes(8)), "the array is structured")
case("order.npy", npy("{'descr': '<f8', 'fortran_order': Maybe, 'shape': (1, 3)}", bytes(24)), "fortran_order is 'Maybe")
case("huge_count.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (9999999999999, 3)}", bytes(24)), "promises 9999999999999 points")
case("zero_points.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (0, 3)}"), "holds no points")
case("nan.npy", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3)}", nan), "point 1: is (1, nan, 2)")

# LAS
case("wrong_magic.las", "1 2 3\n", "is not a LAS file")
case("header_cut.las", b"LASF" + bytes(50), "the file ends within the header")
case("version.las", las(version=(2, 0)), "LAS version 2.0; expected 1.2 to 1.4")
case("compressed.laz", las(fmt=128 + 1), "compressed (LAZ); decompress it first")
case("format.las", las(fmt=11), "point format 11; expected 0 to 10")
case("record.las", las(length=12), "records of 12 bytes; expected at least 20")
case("scale.las", las(scale=0.0), "the scale of x is 0")
case("scale_nan.las", las(scale=float("nan")), "the scale of x is nan")
case("start.las", las(data_at=4000000000), "the points begin at byte 4000000000")
case("huge_count.las", las(points=4000000000), "promises 4000000000 points")
case("truncated.las", las(points=2, body=bytes(35)), "hold at most 1")
case("zero_points.las", las(points=0), "holds no points")

# OFF
case("four_d.off", "4OFF\n1 0 0\n1 2 3 4\n", "begins with '4OFF'; expected OFF, COFF, NOFF")
case("binary.off", "OFF BINARY\n", "binary OFF; save it as text")
case("no_counts.off", "OFF\n# nothing follows\n", "expected the numbers of vertices, faces and edges")
case("bad_counts.off", "OFF\nmany few none\n", ":2: the number of vertices is 'many'")
case("huge_count.off", "OFF\n9000000000000 1 0\n0 0 0\n", "promises 9000000000000 vertices")
case("huge_faces.off", "OFF\n1 9000000000000 0\n0 0 0\n", "promises 9000000000000 faces")
case("negative_count.off", "OFF\n-1 0 0\n", "the number of vertices is '-1'")
case("few_vertices.off", "OFF\n3 0 0\n1.25 2.25 3.25\n4.5 5.5 6.5\n", ":4: the file ends here; expected vertex 2 of 3")
case("few_faces.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":6: the file ends here; expected face 1 of 2")
case("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ":6: vertex index 3; expected 0 to 2")
case("face_size.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", ":6: a corner of the face is missing")
case("nan.off", "OFF\n1 0 0\nnan 0 0\n", ":3: x is 'nan'")
case("no_area.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", "the mesh has no area to sample")

# OBJ
case("word.obj", "v 1 2 three\n", ":1: z is 'three'")
case("nan.obj", "v 1 2 nan\n", ":1: z is 'nan'; expected a finite number")
case("zero_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", ":4: vertex index 0; expected 1 to 3 or -1 to -3")
case("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", ":4: vertex index 9, but the file holds 3 vertices")
case("negative_index.obj", "v 0 0 0\nf -1 -2 -3\n", ":2: vertex index -2")
case("two_corners.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", ":3: a face of 2 corners; expected 3 or more")
case("continued.obj", "v 0 0 0\nf 1 1 \\\n", "the file ends within a statement")
case("binary.obj", b"v 0 0 0\n\x00\x01\x02\n", ":2: unknown statement '\\x00\\x01\\x02'")
case("no_vertices.obj", "# empty\ng nothing\n", "holds no points")

# STL
case("header_cut.stl", bytes(40), "the file ends within the header")
case("truncated.stl", stl(2, bytes(70)), "hold at most 1")
case("huge_count.stl", stl(0xFFFFFFFF, bytes(50)), "promises 4294967295 triangles")
case("nan.stl", stl(1, struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, float("inf"), 1, 0, 0)), "point 2: is (inf, 1, 0)")
case("no_triangles.stl", stl(0, b""), "holds no points")
case("no_endsolid.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", ":4: the file ends here; expected 'endsolid'")
case("two_corners.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n", ":7: a facet of 2 vertices; expected 3")
case("word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n", ":4: y is 'zero'")

# glTF
case("wrong_magic.glb", "1 2 3\n", "is not a GLB file")
case("damaged.gltf", '{"asset": {"version": "2.0"', "the JSON ends early or is damaged here")
case("no_asset.gltf", '{"scenes": []}', "not a valid glTF 2.0 file: key 'asset' not found")
case("version.gltf", gltf(asset={"version": "1.0"}), "glTF version '1.0'; expected 2.0")
case("draco.gltf", gltf(extensionsRequired=["KHR_draco_mesh_compression"]), "compressed by KHR_draco_mesh_compression")
case("node.gltf", gltf(scenes=[{"nodes": [7]}]), "nodes[7] is referred to but missing")
case("cycle.gltf", gltf(nodes=[{"children": [0]}]), "node 0 has two parents or is its own")
case("negative.gltf", gltf(nodes=[{"mesh": -1}]), "mesh is '-1'; expected a non-negative integer")
case("matrix.gltf", gltf(nodes=[{"mesh": 0, "matrix": [1, 2, 3]}]), "matrix has 3 numbers; expected 16")
case("accessor.gltf", gltf(accessors=[{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}]), "accessors[0]: 4 elements do not fit")
case("huge_count.gltf", gltf(accessors=[{"bufferView": 0, "componentType": 5126, "count": 2**62, "type": "VEC3"}]), "count is '4611686018427387904'; expected a non-negative integer in range")
case("view.gltf", gltf(bufferViews=[{"buffer": 0, "byteLength": 36, "byteOffset": 8}]), "its buffer view ends after the 36 bytes")
case("stride.gltf", gltf(bufferViews=[{"buffer": 0, "byteLength": 36, "byteStride": 1}]), "byteStride is out of range")
case("sparse.gltf", gltf(accessors=[{"componentType": 5126, "count": 3, "type": "VEC3"}]), "is sparse or compressed")
case("base64.gltf", gltf(buffers=[{"byteLength": 36, "uri": "data:;base64,!!!!"}]), "is not valid base64")
case("remote.gltf", gltf(buffers=[{"byteLength": 36, "uri": "https://example.org/a.bin"}]), "expected a file beside this one")
case("missing_buffer.gltf", gltf(buffers=[{"byteLength": 36, "uri": "missing.bin"}]), "missing.bin: cannot read")
case("types.gltf", gltf(meshes="none"), "meshes[0] is referred to but missing")
case("version.glb", b"glTF" + struct.pack("<II", 1, 20) + bytes(8), "GLB version 1; expected 2")
case("truncated.glb", glb(gltf(), length=100000), "the header promises 100000 bytes")
case("chunk.glb", b"glTF" + struct.pack("<IIII", 2, 24, 4000, 0x4E4F534A) + b"{}  ", "the file ends within a chunk")
case("no_buffer.glb", glb(gltf(buffers=[{"byteLength": 36}])), "ends after the 0 bytes of its buffer")


def main():
    shutil.rmtree(BAD, ignore_errors=True)
    BAD.mkdir()
    lines = ["# file | part of the message; written by ../make_bad.py"]
    for name, content, message in CASES:
        assert "|" not in name + message and not (BAD / name).exists(), name
        (BAD / name).write_bytes(content)
        lines.append(f"{name} | {message}")
    (BAD / "expected.txt").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
